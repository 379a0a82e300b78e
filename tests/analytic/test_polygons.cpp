// Polygons, supports and obstacles against what mechanics says of them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "diagnostics/frequency.hpp"
#include "tests/support/watched_run.hpp"

namespace sphdrop {
namespace {

using test::watch;
using test::WatchedRun;

constexpr double plate_modulus = 300e6 / (1 - 0.3 * 0.3), density = 1000;

/// The frequency (Hz) of a solid that is set going with velocity `start(undeformed place)`, by the motion of its probe.
double frequency_of(const std::string& solid, double spacing, double end, const std::function<Vector(Vector)>& start,
                    double Observation::*motion = &Observation::deflection) {
  const Case input =
      parse_case_text(fmt::format("mode = \"modern\"\n[resolution]\nspacing = {}\n[time]\nend = {}\n[drop]\n"
                                  "shape = \"none\"\n[solid]\nkind = \"polygon\"\n{}\n",
                                  spacing, end, solid),
                      "test.cfg")
          .values;
  InitialState initial = build_initial_state(input);
  for (std::size_t k = 0; k < initial.solid.positions.size(); ++k)
    if (initial.solid.is_fixed[k] == 0) initial.solid.velocities[k] = start(initial.solid.positions[k]);
  for (const Hold& hold : initial.solid.holds) initial.solid.velocities[static_cast<std::size_t>(hold.particle)] = {};
  Simulation simulation(test::lone_process(), input, initial.fluid, initial.solid);
  std::vector<double> times, motions;
  double energy = 0, largest_error = 0;
  while (simulation.time() < end) {
    simulation.evaluate();
    if (simulation.step() % 50 == 0) {
      const Observation o = observe(simulation, energy);
      if (times.empty()) energy = o.total;
      if (!times.empty()) largest_error = std::max(largest_error, std::abs(o.unaccounted) / energy);
      times.push_back(o.time);
      motions.push_back(o.*motion);
    }
    simulation.move();
  }
  EXPECT_LT(largest_error, 1e-3);
  return fit_damped_sinusoid(times, motions).frequency;
}

/// The first frequency (Hz) of a cantilever of Euler's and Bernoulli's, by Ritz's method with x^2 ... x^7, whose error
/// is far below a part in a thousand. `height(x)` in m, x from 0 to `length`.
double euler_bernoulli_frequency(double length, const std::function<double(double)>& height) {
  constexpr std::size_t n = 6;
  std::array<std::array<double, n>, n> stiffness{}, mass{};
  constexpr int points = 4000;
  for (int p = 0; p < points; ++p) {
    const double z = (p + 0.5) / points, h = height(z * length);
    std::array<double, n> value, bend;
    for (std::size_t k = 0; k < n; ++k) {
      const double power = static_cast<double>(k) + 2;
      value[k] = std::pow(z, power);
      bend[k] = power * (power - 1) * std::pow(z, power - 2);
    }
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k) {
        stiffness[j][k] += plate_modulus * h * h * h / 12 * bend[j] * bend[k] / points;
        mass[j][k] += density * h * value[j] * value[k] / points;
      }
  }
  // Inverse iteration: the smallest ratio of stiffness to mass.
  std::array<double, n> shape{1, 1, 1, 1, 1, 1};
  double smallest = 0;
  for (int iteration = 0; iteration < 50; ++iteration) {
    auto a = stiffness;
    std::array<double, n> b{};
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k) b[j] += mass[j][k] * shape[k];
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t row = j + 1; row < n; ++row) {
        const double factor = a[row][j] / a[j][j];
        for (std::size_t k = j; k < n; ++k) a[row][k] -= factor * a[j][k];
        b[row] -= factor * b[j];
      }
    for (std::size_t j = n; j-- > 0;) {
      for (std::size_t k = j + 1; k < n; ++k) b[j] -= a[j][k] * b[k];
      b[j] /= a[j][j];
    }
    double old_norm = 0, new_norm = 0;
    for (std::size_t k = 0; k < n; ++k) {
      old_norm += shape[k] * shape[k];
      new_norm += b[k] * b[k];
    }
    smallest = std::sqrt(old_norm / new_norm);
    for (std::size_t k = 0; k < n; ++k) shape[k] = b[k] / std::sqrt(new_norm);
  }
  return std::sqrt(smallest) / (length * length) / (2 * std::numbers::pi);
}

