// What the sweeps must conserve, and what rigid and linear motions must give.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fluid/fluid_sweep.hpp"
#include "solid/hypoelastic/hypoelastic_sweep.hpp"
#include "sph/equation_of_state.hpp"
#include "tests/support/particle_samples.hpp"
#include "tests/support/same_bits.hpp"

namespace sphdrop {
namespace {

using test::FluidSample;
using test::smoothing_length;
using test::SolidSample;
using test::spacing;

constexpr CubicSpline kernel(smoothing_length);
constexpr double reach = 2 * smoothing_length + 0.3 * spacing;
constexpr double fluid_sound_speed = 50;
constexpr ElasticMaterial material{test::reference_density, 300e6, 0.3};

void sweep_fluid(FluidParticles& fluid, const std::vector<FluidSample>& sample) {
  test::fill(fluid, sample, test::first_ids(sample.size()));
  for (std::size_t row = 0; row < fluid.size(); ++row)
    fluid.pressure[row] = equation_of_state_pressure(fluid.density[row], fluid_sound_speed, test::reference_density);
  const auto list = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, fluid.owned[0], reach);
  FluidSweep sweep(FluidPairParameters<>{kernel, {0.1, 0.5, fluid_sound_speed, smoothing_length}});
  sweep.resize(fluid);
  sweep.pack(fluid, fluid.owned);
  sweep.apply(fluid, list);
}

void sweep_solid(SolidParticles& solid, const std::vector<SolidSample>& sample, double trace_factor = 1.0 / 3) {
  test::fill(solid, sample);
  const HypoelasticSweep sweep(
      {{kernel, {2.0, 0.5, material.sound_speed(), smoothing_length}, 1.0 / kernel.value(spacing)},
       material,
       trace_factor,
       0.2});
  sweep.update_stress(solid, solid.owned);
  const auto list = OffsetNeighbours::build(solid, solid.position.x, solid.position.y, reach);
  sweep.apply(solid, list, HypoelasticSweep::Blocks::without_ghosts);
}

template <class Set>
void expect_momentum_kept(const Set& set) {
  Vector total;
  double magnitude = 0;
  set.for_each_owned([&](std::size_t row) {
    total += set.mass[row] * set.acceleration.at(row);
    magnitude += set.mass[row] * length(set.acceleration.at(row));
  });
  EXPECT_GT(magnitude, 0.0);
  EXPECT_LE(length(total), 1e-13 * magnitude);
}

/// Kinetic energy lost equals heat made, where viscosity is the only force.
template <class Set>
void expect_viscosity_to_heat(const Set& set) {
  double power = 0, heat = 0;
  set.for_each_owned([&](std::size_t row) {
    EXPECT_GE(set.dissipation_rate[row], 0.0) << row;
    power += set.mass[row] * dot(set.velocity.at(row), set.acceleration.at(row));
    heat += set.mass[row] * set.dissipation_rate[row];
  });
  EXPECT_GT(heat, 0.0);
  EXPECT_NEAR(power, -heat, 1e-12 * heat);
}

TEST(Conservation, FluidKeepsMomentum) {
  FluidParticles fluid;
  sweep_fluid(fluid, test::random_fluid(20, 16, 150));
  expect_momentum_kept(fluid);
}

TEST(Conservation, FluidKeepsAngularMomentum) {
  FluidParticles fluid;
  sweep_fluid(fluid, test::random_fluid(20, 16, 151));
  double total = 0, magnitude = 0;
  for (std::size_t row = 0; row < fluid.size(); ++row) {
    const double torque = fluid.mass[row] * cross(fluid.position.at(row), fluid.acceleration.at(row));
    total += torque;
    magnitude += std::abs(torque);
  }
  EXPECT_LE(std::abs(total), 1e-13 * magnitude);
}

TEST(Conservation, SolidKeepsMomentum) {
  SolidParticles solid;
  sweep_solid(solid, test::random_solid(30, 9, 152));
  expect_momentum_kept(solid);
}

TEST(Conservation, FluidViscosityTurnsKineticEnergyIntoHeat) {
  std::vector<FluidSample> sample = test::random_fluid(20, 16, 153);
  for (FluidSample& s : sample) s.density = test::reference_density;
  FluidParticles fluid;
  sweep_fluid(fluid, sample);
  expect_viscosity_to_heat(fluid);
}

TEST(Conservation, SolidViscosityTurnsKineticEnergyIntoHeat) {
  std::vector<SolidSample> sample = test::random_solid(30, 9, 154);
  for (SolidSample& s : sample) s = {s.position, s.velocity, test::reference_density, s.mass};
  SolidParticles solid;
  sweep_solid(solid, sample);
  expect_viscosity_to_heat(solid);
}

// Equal velocities have differences of exactly zero.
TEST(Translation, ChangesNothingInTheFluid) {
  std::vector<FluidSample> sample = test::random_fluid(20, 16, 155);
  FluidParticles at_rest, moving;
  for (FluidSample& s : sample) s.velocity = {};
  sweep_fluid(at_rest, sample);
  for (FluidSample& s : sample) s.velocity = {0.7, -1.3};
  sweep_fluid(moving, sample);
  for (std::size_t row = 0; row < moving.size(); ++row) {
    EXPECT_EQ(moving.density_rate[row], 0.0);
    EXPECT_EQ(moving.dissipation_rate[row], 0.0);
    EXPECT_TRUE(test::same_bits(moving.acceleration.x[row], at_rest.acceleration.x[row]));
    EXPECT_TRUE(test::same_bits(moving.acceleration.y[row], at_rest.acceleration.y[row]));
  }
}

TEST(Translation, ChangesNothingInTheSolid) {
  std::vector<SolidSample> sample = test::random_solid(30, 9, 156);
  SolidParticles at_rest, moving;
  for (SolidSample& s : sample) s.velocity = {};
  sweep_solid(at_rest, sample);
  for (SolidSample& s : sample) s.velocity = {0.7, -1.3};
  sweep_solid(moving, sample);
  for (std::size_t row = 0; row < moving.size(); ++row) {
    EXPECT_EQ(moving.density_rate[row], 0.0);
    EXPECT_EQ(moving.dissipation_rate[row], 0.0);
    for (const Column<double>& column : moving.deviatoric_stress_rate.columns) EXPECT_EQ(column[row], 0.0);
    EXPECT_TRUE(test::same_bits(moving.acceleration.x[row], at_rest.acceleration.x[row]));
    EXPECT_TRUE(test::same_bits(moving.acceleration.y[row], at_rest.acceleration.y[row]));
  }
}

TEST(Translation, OfAStressFreeBodyGivesExactZeros) {
  std::vector<SolidSample> sample = test::random_solid(30, 9, 157);
  for (SolidSample& s : sample) s = {s.position, {0.7, -1.3}, test::reference_density, s.mass};
  SolidParticles solid;
  sweep_solid(solid, sample);
  for (std::size_t row = 0; row < solid.size(); ++row) EXPECT_EQ(solid.acceleration.at(row), Vector{}) << row;
}

// v_ij is normal to x_ij in a rigid rotation, whatever the arrangement: neither density nor, without stress, velocity
// changes, at surfaces as inside. The scales are what velocities as large along x_ij would give.
TEST(RigidRotation, OfAStressFreeBodyChangesNeitherDensityNorVelocity) {
  constexpr double omega = 1e4;
  const auto turning = [](Vector p) { return omega * left_normal(p); };
  const double fastest = omega * 30 * spacing;
  const double density_scale = test::reference_density * fastest / smoothing_length;
  std::vector<FluidSample> liquid = test::random_fluid(20, 16, 158);
  for (FluidSample& s : liquid) s = {s.position, turning(s.position), test::reference_density, s.mass};
  FluidParticles fluid;
  sweep_fluid(fluid, liquid);
  for (std::size_t row = 0; row < fluid.size(); ++row) {
    EXPECT_LE(std::abs(fluid.density_rate[row]), 1e-14 * density_scale) << row;
    EXPECT_LE(length(fluid.acceleration.at(row)), 1e-14 * 0.1 * fluid_sound_speed * fastest / smoothing_length) << row;
  }
  std::vector<SolidSample> beam = test::random_solid(30, 9, 159);
  for (SolidSample& s : beam) s = {s.position, turning(s.position), test::reference_density, s.mass};
  SolidParticles solid;
  sweep_solid(solid, beam);
  for (std::size_t row = 0; row < solid.size(); ++row) {
    EXPECT_LE(std::abs(solid.density_rate[row]), 1e-14 * density_scale) << row;
    EXPECT_LE(length(solid.acceleration.at(row)), 1e-14 * 2 * material.sound_speed() * fastest / smoothing_length)
        << row;
  }
}

// The plain SPH gradient of a linear field on a lattice is the field's gradient times the lattice's first moment: not
// 1 but 0.991, but the same in both directions and without spurious shear or rotation.
class LinearVelocity : public ::testing::Test {
 protected:
  static constexpr int columns = 25, rows = 12;

