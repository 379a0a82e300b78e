#include <gtest/gtest.h>

#include <cmath>

#include "solid/elasticity.hpp"
#include "solid/hypoelastic/jaumann_rate.hpp"
#include "tests/support/random_numbers.hpp"

namespace sphdrop {
namespace {

using Tensor = SymmetricTensor<double>;
using Gradient = VelocityGradient<double>;

/// The tensor turned by `angle`, counterclockwise: Q tau Q^T.
Tensor turned(const Tensor& t, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * c * t.xx + s * s * t.yy - 2 * c * s * t.xy, s * s * t.xx + c * c * t.yy + 2 * c * s * t.xy,
          c * s * (t.xx - t.yy) + (c * c - s * s) * t.xy};
}

/// v = omega x r, counterclockwise.
Gradient rotation(double omega) {
  return {.xx = 0, .xy = -omega, .yx = omega, .yy = 0};
}

TEST(JaumannRate, RigidRotationOnlyTurnsTheStress) {
  test::RandomNumbers random(40);
  const double omega = 3.7, step = 1e-5;
  for (int k = 0; k < 100; ++k) {
    const Tensor tau{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const Tensor rate = jaumann_stress_rate(rotation(omega), tau, 1e3, 1.0 / 3);
    const Tensor after = turned(tau, omega * step), before = turned(tau, -omega * step);
    EXPECT_NEAR(rate.xx, (after.xx - before.xx) / (2 * step), 1e-8);
    EXPECT_NEAR(rate.yy, (after.yy - before.yy) / (2 * step), 1e-8);
    EXPECT_NEAR(rate.xy, (after.xy - before.xy) / (2 * step), 1e-8);
    // Algebraically: the derivative of Q tau Q^T, and neither trace nor magnitude change.
    EXPECT_NEAR(rate.xx, -2 * omega * tau.xy, 1e-14);
    EXPECT_NEAR(rate.yy, 2 * omega * tau.xy, 1e-14);
    EXPECT_NEAR(rate.xy, omega * (tau.xx - tau.yy), 1e-14);
    EXPECT_NEAR(tau.xx * rate.xx + tau.yy * rate.yy + 2 * tau.xy * rate.xy, 0, 1e-14);
  }
}

TEST(JaumannRate, RotationOfAnUnstressedBodyMakesNoStress) {
  const Tensor rate = jaumann_stress_rate(rotation(100), Tensor{}, 1e8, 1.0 / 3);
  EXPECT_EQ(rate.xx, 0.0);
  EXPECT_EQ(rate.yy, 0.0);
  EXPECT_EQ(rate.xy, 0.0);
}

TEST(JaumannRate, UniaxialStrainRate) {
  const double g = 7.0, rate_of_strain = 2.0;
  const Gradient stretch{.xx = rate_of_strain};
  const Tensor plane_strain = jaumann_stress_rate(stretch, Tensor{}, g, 1.0 / 3);
  EXPECT_NEAR(plane_strain.xx, 2 * g * rate_of_strain * 2 / 3, 1e-14);
  EXPECT_NEAR(plane_strain.yy, -2 * g * rate_of_strain / 3, 1e-14);
  EXPECT_EQ(plane_strain.xy, 0.0);
  const Tensor traceless = jaumann_stress_rate(stretch, Tensor{}, g, 0.5);
  EXPECT_NEAR(traceless.xx, g * rate_of_strain, 1e-14);
  EXPECT_NEAR(traceless.yy, -g * rate_of_strain, 1e-14);
}

// With the pressure's rate K tr(e), k = 1/3 is Hooke's law in plane strain: the constrained modulus K + 4G/3.
TEST(JaumannRate, OneThirdIsPlaneStrain) {
  constexpr ElasticMaterial beam{.density = 1000, .youngs_modulus = 300e6, .poisson_ratio = 0.3};
  const Tensor rate = jaumann_stress_rate({.xx = 1.0}, Tensor{}, beam.shear_modulus(), 1.0 / 3);
  const double lambda = 300e6 * 0.3 / (1.3 * 0.4);
  EXPECT_NEAR(rate.xx + beam.bulk_modulus(), lambda + 2 * beam.shear_modulus(), 1e-6);
  EXPECT_NEAR(rate.yy + beam.bulk_modulus(), lambda, 1e-6);
}

TEST(JaumannRate, SimpleShearOfAnUnstressedBody) {
  for (const double k : {1.0 / 3, 0.5}) {
    const Tensor rate = jaumann_stress_rate({.xy = 4.0}, Tensor{}, 7.0, k);
    EXPECT_EQ(rate.xx, 0.0);
    EXPECT_EQ(rate.yy, 0.0);
    EXPECT_NEAR(rate.xy, 7.0 * 4.0, 1e-14);  // G gamma'
    const Tensor pure = jaumann_stress_rate({.xy = 2.0, .yx = 2.0}, Tensor{}, 7.0, k);
    EXPECT_NEAR(pure.xy, 7.0 * 4.0, 1e-14);
  }
}

TEST(JaumannRate, TraceFollowsTheTraceFactor) {
  test::RandomNumbers random(41);
  for (int n = 0; n < 100; ++n) {
    const Gradient l{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const Tensor tau{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    for (const double k : {1.0 / 3, 0.5}) {
      const Tensor rate = jaumann_stress_rate(l, tau, 5.0, k);
      EXPECT_NEAR(rate.xx + rate.yy, 2 * 5.0 * (1 - 2 * k) * (l.xx + l.yy), 1e-13);
    }
  }
}

// 2G (e - k tr(e) I) + r.tau - tau.r written out as products of full matrices.
TEST(JaumannRate, IsTheMatrixFormulaOfEq6) {
  test::RandomNumbers random(42);
  for (int n = 0; n < 200; ++n) {
    double l[2][2], t[2][2];
    for (auto& row : l)
      for (double& value : row) value = random.between(-1, 1);
    t[0][0] = random.between(-1, 1);
    t[1][1] = random.between(-1, 1);
    t[0][1] = t[1][0] = random.between(-1, 1);
    const double g = random.between(0, 3), k = random.between(0, 1);
    double expected[2][2];
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) {
        expected[a][b] = 2 * g * (0.5 * (l[a][b] + l[b][a]) - (a == b ? k * (l[0][0] + l[1][1]) : 0));
        for (int c = 0; c < 2; ++c)
          expected[a][b] += 0.5 * (l[a][c] - l[c][a]) * t[c][b] - t[a][c] * 0.5 * (l[c][b] - l[b][c]);
      }
    const Tensor rate =
        jaumann_stress_rate(Gradient{l[0][0], l[0][1], l[1][0], l[1][1]}, Tensor{t[0][0], t[1][1], t[0][1]}, g, k);
    EXPECT_NEAR(rate.xx, expected[0][0], 1e-14);
    EXPECT_NEAR(rate.yy, expected[1][1], 1e-14);
    EXPECT_NEAR(rate.xy, expected[0][1], 1e-14);
    EXPECT_NEAR(rate.xy, expected[1][0], 1e-14);
  }
}

}  // namespace
}  // namespace sphdrop
