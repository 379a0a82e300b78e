#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "particles/pack.hpp"
#include "sph/kernel.hpp"
#include "tests/support/random_numbers.hpp"
#include "tests/support/same_bits.hpp"

namespace sphdrop {
namespace {

using test::same_bits;

constexpr double h = 3e-5;
constexpr CubicSpline kernel(h);
const double a = 15.0 / (7.0 * std::numbers::pi * h * h);

// Eq 11 as printed.
double printed_value(double r) {
  const double q = r / h;
  if (q < 1) return a * (2.0 / 3.0 - q * q + q * q * q / 2);
  if (q < 2) return a * (2 - q) * (2 - q) * (2 - q) / 6;
  return 0;
}
double printed_slope(double r) {
  const double q = r / h;
  if (q < 1) return a * (-2 * q + 1.5 * q * q) / h;
  if (q < 2) return -a * (2 - q) * (2 - q) / 2 / h;
  return 0;
}

// Three Gauss points integrate W r, a polynomial of degree 4 on either piece, exactly.
TEST(CubicSpline, IntegratesToOneOverThePlane) {
  const double root = std::sqrt(0.6);
  double integral = 0;
  for (const double middle : {0.5 * h, 1.5 * h}) {
    const auto integrand = [&](double at) {
      const double r = middle + 0.5 * h * at;
      return 2 * std::numbers::pi * r * kernel.value(r);
    };
    integral += 0.5 * h * (5 * integrand(-root) + 8 * integrand(0) + 5 * integrand(root)) / 9;
  }
  EXPECT_NEAR(integral, 1.0, 1e-14);
}

TEST(CubicSpline, HasThePrintedValues) {
  EXPECT_NEAR(kernel.value(0.0) / (10 / (7 * std::numbers::pi * h * h)), 1.0, 3e-15);
  EXPECT_NEAR(kernel.value(h) / (a / 6), 1.0, 3e-15);
  EXPECT_NEAR(kernel.value(1.5 * h) / (a / 48), 1.0, 3e-15);
  EXPECT_NEAR(kernel.slope(h) / (-a / (2 * h)), 1.0, 3e-15);
  EXPECT_NEAR(kernel.slope(1.5 * h) / (-a / (8 * h)), 1.0, 3e-15);
  EXPECT_EQ(kernel.slope(0.0), 0.0);
  // W(d) d^2 at h = 1.2 d, by hand.
  EXPECT_NEAR(CubicSpline(1.2).value(1.0), 0.123901, 1e-6);
}

TEST(CubicSpline, IsThePiecewisePolynomialOfEq11) {
  for (int k = 0; k <= 2500; ++k) {
    const double r = k * 1e-3 * h;
    EXPECT_NEAR(kernel.value(r), printed_value(r), 1e-15 * a) << k;
    EXPECT_NEAR(kernel.slope(r), printed_slope(r), 2e-15 * a / h) << k;
  }
}

TEST(CubicSpline, SlopeIsTheDerivativeOfTheValue) {
  const double step = 1e-5 * h;
  for (int k = 1; k < 230; ++k) {
    const double r = k * 1e-2 * h;
    const double difference = (kernel.value(r + step) - kernel.value(r - step)) / (2 * step);
    EXPECT_NEAR(kernel.slope(r), difference, 1e-9 * a / h) << k;
  }
}

TEST(CubicSpline, IsExactlyZeroAtAndBeyondTheSupport) {
  // A power of two, so that the edge itself is represented.
  constexpr CubicSpline round(0.5);
  for (const double r : {1.0, std::nextafter(1.0, 2.0), 1.5, 1e6, 1e150}) {
    EXPECT_EQ(round.value(r), 0.0) << r;
    EXPECT_EQ(round.slope(r), 0.0) << r;
  }
  EXPECT_GT(round.value(0.999), 0.0);
  EXPECT_LT(round.slope(0.999), 0.0);
}

TEST(CubicSpline, NeverRises) {
  for (int k = 1; k < 2000; ++k) {
    EXPECT_LT(kernel.slope(k * 1e-3 * h), 0.0) << k;
    EXPECT_LT(kernel.value(k * 1e-3 * h), kernel.value((k - 1) * 1e-3 * h)) << k;
  }
}

TEST(CubicSpline, PacksEqualScalarsBitForBit) {
  test::RandomNumbers random(1);
  for (int k = 0; k < 2000; ++k) {
    std::array<double, pack_size> r;
    for (double& value : r) value = random.between(0, 2.5 * h);
    const Pack value = kernel.value(load(r.data())), slope = kernel.slope(load(r.data()));
    for (std::size_t lane = 0; lane < pack_size; ++lane) {
      EXPECT_TRUE(same_bits(value[lane], kernel.value(r[lane])));
      EXPECT_TRUE(same_bits(slope[lane], kernel.slope(r[lane])));
    }
  }
}

}  // namespace
}  // namespace sphdrop
