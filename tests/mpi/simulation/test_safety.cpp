// A state that must not be computed on stops all ranks at the same step with a text that names the particle.

#include <gtest/gtest.h>

#include "tests/support/whole_state.hpp"

namespace sphdrop {
namespace {

constexpr const char* drop_on_wall = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
[drop]
diameter = 0.8e-3
velocity = [0.0, -2.0]
gap = 1e-6
[solid]
kind = "rigid_wall"
)";

// The message, which must be the same on all ranks.
std::string message_of(const std::vector<std::string>& overrides, int steps) {
  const Communicator world(MPI_COMM_WORLD);
  std::string message;
  try {
    test::run_steps(world, drop_on_wall, steps, overrides);
  } catch (const SafetyError& error) {
    message = error.what();
  }
  std::string first = message;
  world.broadcast(first, 0);
  EXPECT_EQ(message, first);
  return message;
}

// A free end that flies up far faster than sound runs through the beam.
TEST(Safety, ABeamTurnedInsideOutIsNamed) {
  const std::string message = message_of(
      {"drop.shape=none", "drop.velocity=[0,0]", "drop.gap=auto", "solid.kind=cantilever", "solid.length=1e-3",
       "solid.formulation=cells", "solid.youngs_modulus=1e4", "solid.initial_tip_velocity=40"},
      4000);
  EXPECT_NE(message.find("the solid is turned inside out at particle "), std::string::npos) << message;
  EXPECT_NE(message.find("m in the undeformed body: its area there is -"), std::string::npos) << message;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Safety, ASoundRunIsNotStopped) {
  EXPECT_EQ(message_of({}, 100), "");
}

TEST(Safety, AParticleTooFastIsNamed) {
  const std::string message = message_of({"safety.speed_limit=1.9"}, 10);
  EXPECT_TRUE(contains(message, "faster than safety.speed_limit")) << message;
  EXPECT_TRUE(contains(message, "liquid particle 0 at (")) << message;
  EXPECT_TRUE(contains(message, "step 1,")) << message;
}

// A sound speed too large for the time step: the scheme is unstable and ends in infinities.
TEST(Safety, AnUnstableRunEndsWithADiagnosis) {
  const std::string message =
      message_of({"time.sound_cfl=1.0", "time.capillary_cfl=1.0", "time.viscous_cfl=1.0", "safety.speed_limit=1e6",
                  "fluid.artificial_viscosity_alpha=10", "contact.overlap_limit=1"},
                 4000);
  EXPECT_NE(message, "");
}

TEST(Safety, ADeepOverlapIsNamed) {
  const std::string message = message_of({"contact.stiffness=1e-6"}, 4000);
  EXPECT_TRUE(contains(message, "overlap of")) << message;
  EXPECT_TRUE(contains(message, "contact.overlap_limit")) << message;
  EXPECT_TRUE(contains(message, "liquid particle ")) << message;
}

TEST(Safety, AParticleThatLeavesTheDomainIsNamed) {
  const std::string message =
      message_of({"safety.domain_margin=1e-5", "drop.velocity=[3.0, 0.0]", "solid.kind=none"}, 4000);
  EXPECT_TRUE(contains(message, "left the domain")) << message;
}

}  // namespace
}  // namespace sphdrop
