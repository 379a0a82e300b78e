// The viscosity of a Newtonian liquid: the force of a pair, and the stress and the drag that many make together.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "fluid/fluid_sweep.hpp"
#include "tests/support/particle_samples.hpp"

namespace sphdrop {
namespace {

using test::smoothing_length;
using test::spacing;

constexpr double mu = 0.003;  // Pa s

template <class Kernel>
FluidPairParameters<Kernel, PhysicalViscosity> parameters_with(double h) {
  return {Kernel(h), {mu, h}};
}

template <class Parameters>
FluidRates<double> rates_of(const Parameters& p, const FluidState<double>& i, const FluidState<double>& j) {
  FluidRates<double> rates;
  add_fluid_pair(p, i, 1.0 / i.density, j, rates);
  return rates;
}

// h = 1, x_ij = 1.5 (0.6, 0.8), v_ij = (-2, 1): v_ij.x_ij = -0.6; grad W = -a/8 x_ij/r with a = 15/(7 pi).
TEST(PhysicalViscosity, HasTheValuesWorkedOutByHand) {
  const FluidState<double> i{0.9, 1.2, -1, 0, 2, 0, 0.7, 0.35};
  const FluidState<double> j{0, 0, 1, -1, 4, 0, 0.3, 0.075};
  const double slope = -15 / (7 * std::numbers::pi) / 8;
  const double factor = 0.3 * 8 * mu / (2.0 * 4.0) * -0.6 / (2.25 + 0.01) * slope;
  const FluidRates<double> rates = rates_of(parameters_with<CubicSpline>(1.0), i, j);
  EXPECT_NEAR(rates.acceleration_x, factor * 0.6, 1e-18);
  EXPECT_NEAR(rates.acceleration_y, factor * 0.8, 1e-18);
  EXPECT_NEAR(rates.density_rate, 2.0 * 0.075 * (-2 * 0.6 + 1 * 0.8) * slope, 1e-15);
  EXPECT_NEAR(rates.dissipation_rate, -0.5 * factor * (-2 * 0.6 + 1 * 0.8), 1e-18);
}

// What the forces take off the motion is compression and heat, however much the densities differ.
TEST(PhysicalViscosity, PairKeepsItsEnergy) {
  const FluidState<double> i{0.9, 1.2, -1, 0, 2, 3, 0.7, 0.35};
  const FluidState<double> j{0, 0, 1, -1, 4, -0.5, 0.3, 0.075};
  const auto parameters = parameters_with<CubicSpline>(1.0);
  double power = 0, size = 0;
  for (const auto& [one, other] : {std::pair(i, j), std::pair(j, i)}) {
    const FluidRates<double> rates = rates_of(parameters, one, other);
    const double motion = rates.acceleration_x * one.velocity_x + rates.acceleration_y * one.velocity_y;
    const double compression = one.pressure / (one.density * one.density) * rates.density_rate;
    power += one.mass * (motion + compression + rates.dissipation_rate);
    size += one.mass * std::abs(compression);
  }
  EXPECT_GT(size, 0.0);
  EXPECT_NEAR(power, 0.0, 1e-14 * size);
}

template <class Kernel>
void expect_opposite_forces_and_heat() {
  test::RandomNumbers random(60);
  const auto parameters = parameters_with<Kernel>(smoothing_length);
  int receding = 0;
  for (int k = 0; k < 1000; ++k) {
    const auto state = [&] {
      const double rho = random.between(980, 1020), m = random.between(5e-7, 8e-7), side = 1.2 * smoothing_length;
      return FluidState<double>{random.between(0, side),
                                random.between(0, side),
                                random.between(-1, 1),
                                random.between(-1, 1),
                                rho,
                                0,
                                m,
                                m / rho};
    };
    const FluidState<double> i = state(), j = state();
    const FluidRates<double> on_i = rates_of(parameters, i, j), on_j = rates_of(parameters, j, i);
    const Vector force_i = i.mass * Vector{on_i.acceleration_x, on_i.acceleration_y};
    const Vector force_j = j.mass * Vector{on_j.acceleration_x, on_j.acceleration_y};
    const Vector separation{i.x - j.x, i.y - j.y}, velocity{i.velocity_x - j.velocity_x, i.velocity_y - j.velocity_y};
    EXPECT_LE(length(force_i + force_j), 1e-14 * length(force_i));
    EXPECT_LE(std::abs(cross(force_i, separation)), 1e-14 * length(force_i) * length(separation));
    EXPECT_GE(on_i.dissipation_rate, 0.0);
    const double heat = i.mass * on_i.dissipation_rate + j.mass * on_j.dissipation_rate;
    EXPECT_NEAR(dot(force_i, velocity), -heat, 1e-13 * heat);
    receding += dot(velocity, separation) > 0 && heat > 0;
  }
  EXPECT_GT(receding, 300);  // not on approaching pairs alone
}

TEST(PhysicalViscosity, ForcesAreOppositeCentralAndDissipative) {
  expect_opposite_forces_and_heat<CubicSpline>();
  expect_opposite_forces_and_heat<WendlandC2>();
}

/// A square patch with a velocity field, its interior well within.
struct Patch {
  static constexpr int side = 24;
  FluidParticles fluid;
  std::vector<std::size_t> inner;  // rows at least six spacings from every side

