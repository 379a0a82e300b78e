#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solid/hypoelastic/artificial_stress.hpp"
#include "tests/support/random_numbers.hpp"

namespace sphdrop {
namespace {

using Tensor = SymmetricTensor<double>;

constexpr double coefficient = 0.2;  // eps

// Eqs 20-23 as printed, with the angle, its sine and cosine, and the rotation there and back.
Tensor printed(const Tensor& stress, double density) {
  const double theta = 0.5 * std::atan2(2 * stress.xy, stress.xx - stress.yy);
  const double c = std::cos(theta), s = std::sin(theta);
  const double first = c * c * stress.xx + 2 * s * c * stress.xy + s * s * stress.yy;
  const double second = s * s * stress.xx - 2 * s * c * stress.xy + c * c * stress.yy;
  const double r1 = first > 0 ? -coefficient * first / (density * density) : 0;
  const double r2 = second > 0 ? -coefficient * second / (density * density) : 0;
  return {c * c * r1 + s * s * r2, s * s * r1 + c * c * r2, s * c * (r1 - r2)};
}

/// The stress with principal values (first, second), the first at `angle` to x.
Tensor with_principal_stresses(double first, double second, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * c * first + s * s * second, s * s * first + c * c * second, s * c * (first - second)};
}

void expect_as_printed(const Tensor& stress, double density) {
  const Tensor r = artificial_stress(stress, density, coefficient), expected = printed(stress, density);
  const double scale =
      1e-14 * coefficient * (std::abs(stress.xx) + std::abs(stress.yy) + std::abs(stress.xy)) / (density * density);
  EXPECT_NEAR(r.xx, expected.xx, scale) << stress.xx << ' ' << stress.yy << ' ' << stress.xy;
  EXPECT_NEAR(r.yy, expected.yy, scale) << stress.xx << ' ' << stress.yy << ' ' << stress.xy;
  EXPECT_NEAR(r.xy, expected.xy, scale) << stress.xx << ' ' << stress.yy << ' ' << stress.xy;
}

TEST(ArtificialStress, IsThePrintedOneForAllSignsOfThePrincipalStressesAndAllAngles) {
  for (const double first : {3e6, 0.0, -3e6})
    for (const double second : {1e6, 0.0, -1e6, -5e6, 8e6})
      for (int k = -40; k <= 40; ++k)
        expect_as_printed(with_principal_stresses(first, second, k * std::numbers::pi / 20), 1010.0);
}

TEST(ArtificialStress, IsThePrintedOneForRandomStresses) {
  test::RandomNumbers random(50);
  for (int k = 0; k < 2000; ++k)
    expect_as_printed({random.between(-1e6, 1e6), random.between(-1e6, 1e6), random.between(-1e6, 1e6)},
                      random.between(900, 1100));
}

TEST(ArtificialStress, ActsAlongThePrincipalAxisInTensionOnly) {
  const double factor = -coefficient / 1e6;
  const Tensor along_x = artificial_stress(Tensor{4e6, -3e6, 0}, 1000.0, coefficient);
  EXPECT_NEAR(along_x.xx, factor * 4e6, 1e-15);
  EXPECT_NEAR(along_x.yy, 0, 1e-15);
  EXPECT_EQ(along_x.xy, 0.0);
  const Tensor along_y = artificial_stress(Tensor{-4e6, 3e6, 0}, 1000.0, coefficient);
  EXPECT_NEAR(along_y.xx, 0, 1e-15);
  EXPECT_NEAR(along_y.yy, factor * 3e6, 1e-15);
  // Pure shear: tension s along the diagonal, so R = -eps s/rho^2 times half of ((1, 1), (1, 1)).
  const Tensor shear = artificial_stress(Tensor{0, 0, 2e6}, 1000.0, coefficient);
  for (const double component : {shear.xx, shear.yy, shear.xy}) EXPECT_NEAR(component, factor * 1e6, 1e-15);
  const Tensor other_shear = artificial_stress(Tensor{0, 0, -2e6}, 1000.0, coefficient);
  EXPECT_NEAR(other_shear.xx, factor * 1e6, 1e-15);
  EXPECT_NEAR(other_shear.xy, -factor * 1e6, 1e-15);
}

TEST(ArtificialStress, VanishesInCompression) {
  for (int k = 0; k < 20; ++k) {
    const Tensor r = artificial_stress(with_principal_stresses(-1e6, -3e6, 0.3 * k), 1000.0, coefficient);
    EXPECT_EQ(r.xx, 0.0);
    EXPECT_EQ(r.yy, 0.0);
    EXPECT_EQ(r.xy, 0.0);
  }
}

TEST(ArtificialStress, IsotropicStressHasNoDirection) {
  const Tensor tension = artificial_stress(Tensor{5e5, 5e5, 0}, 1000.0, coefficient);
  EXPECT_NEAR(tension.xx, -coefficient * 5e5 / 1e6, 1e-16);
  EXPECT_EQ(tension.xx, tension.yy);
  EXPECT_EQ(tension.xy, 0.0);
  for (const double pressure : {-5e5, 0.0}) {
    const Tensor none = artificial_stress(Tensor{pressure, pressure, 0}, 1000.0, coefficient);
    EXPECT_EQ(none.xx, 0.0);
    EXPECT_EQ(none.yy, 0.0);
    EXPECT_EQ(none.xy, 0.0);
  }
}

TEST(ArtificialStress, TinyAndHugeStressesStayFinite) {
  for (const double scale : {1e-320, 1e-170, 1e-100, 1.0, 1e100})
    for (const Tensor& t : {Tensor{scale, -scale, scale}, Tensor{scale, scale, scale}, Tensor{0, 0, -scale}}) {
      const Tensor r = artificial_stress(t, 1000.0, coefficient);
      EXPECT_TRUE(std::isfinite(r.xx) && std::isfinite(r.yy) && std::isfinite(r.xy)) << scale;
      EXPECT_LE(std::abs(r.xx) + std::abs(r.yy) + std::abs(r.xy), 10 * scale) << scale;
    }
}

}  // namespace
}  // namespace sphdrop
