#include "diagnostics/energy.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sphdrop {
namespace {

/// The same by the C library, in extended precision.
double by_logarithm(double ratio) {
  const long double r = ratio;
  return static_cast<double>(std::log(r) + 1.0L / r - 1.0L);
}

TEST(Energy, Kinetic) {
  EXPECT_DOUBLE_EQ(kinetic_energy(3.0, {2.0, -1.0}), 7.5);
}

TEST(Energy, CompressiveFarFromTheReferenceDensity) {
  for (const double ratio : {0.05, 0.2, 0.5, 0.8, 0.95, 1.05, 1.3, 2.0, 5.0, 20.0})
    EXPECT_NEAR(compressive_energy_per_mass(ratio, 1.0, 1.0) / by_logarithm(ratio), 1.0, 2e-14) << ratio;
}

TEST(Energy, CompressiveNearTheReferenceDensityLosesNoDigits) {
  // e = x^2/2 - 2 x^3/3 + 3 x^4/4 - ...; at these x the logarithm's form keeps few digits or none in double precision.
  for (const double exponent : {10.0, 15.0, 20.0, 26.0}) {
    for (const double sign : {1.0, -1.0}) {
      const double x = sign * std::exp2(-exponent);  // 1 + x is exact
      const double expected = x * x * (0.5 - x * (2.0 / 3.0 - x * (0.75 - x * (0.8 - x * (5.0 / 6.0)))));
      EXPECT_NEAR(compressive_energy_per_mass(1.0 + x, 1.0, 1.0) / expected, 1.0, 1e-14) << x;
    }
  }
  EXPECT_EQ(compressive_energy_per_mass(1000.0, 1000.0, 50.0), 0.0);
}

TEST(Energy, CompressiveDerivativeIsPressureOverDensitySquared) {
  const double rho0 = 1000.0, c = 50.0;
  for (const double rho : {970.0, 999.0, 1001.0, 1040.0}) {
    const double step = 1e-3;
    const double slope =
        (compressive_energy_per_mass(rho + step, rho0, c) - compressive_energy_per_mass(rho - step, rho0, c)) /
        (2.0 * step);
    const double pressure = c * c * (rho - rho0);
    EXPECT_NEAR(slope * rho * rho / pressure, 1.0, 1e-6) << rho;
  }
}

TEST(Energy, CompressiveOfNoNumberEnds) {
  EXPECT_TRUE(std::isnan(compressive_energy_per_mass(NAN, 1000.0, 50.0)));
}

/// Energy of a linear elastic body in plane strain from its strain: lambda/2 tr(e)^2 + G e:e.
TEST(Energy, ElasticInPlaneStrainIsHookesEnergy) {
  const double youngs = 300e6, nu = 0.3;
  const double bulk = youngs / (3.0 * (1.0 - 2.0 * nu)), shear = youngs / (2.0 * (1.0 + nu));
  const double lambda = bulk - 2.0 * shear / 3.0;
  const double exx = 3e-4, eyy = -1e-4, exy = 2e-4, trace = exx + eyy;
  const auto tau =
      plane_strain_deviator(2.0 * shear * (exx - trace / 3.0), 2.0 * shear * (eyy - trace / 3.0), 2.0 * shear * exy);
  const double expected = 0.5 * lambda * trace * trace + shear * (exx * exx + eyy * eyy + 2.0 * exy * exy);
  EXPECT_NEAR(elastic_energy_density(tau, -bulk * trace, shear, bulk) / expected, 1.0, 1e-12);
}

TEST(Energy, ElasticInTwoDimensions) {
  const double bulk = 250e6, shear = 115e6;
  const double exx = 3e-4, eyy = -1e-4, exy = 2e-4, trace = exx + eyy;
  const auto tau =
      two_dimensional_deviator(2.0 * shear * (exx - trace / 2.0), 2.0 * shear * (eyy - trace / 2.0), 2.0 * shear * exy);
  // Half the stress times the strain.
  const double pressure = -bulk * trace;
  const double work = 0.5 * ((tau.xx - pressure) * exx + (tau.yy - pressure) * eyy + 2.0 * tau.xy * exy);
  EXPECT_NEAR(elastic_energy_density(tau, pressure, shear, bulk) / work, 1.0, 1e-12);
  EXPECT_EQ(tau.zz, 0.0);
}

TEST(Energy, CompressiveHasTheElasticOneAsItsSmallStrainLimit) {
  const double rho0 = 1000.0, c = 500.0, rho = rho0 * (1.0 + 1e-6);
  const double pressure = c * c * (rho - rho0);
  const double limit = elastic_energy_density({}, pressure, 1.0, rho0 * c * c);
  EXPECT_NEAR(rho * compressive_energy_per_mass(rho, rho0, c) / limit, 1.0, 2e-6);
}

}  // namespace
}  // namespace sphdrop
