#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "particles/elementary_functions.hpp"

namespace sphdrop {
namespace {

/// How many doubles lie between two numbers of the same sign.
std::int64_t units_in_the_last_place(double a, double b) {
  if (a == b) return 0;
  if (std::signbit(a) != std::signbit(b)) return std::numeric_limits<std::int64_t>::max();
  return std::abs(std::bit_cast<std::int64_t>(a) - std::bit_cast<std::int64_t>(b));
}

TEST(SineCosine, AgreesWithTheLibraryWithinTwoUnits) {
  std::int64_t worst = 0;
  for (int k = -200000; k <= 200000; ++k) {
    const double angle = k * 1e-4 * 1.0000001;
    const SineCosine own = sine_cosine(angle);
    worst = std::max({worst, units_in_the_last_place(own.sine, std::sin(angle)),
                      units_in_the_last_place(own.cosine, std::cos(angle))});
  }
  EXPECT_LE(worst, 2);
}

TEST(SineCosine, KeepsRelativeAccuracyNextToMultiplesOfAQuarterTurn) {
  std::int64_t worst = 0;
  for (int k = 1; k <= 60000; ++k) {
    const double nearest = k * (0.5 * std::numbers::pi);
    for (const double angle : {nearest, std::nextafter(nearest, 0.0), nearest * (1 + 1e-9)}) {
      const SineCosine own = sine_cosine(angle);
      worst = std::max({worst, units_in_the_last_place(own.sine, std::sin(angle)),
                        units_in_the_last_place(own.cosine, std::cos(angle))});
    }
  }
  EXPECT_LE(worst, 2);
}

TEST(SineCosine, KnowsItsExactValues) {
  EXPECT_EQ(sine_cosine(0.0).sine, 0.0);
  EXPECT_EQ(sine_cosine(0.0).cosine, 1.0);
  EXPECT_EQ(sine_cosine(1e-300).sine, 1e-300);
  EXPECT_EQ(sine_cosine(0.5 * std::numbers::pi).sine, 1.0);
  EXPECT_EQ(sine_cosine(std::numbers::pi).cosine, -1.0);
}

TEST(Exponential, AgreesWithTheLibraryWithinTwoUnits) {
  std::int64_t worst = 0;
  for (int k = -700000; k <= 700000; ++k) {
    const double x = k * 1e-3 * 1.0000001;
    worst = std::max(worst, units_in_the_last_place(exponential(x), std::exp(x)));
  }
  for (int k = -100000; k <= 100000; ++k) {
    const double x = k * 1e-5;
    worst = std::max(worst, units_in_the_last_place(exponential(x), std::exp(x)));
  }
  EXPECT_LE(worst, 2);
}

TEST(Exponential, KeepsToItsLimits) {
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(exponential(-1e9), 0.0);
  EXPECT_EQ(exponential(1e9), std::numeric_limits<double>::infinity());
  EXPECT_EQ(exponential(-std::numeric_limits<double>::infinity()), 0.0);
  EXPECT_TRUE(std::isnan(exponential(std::numeric_limits<double>::quiet_NaN())));
  // Where results are subnormal a unit in the last place is coarse, but there is none to spare.
  EXPECT_LE(units_in_the_last_place(exponential(-744.0), std::exp(-744.0)), 1);
}

TEST(NaturalLogarithm, AgreesWithTheLibrary) {
  EXPECT_EQ(natural_logarithm(1.0), 0.0);
  for (int k = -3000; k <= 3000; ++k) {
    const double x = std::exp(0.2 * k + 1e-3);
    EXPECT_LE(units_in_the_last_place(natural_logarithm(x), std::log(x)), 2) << x;
  }
  for (int k = 1; k <= 4000; ++k) {
    const double x = 0.5 + k * 2.5e-4;  // about 1, where the logarithm is small
    EXPECT_NEAR(natural_logarithm(x), std::log(x), 6e-16 * std::abs(std::log(x))) << x;
  }
}

TEST(HyperbolicFunctions, AgreeWithTheLibrary) {
  for (int k = 1; k <= 1000; ++k) {
    const double x = k * 5e-3;
    EXPECT_LE(units_in_the_last_place(hyperbolic_cosine(x), std::cosh(x)), 4) << x;
    EXPECT_NEAR(hyperbolic_sine(x), std::sinh(x), 4e-16 * std::cosh(x)) << x;
    EXPECT_EQ(hyperbolic_cosine(0.0), 1.0);
    EXPECT_EQ(hyperbolic_sine(0.0), 0.0);
  }
}

}  // namespace
}  // namespace sphdrop