  /// Farther than the kernel's reach from every side.
  static bool is_interior(std::size_t row) {
    const int ix = static_cast<int>(row) / rows, iy = static_cast<int>(row) % rows;
    return ix > 2 && ix < columns - 3 && iy > 2 && iy < rows - 3;
  }
  /// -sum V x^2 W'/r over the lattice.
  static double first_moment() {
    double sum = 0;
    for (int ix = -2; ix <= 2; ++ix)
      for (int iy = -2; iy <= 2; ++iy) {
        const double r = spacing * std::sqrt(ix * ix + iy * iy);
        if (r > 0) sum -= spacing * spacing * (ix * spacing) * (ix * spacing) * kernel.slope(r) / r;
      }
    return sum;
  }
  /// Sweeps v = gradient . x on the lattice at rest density with deviatoric stress (tau_xx, 0, 0) and trace factor 0,
  /// so that the stress rates are 2G e plus the turning of tau.
  void sweep(const VelocityGradient<double>& l, double tau_xx) {
    std::vector<SolidSample> sample;
    for (const Vector& p : test::lattice(columns, rows, spacing)) {
      SolidSample s{p, {l.xx * p.x + l.xy * p.y, l.yx * p.x + l.yy * p.y}};
      s.tau_xx = tau_xx;
      sample.push_back(s);
    }
    sweep_solid(solid, sample, 0.0);
  }
  void expect_interior_stress_rates(double xx, double yy, double xy, double tolerance) {
    int interior = 0;
    for (std::size_t row = 0; row < solid.size(); ++row) {
      if (!is_interior(row)) continue;
      ++interior;
      EXPECT_NEAR(solid.deviatoric_stress_rate.xx[row], xx, tolerance) << row;
      EXPECT_NEAR(solid.deviatoric_stress_rate.yy[row], yy, tolerance) << row;
      EXPECT_NEAR(solid.deviatoric_stress_rate.xy[row], xy, tolerance) << row;
    }
    EXPECT_EQ(interior, (columns - 6) * (rows - 6));
  }

