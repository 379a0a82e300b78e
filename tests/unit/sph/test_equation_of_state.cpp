#include <gtest/gtest.h>

#include "particles/pack.hpp"
#include "sph/equation_of_state.hpp"

namespace sphdrop {
namespace {

TEST(EquationOfState, IsLinearInDensity) {
  EXPECT_EQ(equation_of_state_pressure(1000.0, 50.0, 1000.0), 0.0);
  EXPECT_EQ(equation_of_state_pressure(1001.0, 50.0, 1000.0), 2500.0);
  EXPECT_EQ(equation_of_state_pressure(998.0, 50.0, 1000.0), -5000.0);
  EXPECT_EQ(equation_of_state_pressure(Pack(1002.0), 500.0, 1000.0)[0], 500000.0);
}

// A solid's c^2 = K/rho0: compressed by 1 % it answers with 1 % of its bulk modulus.
TEST(EquationOfState, HasTheBulkModulusOfTheSoundSpeed) {
  EXPECT_NEAR(equation_of_state_pressure(1010.0, 500.0, 1000.0), 0.01 * 250e6, 1e-6);
}

}  // namespace
}  // namespace sphdrop