TEST(EulerBernoulli, RitzKnowsTheStraightBeam) {
  const double exact =
      3.51602 * std::sqrt(plate_modulus * 0.25e-3 * 0.25e-3 / 12 / density) / (8e-3 * 8e-3) / (2 * std::numbers::pi);
  EXPECT_NEAR(euler_bernoulli_frequency(8e-3, [](double) { return 0.25e-3; }) / exact, 1.0, 1e-5);
}

TEST(Polygon, ThatTapersSwingsAsTheoryHasIt) {
  const double length = 8e-3;
  const double found = frequency_of(
      "polygon = [[-0.5e-3, -0.2e-3], [0, -0.2e-3], [8e-3, -0.06e-3], [8e-3, 0.06e-3], [0, 0.2e-3], [-0.5e-3, "
      "0.2e-3]]\n"
      "clamps = [[[-1, -1], [0, 1]]]",
      0.05e-3, 3.5e-3, [&](Vector p) {
        return Vector{0, 0.05 * (p.x / length) * (p.x / length)};
      });
  const double exact =
      euler_bernoulli_frequency(length, [&](double x) { return 0.4e-3 + (0.12e-3 - 0.4e-3) * x / length; });
  EXPECT_NEAR(found / exact, 1.0, 0.015);
}

// Oblique sides, 8 rows across. Along them lies the lattice too, or it does not: then the cells that the sides cut are
// too soft, the less the more rows there are.
double oblique_ratio(const std::string& keys) {
  const double c = 0.8, s = 0.6, length = 6e-3;
  const auto place = [&](double along, double across) {
    return fmt::format("[{}, {}]", c * along - s * across, s * along + c * across);
  };
  const double h = 0.2e-3, behind = -0.5e-3;
  const double found =
      frequency_of(fmt::format("polygon = [{}, {}, {}, {}]\nclamps = [[{}, {}, {}, {}]]\n{}", place(behind, -h),
                               place(length, -h), place(length, h), place(behind, h), place(2 * behind, -1e-3),
                               place(0, -1e-3), place(0, 1e-3), place(2 * behind, 1e-3), keys),
                   0.05e-3, 2.5e-3, [&](Vector p) {
                     const double z = (c * p.x + s * p.y) / length;
                     return 0.05 * z * z * Vector{-s, c};
                   });
  return found / euler_bernoulli_frequency(length, [&](double) { return 2 * h; });
}

TEST(Polygon, ThatLiesObliquelySwingsAsTheoryHasIt) {
  EXPECT_NEAR(oblique_ratio("lattice_direction = [4, 3]"), 1.0, 0.005);
  EXPECT_NEAR(oblique_ratio(""), 0.893, 0.01);
}

TEST(Supports, LetABeamSwingAsTheoryHasIt) {
  const double d = 0.05e-3, length = 8e-3, span = length - d, h = 0.25e-3;
  const double found = frequency_of(
      fmt::format(
          "polygon = [[0, 0], [{0}, 0], [{0}, {1}], [0, {1}]]\npinned = [[{2}, {3}]]\nheld_in_y = [[{4}, {3}]]\n"
          "probe = [[{5}, {3}]]",
          length, h, d / 2, h / 2, length - d / 2, length / 2),
      d, 2.5e-3, [&](Vector p) {
        return Vector{0, 0.05 * std::sin(std::numbers::pi * (p.x - d / 2) / span)};
      });
  const double exact = std::numbers::pi / 2 / (span * span) * std::sqrt(plate_modulus * h * h / 12 / density);
  EXPECT_NEAR(found / exact, 1.0, 0.01);
}