  SolidParticles solid;
  const double two_g = 2 * material.shear_modulus();
};

TEST_F(LinearVelocity, FirstMomentOfTheLatticeIsNearlyOne) {
  EXPECT_NEAR(first_moment(), 0.990793, 1e-6);
}

TEST_F(LinearVelocity, GradientInTheInteriorIsTheFirstMomentTimesTheTrueOne) {
  const double m = first_moment();
  test::RandomNumbers random(160);
  for (int k = 0; k < 5; ++k) {
    const VelocityGradient<double> l{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1),
                                     random.between(-1, 1)};
    sweep(l, 0.0);
    expect_interior_stress_rates(two_g * m * l.xx, two_g * m * l.yy, two_g * m * 0.5 * (l.xy + l.yx), 1e-12 * two_g);
    for (std::size_t row = 0; row < solid.size(); ++row)
      if (is_interior(row)) {
        EXPECT_NEAR(solid.density_rate[row], -test::reference_density * m * (l.xx + l.yy), 1e-12 * 1e3) << row;
      }
  }
}

TEST_F(LinearVelocity, RotationMakesNoStrainInTheInteriorAndTurnsTheStress) {
  const double omega = 3.0, tau = 1e6, m = first_moment();
  const VelocityGradient<double> rotation{.xx = 0, .xy = -omega, .yx = omega, .yy = 0};
  sweep(rotation, 0.0);
  expect_interior_stress_rates(0, 0, 0, 1e-12 * two_g * omega);
  sweep(rotation, tau);
  expect_interior_stress_rates(0, 0, m * omega * tau, 1e-12 * two_g * omega);
  // At the surface rows the plain gradient is known to see a shear.
  EXPECT_GT(std::abs(solid.deviatoric_stress_rate.xy[std::size_t{rows} * (columns / 2)]), 0.1 * two_g * omega);
}

}  // namespace
}  // namespace sphdrop