  template <class Field>
  Patch(const AnyFluidPairParameters& parameters, double h, double disorder, Field&& velocity) {
    test::RandomNumbers random(61);
    std::vector<Vector> positions = test::lattice(side, side, spacing);
    test::perturb(positions, disorder * spacing, random);
    std::vector<test::FluidSample> sample;
    sample.reserve(positions.size());
    for (const Vector& p : positions) sample.push_back({p, velocity(p)});
    test::fill(fluid, sample, test::first_ids(sample.size()));
    const auto list =
        SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, fluid.owned[0], 2 * h + 0.3 * spacing);
    FluidSweep sweep(parameters);
    sweep.resize(fluid);
    sweep.pack(fluid, fluid.owned);
    sweep.apply(fluid, list);
    for (std::size_t row = 0; row < fluid.size(); ++row) {
      const Vector p = fluid.position.at(row) / spacing;
      if (std::min(p.x, p.y) > 6 && std::max(p.x, p.y) < side - 7) inner.push_back(row);
    }
  }

  Vector mean_acceleration() const {
    Vector sum;
    for (const std::size_t row : inner) sum += fluid.acceleration.at(row);
    return sum / static_cast<double>(inner.size());
  }
  double mean_heating() const {
    double sum = 0;
    for (const std::size_t row : inner) sum += fluid.dissipation_rate[row];
    return sum / static_cast<double>(inner.size());
  }
  /// What particles on one side of a line along `along` do to those on the other, a length of the line: the virial.
  template <class Parameters>
  double mean_shear_stress(const Parameters& parameters, Vector along) const {
    const auto state = [&](std::size_t row) {
      const double m = fluid.mass[row], rho = fluid.density[row];
      return FluidState<double>{fluid.position.x[row],
                                fluid.position.y[row],
                                fluid.velocity.x[row],
                                fluid.velocity.y[row],
                                rho,
                                0,
                                m,
                                m / rho};
    };
    double sum = 0;
    for (const std::size_t i : inner)
      for (std::size_t j = 0; j < fluid.size(); ++j) {
        const FluidRates<double> rates = rates_of(parameters, state(i), state(j));
        const Vector separation = fluid.position.at(i) - fluid.position.at(j);
        sum -= 0.5 * fluid.mass[i] * dot({rates.acceleration_x, rates.acceleration_y}, along) *
               dot(separation, left_normal(along));
      }
    return sum / (static_cast<double>(inner.size()) * spacing * spacing);
  }
};

constexpr double rate = 100.0;  // 1/s
constexpr double bend = 1e7;    // 1/(m s)

// A square lattice's sums depend on the direction, as cos 4 theta: the mean of these two is that of all.
const Vector directions[] = {{1, 0}, {std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2}};

template <class Kernel>
void expect_newtonian_stress(double h) {
  const auto parameters = parameters_with<Kernel>(h);
  double stress = 0, heating = 0;
  for (const Vector& along : directions) {
    const auto shear = [&](Vector p) { return rate * dot(p, left_normal(along)) * along; };
    const Patch patch(parameters, h, 0.0, shear);
    stress += 0.5 * patch.mean_shear_stress(parameters, along);
    heating += 0.5 * patch.mean_heating();
    EXPECT_LE(length(patch.mean_acceleration()), 1e-6 * mu / test::reference_density * rate / spacing);
  }
  EXPECT_NEAR(stress / (mu * rate), 1.0, 0.03);
  EXPECT_NEAR(heating / (mu * rate * rate / test::reference_density), 1.0, 0.03);
}

// tau = mu du/dy, and tau du/dy a volume is heat.
TEST(PhysicalViscosity, GivesAShearFlowTheStressOfANewtonianLiquid) {
  expect_newtonian_stress<CubicSpline>(smoothing_length);
  expect_newtonian_stress<WendlandC2>(1.5 * spacing);
}

// u = k y^2: mu/rho 2 k, in order and in disorder.
TEST(PhysicalViscosity, IsTheLaplacianOfTheVelocity) {
  const double expected = mu / test::reference_density * 2 * bend;
  for (const double disorder : {0.0, 0.1}) {
    double found = 0, across = 0;
    for (const Vector& along : directions) {
      const auto parabola = [&](Vector p) {
        const double y = dot(p - Vector{12 * spacing, 12 * spacing}, left_normal(along));
        return bend * y * y * along;
      };
      const Patch patch(parameters_with<CubicSpline>(smoothing_length), smoothing_length, disorder, parabola);
      found += 0.5 * dot(patch.mean_acceleration(), along);
      across = std::max(across, std::abs(dot(patch.mean_acceleration(), left_normal(along))));
    }
    EXPECT_NEAR(found / expected, 1.0, disorder > 0 ? 0.1 : 0.03) << disorder;
    EXPECT_LE(across, (disorder > 0 ? 0.1 : 1e-9) * expected) << disorder;
  }
}

TEST(PhysicalViscosity, OfARigidRotationIsZero) {
  const Patch patch(parameters_with<CubicSpline>(smoothing_length), smoothing_length, 0.2, [](Vector p) {
    return 1e3 * Vector{-p.y, p.x};
  });
  for (std::size_t row = 0; row < patch.fluid.size(); ++row)
    EXPECT_LE(length(patch.fluid.acceleration.at(row)), 1e-9 * mu / test::reference_density * 1e3 / spacing);
}

}  // namespace
}  // namespace sphdrop
