#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "tests/support/particle_samples.hpp"
#include "time_integration/leapfrog.hpp"

namespace sphdrop {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <class Set>
void make_rows(Set& set, std::size_t rows) {
  set.resize(rows);
  set.owned = {{0, static_cast<std::int32_t>(rows)}};
  for (std::size_t row = 0; row < rows; ++row) {
    set.id[row] = static_cast<std::int64_t>(row);
    set.mass[row] = 1.0;
    if constexpr (std::is_same_v<Set, SolidParticles>) set.is_fixed[row] = 0.0;
  }
}

template <class Set>
class LeapFrog : public ::testing::Test {};
using Sets = ::testing::Types<FluidParticles, SolidParticles>;
TYPED_TEST_SUITE(LeapFrog, Sets);

// Steps and numbers are short binary fractions, so that exact means equal.
TYPED_TEST(LeapFrog, IsExactForConstantAccelerationWithVaryingSteps) {
  TypeParam p;
  make_rows(p, 1);
  const Vector x0{0.5, -2}, v0{3, 1}, a{-1.5, 0.25};
  const double density0 = 8, density_rate = -0.5;
  p.position.set(0, x0);
  p.staggered_velocity.set(0, v0);
  p.staggered_density[0] = density0;
  double time = 0, previous = 0;
  for (const double step : {0.25, 0.25, 0.5, 0.125, 0.0625, 1.0, 0.25}) {
    predict(p, previous);
    EXPECT_EQ(p.position.at(0), x0 + time * v0 + 0.5 * time * time * a) << "at " << time;
    EXPECT_EQ(p.velocity.at(0), v0 + time * a) << "at " << time;
    EXPECT_EQ(p.density[0], density0 + time * density_rate) << "at " << time;
    p.acceleration.set(0, a);
    p.density_rate[0] = density_rate;
    kick_and_drift(p, {previous, step}, no_limit);
    EXPECT_EQ(p.staggered_velocity.at(0), v0 + (time + 0.5 * step) * a) << "at " << time;
    EXPECT_EQ(p.staggered_density[0], density0 + (time + 0.5 * step) * density_rate) << "at " << time;
    time += step;
    previous = step;
  }
}

TYPED_TEST(LeapFrog, StartsWithACopyAndHalfAKick) {
  TypeParam p;
  make_rows(p, 1);
  p.staggered_velocity.set(0, {2, 0});
  p.staggered_density[0] = 10;
  // Rates of a step that never was must not matter.
  p.acceleration.set(0, {1000, 1000});
  p.density_rate[0] = 1000;
  predict(p, 0.0);
  EXPECT_EQ(p.velocity.at(0), (Vector{2, 0}));
  EXPECT_EQ(p.density[0], 10);
  p.acceleration.set(0, {8, -4});
  p.density_rate[0] = 16;
  kick_and_drift(p, {0.0, 0.5}, no_limit);
  EXPECT_EQ(p.staggered_velocity.at(0), (Vector{4, -1}));
  EXPECT_EQ(p.staggered_density[0], 14);
  EXPECT_EQ(p.position.at(0), (Vector{2, -0.5}));
}

/// Error in position and predicted velocity at t = 8 of x'' = -x - 2 damping x', from x = 1 at rest. Steps are
/// `longest` (1 - wobble sin^2(time)).
template <class Set>
double oscillator_error(double longest, double wobble, double damping) {
  Set p;
  make_rows(p, 1);
  p.position.set(0, {1, 0});
  const double end = 8;
  double time = 0, previous = 0;
  for (;;) {
    predict(p, previous);
    if (time >= end) break;
    p.acceleration.set(0, {-p.position.x[0] - 2 * damping * p.velocity.x[0], 0});
    const double wanted = longest * (1 - wobble * std::sin(time) * std::sin(time));
    // The end is met exactly by equal steps over the last stretch, so that the error is the scheme's alone.
    const double remaining = end - time;
    const double step = remaining < 20 * longest ? remaining / std::ceil(remaining / wanted - 1e-9) : wanted;
    kick_and_drift(p, {previous, step}, no_limit);
    time += step;
    if (end - time < 1e-9 * longest) time = end;
    previous = step;
  }
  const double omega = std::sqrt(1 - damping * damping), decay = std::exp(-damping * end);
  const double x = decay * (std::cos(omega * end) + damping / omega * std::sin(omega * end));
  const double v = -decay / omega * std::sin(omega * end);
  return std::abs(p.position.x[0] - x) + std::abs(p.velocity.x[0] - v);
}

TYPED_TEST(LeapFrog, ConvergesWithTheSquareOfTheStep) {
  for (const double damping : {0.0, 0.3})  // with damping the predicted velocity enters the rates
    for (const double wobble : {0.0, 0.5}) {
      const double coarse = oscillator_error<TypeParam>(0.02, wobble, damping);
      const double fine = oscillator_error<TypeParam>(0.005, wobble, damping);
      EXPECT_LT(coarse, 2e-3);
      EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), 2.0, 0.15) << "damping " << damping << ", wobble " << wobble;
    }
}