// A rectangle on the lattice is the straight beam: what has its own branches in the code must agree.
TEST(Polygon, ThatIsARectangleIsTheStraightBeam) {
  const std::string head =
      "mode = \"modern\"\n[resolution]\nspacing = 0.0625e-3\n[time]\nend = 0.3e-3\n[gravity]\n"
      "acceleration = [0, -9.81]\n[drop]\ndiameter = 0.6e-3\nvelocity = [0, -2]\ncentre_x = 1.7e-3\n"
      "gap = 1e-6\n[solid]\nclamp_length = 0.5e-3\nyoungs_modulus = 20e6\n";
  const WatchedRun straight = watch(head + "kind = \"cantilever\"\nlength = 2e-3\n", 5e-6);
  const WatchedRun polygon =
      watch(head +
                "kind = \"polygon\"\npolygon = [[-0.5e-3, 0], [2e-3, 0], [2e-3, 0.25e-3], [-0.5e-3, 0.25e-3]]\n"
                "clamps = [[[-1, -1], [0, 1]]]\nprobe = [[2e-3, 0.03e-3], [2e-3, 0.09e-3], [2e-3, 0.15e-3], [2e-3, "
                "0.22e-3]]\n",
            5e-6);
  ASSERT_EQ(straight.rows.size(), polygon.rows.size());
  EXPECT_LT(straight.last().deflection, -1e-5);
  for (std::size_t k = 0; k < straight.rows.size(); ++k) {
    EXPECT_NEAR(polygon.rows[k].deflection, straight.rows[k].deflection, 1e-6 * std::abs(straight.last().deflection));
    EXPECT_NEAR(polygon.rows[k].elastic, straight.rows[k].elastic, 1e-6 * straight.first().total);
  }
}

// What the drop loses the solids have got, and energy stays but for what has a column.
TEST(SeveralSolids, KeepMomentumAndEnergy) {
  const WatchedRun run = watch(R"(
mode = "modern"
[resolution]
spacing = 0.05e-3
[time]
end = 0.6e-3
sound_cfl = 0.1
[drop]
diameter = 0.6e-3
velocity = [0.3, -2.0]
centre_x = 1.5e-3
gap = 1e-6
[[solid]]
kind = "polygon"
polygon = [[-0.4e-3, 0], [1.9e-3, -0.5e-3], [1.95e-3, -0.3e-3], [-0.4e-3, 0.45e-3]]
clamps = [[[-1e-3, -1e-3], [0, 1e-3]]]
youngs_modulus = 20e6
[[solid]]
kind = "obstacle"
polygon = [[2.1e-3, -1e-3], [2.5e-3, -1e-3], [2.3e-3, 0.3e-3], [2.1e-3, 0.2e-3]]
)",
                               2e-6);
  const double given = run.first().kinetic_fluid, momentum = std::abs(run.first().momentum_fluid_y);
  ASSERT_GT(run.last().contact_impulse_y, -10 * momentum);
  EXPECT_NEAR(run.last().momentum_fluid_y - run.first().momentum_fluid_y, -run.last().contact_impulse_y,
              1e-12 * momentum);
  EXPECT_NEAR(run.last().momentum_fluid_x - run.first().momentum_fluid_x, -run.last().contact_impulse_x,
              1e-12 * momentum);
  EXPECT_GT(std::abs(run.last().contact_impulse_y), 0.2 * momentum);
  double largest = 0, on_leaf = 0, on_obstacle = 0;
  for (const Observation& row : run.rows) {
    largest = std::max(largest, std::abs(row.unaccounted));
    ASSERT_EQ(row.solids.size(), 2U);
    on_leaf = std::max(on_leaf, -row.solids[0].contact_force_y);
    on_obstacle = std::max(on_obstacle, row.solids[1].contact_force_x);
    EXPECT_NEAR(row.solids[0].contact_force_y + row.solids[1].contact_force_y, row.contact_force_y,
                1e-9 * std::abs(row.contact_force_y) + 1e-15);
    EXPECT_TRUE(std::isnan(row.solids[1].deflection));
    EXPECT_EQ(row.solids[0].deflection, row.deflection);
  }
  EXPECT_GT(on_leaf, 0.0);
  EXPECT_GT(on_obstacle, 0.0);
  EXPECT_LT(largest, 2e-2 * given);
}

}  // namespace
}  // namespace sphdrop
