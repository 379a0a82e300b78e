#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "particles/pack.hpp"
#include "sph/artificial_viscosity.hpp"
#include "tests/support/random_numbers.hpp"
#include "tests/support/same_bits.hpp"

namespace sphdrop {
namespace {

constexpr ArtificialViscosity viscosity{.alpha = 0.1, .beta = 0.7, .sound_speed = 50, .smoothing_length = 3e-5};

/// Pi as the pair formulas call it.
template <class T>
T pi_of(const ArtificialViscosity& v, const T& velocity_dot_distance, const T& squared_distance, const T& density_sum) {
  return v(velocity_dot_distance, density_sum, T(1.0) / v.denominator(squared_distance, density_sum));
}

// Eqs 17, 18 as printed; the mean density is half the sum that the function takes.
double printed(double velocity_dot_distance, double squared_distance, double mean_density) {
  if (velocity_dot_distance >= 0) return 0;
  const double h = viscosity.smoothing_length;
  const double mu = h * velocity_dot_distance / (squared_distance + 0.01 * h * h);
  return (-viscosity.alpha * viscosity.sound_speed * mu + viscosity.beta * mu * mu) / mean_density;
}

TEST(ArtificialViscosity, HasTheValueWorkedOutByHand) {
  // h = 2, r^2 = 4, v.x = -1: mu = -2/4.04; alpha c = 3, beta = 5, rho_mean = 8.
  constexpr ArtificialViscosity simple{.alpha = 0.5, .beta = 5, .sound_speed = 6, .smoothing_length = 2};
  const double mu = -2.0 / 4.04;
  EXPECT_NEAR(pi_of(simple, -1.0, 4.0, 16.0), (3 * -mu + 5 * mu * mu) / 8, 1e-15);
}

TEST(ArtificialViscosity, FollowsThePrintedFormula) {
  test::RandomNumbers random(2);
  for (int k = 0; k < 1000; ++k) {
    const double vx = random.between(-6e-5, 6e-5), r2 = random.between(0, 36e-10), rho = random.between(900, 1100);
    const double expected = printed(vx, r2, rho);
    EXPECT_NEAR(pi_of(viscosity, vx, r2, 2 * rho), expected, 1e-14 * expected) << vx << ' ' << r2;
  }
}

TEST(ArtificialViscosity, ActsOnApproachingPairsOnly) {
  EXPECT_GT(pi_of(viscosity, -1e-5, 1e-10, 2000.0), 0.0);
  EXPECT_EQ(pi_of(viscosity, 0.0, 1e-10, 2000.0), 0.0);
  EXPECT_EQ(pi_of(viscosity, 1e-5, 1e-10, 2000.0), 0.0);
}

TEST(ArtificialViscosity, IsAPositivePressureSoThatItTakesEnergy) {
  test::RandomNumbers random(3);
  for (int k = 0; k < 1000; ++k)
    EXPECT_GT(pi_of(viscosity, random.between(-6e-5, -1e-9), random.between(0, 36e-10), 2000.0), 0.0);
}

TEST(ArtificialViscosity, VanishesWithItsCoefficients) {
  constexpr ArtificialViscosity none{.alpha = 0, .beta = 0, .sound_speed = 50, .smoothing_length = 3e-5};
  EXPECT_EQ(pi_of(none, -1e-5, 1e-10, 2000.0), 0.0);
}

TEST(InversePair, IsTheTwoReciprocalsToAFewUnitsInTheLastPlace) {
  test::RandomNumbers random(5);
  for (int k = 0; k < 1000; ++k) {
    const double a = random.between(1e-7, 6e-5), b = random.between(1e-8, 8e-6);
    const InversePair<double> inverse(a, b);
    EXPECT_NEAR(inverse.first * a, 1.0, 1e-15);
    EXPECT_NEAR(inverse.second * b, 1.0, 1e-15);
  }
}

TEST(ArtificialViscosity, PacksEqualScalarsBitForBit) {
  test::RandomNumbers random(4);
  for (int k = 0; k < 1000; ++k) {
    std::array<double, pack_size> vx, r2, rho;
    for (std::size_t lane = 0; lane < pack_size; ++lane) {
      vx[lane] = random.between(-6e-5, 6e-5);
      r2[lane] = random.between(0, 36e-10);
      rho[lane] = random.between(1900, 2100);
    }
    const Pack pi = pi_of(viscosity, load(vx.data()), load(r2.data()), load(rho.data()));
    for (std::size_t lane = 0; lane < pack_size; ++lane)
      EXPECT_TRUE(test::same_bits(pi[lane], pi_of(viscosity, vx[lane], r2[lane], rho[lane])));
  }
}

TEST(LinearArtificialViscosity, HasTheBitsOfTheGeneralOneWithoutBeta) {
  constexpr ArtificialViscosity general{.alpha = 0.1, .beta = 0, .sound_speed = 50, .smoothing_length = 3e-5};
  const LinearArtificialViscosity linear(general);
  test::RandomNumbers random(17);
  for (int k = 0; k < 1000; ++k) {
    // From impact to the first breath of a wave, far below what a double can hold in full.
    const double product = random.between(-1, 1) * std::pow(10.0, random.between(-322, 0));
    const double density_sum = random.between(1900, 2100), inverse = random.between(1e5, 1e9);
    EXPECT_TRUE(test::same_bits(linear(product, density_sum, inverse), general(product, density_sum, inverse)))
        << product;
  }
}

}  // namespace
}  // namespace sphdrop