// Thirteen rows: lanes and a tail.
TEST(DisplacementBox, IsAsWideAsTheDisplacementsDiffer) {
  FluidParticles p;
  make_rows(p, 13);
  const Vector common{3.0, -4.0};
  for (std::size_t k = 0; k < 13; ++k) {
    p.list_position.set(k, {0.1 * static_cast<double>(k), 1.0});
    p.position.set(k, p.list_position.at(k) + common);
    p.detection_position.set(k, p.position.at(k));
  }
  const auto box = [&] { return motion_maxima(p, no_limit, {true, true}).displacements; };
  EXPECT_NEAR(box().squared_diagonal(), 0.0, 1e-28);
  EXPECT_NEAR(box().squared_motion_since({0.0, 0.0, 0.0, 0.0}), 25.0, 1e-13);
  EXPECT_NEAR(box().squared_motion_since(box()), 0.0, 1e-28);
  const DisplacementBox before = box();
  for (const std::size_t k : {2, 12}) {
    const Vector place = p.position.at(k);
    p.position.set(k, place + Vector{0.3, -0.4});
    EXPECT_NEAR(box().squared_diagonal(), 0.25, 1e-14);
    EXPECT_NEAR(box().squared_motion_since(before), 0.25, 1e-14);
    const DisplacementBox of_detection = motion_maxima(p, no_limit, {false, true}).detection_displacements;
    EXPECT_NEAR(of_detection.squared_diagonal(), 0.25, 1e-14);
    EXPECT_NEAR(of_detection.high_x, 0.3, 1e-14);
    EXPECT_NEAR(of_detection.low_y, -0.4, 1e-14);
    p.position.set(k, place);
  }
  // What is not looked for is empty, and wider than any limit.
  EXPECT_GT(motion_maxima(p, no_limit).displacements.squared_diagonal(), 1e300);
}

TYPED_TEST(LeapFrog, KeepsTheEnergyOfAnOscillatorBounded) {
  TypeParam p;
  make_rows(p, 1);
  p.position.set(0, {1, 0});
  double previous = 0, worst = 0;
  const double step = 0.1;
  for (int k = 0; k < 20000; ++k) {
    predict(p, previous);
    p.acceleration.set(0, -1.0 * p.position.at(0));
    // Before the kick, the staggered velocity before and after give the energy without the predictor's error.
    const Vector before = p.staggered_velocity.at(0);
    kick_and_drift(p, {previous, step}, no_limit);
    const Vector after = p.staggered_velocity.at(0), x = p.position.at(0) - step * after;
    const Vector v = k == 0 ? before : 0.5 * (before + after);
    worst = std::max(worst, std::abs(0.5 * squared_length(v) + 0.5 * squared_length(x) - 0.5));
    previous = step;
  }
  EXPECT_LT(worst, 2e-3);
}

