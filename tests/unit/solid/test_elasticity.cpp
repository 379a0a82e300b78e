#include <gtest/gtest.h>

#include <cmath>

#include "solid/elasticity.hpp"

namespace sphdrop {
namespace {

TEST(ElasticMaterial, HasTheBeamsModuli) {
  constexpr ElasticMaterial beam{.density = 1000, .youngs_modulus = 300e6, .poisson_ratio = 0.3};
  EXPECT_NEAR(beam.bulk_modulus(), 250e6, 1e-6);
  EXPECT_NEAR(beam.shear_modulus(), 115.384615e6, 1);
  EXPECT_NEAR(beam.sound_speed(), 500.0, 1e-12);
  EXPECT_NEAR(beam.longitudinal_wave_speed(), 635.49, 0.01);
}

TEST(ElasticMaterial, HasTheSoftBeamsSoundSpeed) {
  constexpr ElasticMaterial soft{.density = 1000, .youngs_modulus = 6e6, .poisson_ratio = 0.3};
  EXPECT_NEAR(soft.sound_speed(), std::sqrt(5000.0), 1e-12);
  EXPECT_NEAR(soft.sound_speed(), 70.7, 0.02);
}

TEST(ElasticMaterial, ModuliBelongTogether) {
  for (const double nu : {-0.5, 0.0, 0.2, 0.3975, 0.49}) {
    const ElasticMaterial m{.density = 800, .youngs_modulus = 2e6, .poisson_ratio = nu};
    const double k = m.bulk_modulus(), g = m.shear_modulus();
    EXPECT_NEAR(9 * k * g / (3 * k + g), 2e6, 1e-7);              // E
    EXPECT_NEAR((3 * k - 2 * g) / (2 * (3 * k + g)), nu, 1e-14);  // nu
    EXPECT_GE(m.longitudinal_wave_speed(), m.sound_speed());
    EXPECT_NEAR(800 * m.longitudinal_wave_speed() * m.longitudinal_wave_speed(),
                2e6 * (1 - nu) / ((1 + nu) * (1 - 2 * nu)),
                1e-6);  // the constrained modulus
  }
}

}  // namespace
}  // namespace sphdrop
