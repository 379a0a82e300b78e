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

constexpr double h = 3e-5;
constexpr WendlandC2 kernel(h);
const double a = 7.0 / (4.0 * std::numbers::pi * h * h);

// Four Gauss points integrate a polynomial of degree 7 exactly; W r has degree 6.
TEST(WendlandC2, IntegratesToOneOverThePlane) {
  const double outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2)),
               inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2));
  const double outer_weight = (18 - std::sqrt(30.0)) / 36, inner_weight = (18 + std::sqrt(30.0)) / 36;
  const auto integrand = [](double at) {
    const double r = h + h * at;
    return 2 * std::numbers::pi * r * kernel.value(r);
  };
  const double integral = h * (outer_weight * (integrand(-outer) + integrand(outer)) +
                               inner_weight * (integrand(-inner) + integrand(inner)));
  EXPECT_NEAR(integral, 1.0, 1e-14);
}

TEST(WendlandC2, HasTheValuesWorkedOutByHand) {
  EXPECT_NEAR(kernel.value(0.0), a, 1e-15 * a);
  EXPECT_NEAR(kernel.value(h), a * 3.0 / 16, 1e-15 * a);
  EXPECT_NEAR(kernel.value(1.5 * h), a * 4.0 / 256, 1e-15 * a);
  EXPECT_NEAR(kernel.slope(h), -a / h * 5.0 / 8, 2e-15 * a / h);
  EXPECT_NEAR(kernel.slope(1.5 * h), -a / h * 7.5 / 64, 2e-15 * a / h);
  EXPECT_EQ(kernel.slope(0.0), 0.0);
}

TEST(WendlandC2, SlopeIsTheDerivativeOfTheValue) {
  const double step = 1e-5 * h;
  for (int k = 1; k < 230; ++k) {
    const double r = k * 1e-2 * h;
    const double difference = (kernel.value(r + step) - kernel.value(r - step)) / (2 * step);
    EXPECT_NEAR(kernel.slope(r), difference, 1e-9 * a / h) << k;
  }
}

TEST(WendlandC2, IsExactlyZeroAtAndBeyondTheSupport) {
  constexpr WendlandC2 round(0.5);
  for (const double r : {1.0, std::nextafter(1.0, 2.0), 1.5, 1e6, 1e150}) {
    EXPECT_EQ(round.value(r), 0.0) << r;
    EXPECT_EQ(round.slope(r), 0.0) << r;
  }
  EXPECT_GT(round.value(0.999), 0.0);
  EXPECT_LT(round.slope(0.999), 0.0);
}

TEST(WendlandC2, PacksEqualScalarsBitForBit) {
  test::RandomNumbers random(2);
  for (int k = 0; k < 2000; ++k) {
    std::array<double, pack_size> r;
    for (double& value : r) value = random.between(0, 2.5 * h);
    const Pack value = kernel.value(load(r.data())), slope = kernel.slope(load(r.data()));
    for (std::size_t lane = 0; lane < pack_size; ++lane) {
      EXPECT_TRUE(test::same_bits(value[lane], kernel.value(r[lane])));
      EXPECT_TRUE(test::same_bits(slope[lane], kernel.slope(r[lane])));
    }
  }
}

TEST(SmoothingKernel, IsTheKernelThatItHolds) {
  EXPECT_EQ(kernel_value(WendlandC2(h), 0.7 * h), kernel.value(0.7 * h));
  EXPECT_EQ(kernel_value(CubicSpline(h), 0.7 * h), CubicSpline(h).value(0.7 * h));
}

}  // namespace
}  // namespace sphdrop