TYPED_TEST(LeapFrog, MovesOwnedRowsOnlyAndEachOnce) {
  // Gaps shorter than any vector, ranges that end inside one.
  TypeParam p;
  make_rows(p, 30);
  const std::vector<test::Presence> kind = [] {
    std::vector<test::Presence> rows(30, test::Presence::owned);
    for (const std::size_t ghost : {0u, 5u, 6u, 11u, 20u, 21u, 22u, 29u}) rows[ghost] = test::Presence::ghost;
    return rows;
  }();
  test::set_ranges(p, kind);
  for (std::size_t row = 0; row < 30; ++row) {
    p.position.set(row, {static_cast<double>(row), 0});
    p.staggered_velocity.set(row, {1, -2});
    p.staggered_density[row] = 100;
    p.acceleration.set(row, {4, 8});
    p.density_rate[row] = 2;
    p.dissipation_rate[row] = 3;
  }
  predict(p, 0.5);
  kick_and_drift(p, {0.5, 1.0}, no_limit);
  for (std::size_t row = 0; row < 30; ++row) {
    const double start = static_cast<double>(row);
    const bool owned = kind[row] == test::Presence::owned;
    EXPECT_EQ(p.velocity.at(row), owned ? (Vector{2, 0}) : Vector{}) << row;
    EXPECT_EQ(p.density[row], owned ? 100.5 : 0.0) << row;
    EXPECT_EQ(p.staggered_velocity.at(row), owned ? (Vector{4, 4}) : (Vector{1, -2})) << row;
    EXPECT_EQ(p.staggered_density[row], owned ? 101.5 : 100) << row;
    EXPECT_EQ(p.position.at(row), owned ? (Vector{start + 4, 4}) : (Vector{start, 0})) << row;
    EXPECT_EQ(p.dissipated_energy[row], owned ? 3 : 0) << row;
  }
}

TYPED_TEST(LeapFrog, ReportsTheFastestAndTheFarthestOfTheOwnedRows) {
  for (const std::size_t extreme : {0u, 3u, 6u, 7u, 12u, 16u}) {
    TypeParam p;
    make_rows(p, 18);
    p.owned = {{0, 5}, {6, 17}};
    for (std::size_t row = 0; row < 18; ++row) {
      p.position.set(row, {static_cast<double>(row), 1});
      p.list_position.set(row, {static_cast<double>(row), 1});
      p.staggered_velocity.set(row, {0.25, 0});
    }
    // Faster, farther and not numbers: but ghosts.
    for (const std::size_t ghost : {5u, 17u}) {
      p.staggered_velocity.set(ghost, {1e3, nan});
      p.position.set(ghost, {nan, 1e30});
    }
    p.staggered_velocity.set(extreme, {3, -4});
    p.list_position.set(extreme, {p.position.x[extreme] - 2, 1 + 6});
    const MotionMaxima maxima = kick_and_drift(p, {0.0, 0.5}, 5.0);
    EXPECT_EQ(maxima.squared_speed, 25.0) << extreme;
    EXPECT_EQ(maxima.squared_displacement, 3.5 * 3.5 + 8 * 8) << extreme;  // drift (1.5, -2) added
    EXPECT_FALSE(maxima.beyond_limit) << extreme;
    EXPECT_TRUE(kick_and_drift(p, {0.5, 0.5}, 4.999).beyond_limit) << extreme;
  }
}

TYPED_TEST(LeapFrog, NoticesWhatIsNotANumber) {
  for (std::size_t bad = 0; bad < 11; ++bad) {
    for (int where = 0; where < 4; ++where) {
      TypeParam p;
      make_rows(p, 11);
      EXPECT_FALSE(kick_and_drift(p, {0.0, 0.5}, 1.0).beyond_limit);
      if (where == 0) p.acceleration.x[bad] = nan;
      if (where == 1) p.acceleration.y[bad] = std::numeric_limits<double>::infinity();
      if (where == 2) p.position.x[bad] = nan;
      if (where == 3) p.staggered_velocity.y[bad] = nan;
      EXPECT_TRUE(kick_and_drift(p, {0.5, 0.5}, 1.0).beyond_limit) << "row " << bad << ", place " << where;
    }
  }
}

TYPED_TEST(LeapFrog, AnEmptySetIsAtRest) {
  TypeParam p;
  const MotionMaxima maxima = kick_and_drift(p, {0.5, 0.5}, 1.0);
  EXPECT_EQ(maxima.squared_speed, 0.0);
  EXPECT_EQ(maxima.squared_displacement, 0.0);
  EXPECT_FALSE(maxima.beyond_limit);
}

