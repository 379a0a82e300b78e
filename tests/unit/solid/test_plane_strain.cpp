#include <gtest/gtest.h>

#include <cmath>

#include "solid/plane_strain.hpp"

namespace sphdrop {
namespace {

constexpr double lambda = 1.7, mu = 0.8;

template <class Law>
Law law() {
  Law result;
  result.moduli.lambda = lambda;
  result.moduli.mu = mu;
  return result;
}

template <class Law>
class PlaneStrainLaw : public testing::Test {};
using Laws = testing::Types<StVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(PlaneStrainLaw, Laws);

constexpr PlaneTensor<double> deformed{1.2, 0.15, -0.3, 0.85};

TYPED_TEST(PlaneStrainLaw, StressIsTheGradientOfTheEnergy) {
  const auto l = law<TypeParam>();
  const PlaneTensor<double> p = l.stress(deformed);
  const double step = 1e-5;
  for (const auto& [member, value] : {std::pair{&PlaneTensor<double>::xx, p.xx},
                                      {&PlaneTensor<double>::xy, p.xy},
                                      {&PlaneTensor<double>::yx, p.yx},
                                      {&PlaneTensor<double>::yy, p.yy}}) {
    PlaneTensor<double> above = deformed, below = deformed;
    above.*member += step;
    below.*member -= step;
    EXPECT_NEAR((l.energy_density(above) - l.energy_density(below)) / (2 * step), value, 1e-9);
  }
}

// sigma_xx = (lambda + 2 mu) e_xx + lambda e_yy, sigma_zz = lambda (e_xx + e_yy), ...
TYPED_TEST(PlaneStrainLaw, IsHookesForSmallStrains) {
  const auto l = law<TypeParam>();
  const double e = 1e-7;
  const CauchyStress s = cauchy_stress(l, {1 + 3 * e, e, 4 * e, 1 - 2 * e});
  EXPECT_NEAR(s.xx / e, 3 * (lambda + 2 * mu) - 2 * lambda, 1e-5);
  EXPECT_NEAR(s.yy / e, 3 * lambda - 2 * (lambda + 2 * mu), 1e-5);
  EXPECT_NEAR(s.xy / e, 5 * mu, 1e-5);
  EXPECT_NEAR(s.zz / e, lambda, 1e-5);
  EXPECT_NEAR(s.pressure() / e, -(lambda + 2.0 / 3.0 * mu), 1e-5);
}

TYPED_TEST(PlaneStrainLaw, DoesNotHeedRotations) {
  const auto l = law<TypeParam>();
  const double c = std::cos(1.0), s = std::sin(1.0);
  const PlaneTensor<double>& f = deformed;
  const PlaneTensor<double> turned{c * f.xx - s * f.yx, c * f.xy - s * f.yy, s * f.xx + c * f.yx, s * f.xy + c * f.yy};
  EXPECT_NEAR(l.energy_density(turned), l.energy_density(f), 1e-14);
  const CauchyStress before = cauchy_stress(l, f), after = cauchy_stress(l, turned);
  EXPECT_NEAR(after.xx + after.yy, before.xx + before.yy, 1e-14);
  EXPECT_NEAR(after.xx, c * c * before.xx - 2 * s * c * before.xy + s * s * before.yy, 1e-14);
  EXPECT_NEAR(after.zz, before.zz, 1e-14);
}

TEST(NeoHookean, CannotBeSqueezedToNothing) {
  const auto neo = law<NeoHookean>();
  const auto squeezed = [](double j) { return PlaneTensor<double>{j, 0, 0, 1}; };
  EXPECT_GT(neo.energy_density(squeezed(1e-4)), 5 * neo.energy_density(squeezed(0.2)));
  EXPECT_LT(neo.stress(squeezed(1e-4)).xx, 1e3 * neo.stress(squeezed(0.2)).xx);
  // The other law gives way: this is why.
  const auto hooke = law<StVenantKirchhoff>();
  EXPECT_GT(hooke.stress(squeezed(0.1)).xx, hooke.stress(squeezed(0.5)).xx);
}

TEST(LameModuli, FollowFromYoungsModulusAndPoissonsRatio) {
  const LameModuli moduli(ElasticMaterial{1000.0, 300e6, 0.3});
  EXPECT_DOUBLE_EQ(moduli.lambda, 300e6 * 0.3 / (1.3 * 0.4));
  EXPECT_DOUBLE_EQ(moduli.mu, 300e6 / 2.6);
}

}  // namespace
}  // namespace sphdrop