TYPED_TEST(LeapFrog, AddsUpTheDissipatedEnergy) {
  TypeParam p;
  make_rows(p, 2);
  p.mass[0] = 2;
  p.mass[1] = 4;
  p.dissipated_energy[1] = 1;
  p.dissipation_rate[0] = 8;
  p.dissipation_rate[1] = 0.5;
  kick_and_drift(p, {0.25, 0.5}, no_limit);  // over the step from t to t + 0.5
  EXPECT_EQ(p.dissipated_energy[0], 8);
  EXPECT_EQ(p.dissipated_energy[1], 2);
  p.dissipation_rate[0] = 1;
  kick_and_drift(p, {0.5, 0.25}, no_limit);
  EXPECT_EQ(p.dissipated_energy[0], 8.5);
  EXPECT_EQ(p.dissipated_energy[1], 2.5);
}

TEST(FluidLeapFrog, ReportsTheDisplacementSinceTheSurfaceWasDetected) {
  FluidParticles p;
  make_rows(p, 12);
  p.owned = {{0, 11}};
  p.detection_position.set(9, {3, 4});
  p.detection_position.set(11, {300, 400});
  const MotionMaxima maxima = kick_and_drift(p, {0.0, 1.0}, 1.0);
  EXPECT_EQ(maxima.squared_detection_displacement, 25.0);
  EXPECT_EQ(maxima.squared_displacement, 0.0);
}

TEST(SolidLeapFrog, HoldsFixedParticlesButLetsTheirDensityAndStressEvolve) {
  SolidParticles p;
  make_rows(p, 10);
  p.is_fixed[3] = 1;
  for (std::size_t row = 0; row < 10; ++row) {
    p.position.set(row, {1, 2});
    p.acceleration.set(row, {4, 8});
    p.density_rate[row] = 2;
    p.deviatoric_stress_rate.xx[row] = 16;
    p.deviatoric_stress_rate.yy[row] = -8;
    p.deviatoric_stress_rate.xy[row] = 4;
  }
  kick_and_drift(p, {0.5, 0.5}, no_limit);
  EXPECT_EQ(p.position.at(3), (Vector{1, 2}));
  EXPECT_EQ(p.staggered_velocity.at(3), Vector{});
  EXPECT_EQ(p.position.at(4), (Vector{2, 4}));
  EXPECT_EQ(p.staggered_velocity.at(4), (Vector{2, 4}));
  for (const std::size_t row : {3u, 4u}) {
    EXPECT_EQ(p.staggered_density[row], 1);
    EXPECT_EQ(p.staggered_deviatoric_stress.xx[row], 8);
    EXPECT_EQ(p.staggered_deviatoric_stress.yy[row], -4);
    EXPECT_EQ(p.staggered_deviatoric_stress.xy[row], 2);
  }
  // Predicted half the step before: a held particle has no acceleration left to be predicted with.
  predict(p, 0.5);
  EXPECT_EQ(p.velocity.at(3), Vector{});
  EXPECT_EQ(p.velocity.at(4), (Vector{3, 6}));
  EXPECT_EQ(p.density[3], 1.5);
  EXPECT_EQ(p.deviatoric_stress.xx[3], 12);
  EXPECT_EQ(p.deviatoric_stress.yy[4], -6);
  EXPECT_EQ(p.deviatoric_stress.xy[3], 3);
}

TEST(SolidLeapFrog, AddsUpTheWorkOfTheArtificialStress) {
  SolidParticles p;
  make_rows(p, 2);
  p.mass[1] = 4;
  p.artificial_stress_power[0] = -3;
  p.artificial_stress_power[1] = 0.5;
  kick_and_drift(p, {0.25, 0.5}, no_limit);
  EXPECT_EQ(p.artificial_stress_work[0], -1.5);
  EXPECT_EQ(p.artificial_stress_work[1], 1);
  EXPECT_EQ(p.dissipated_energy[0], 0);
}

}  // namespace
}  // namespace sphdrop
