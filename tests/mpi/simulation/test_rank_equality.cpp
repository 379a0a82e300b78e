// The same case on all ranks together and on one alone: every particle's state and everything observed must be the same
// bits, whatever the partition and however often it changes.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/equal_states.hpp"

namespace sphdrop {
namespace {

using test::expect_equal;
using test::run_steps;
using test::WholeState;

struct EqualityCase {
  const char* name;
  const char* text;
  int steps;
  /// The state's hash after these steps, recorded once: any compiler, vector width and machine must give it. It changes
  /// only where the arithmetic is meant to change.
  std::uint64_t recorded_hash;
};

// Drops start so near and so fast that they are in full contact within the steps run.
constexpr const char* cantilever = R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
sound_cfl = 0.3
[drop]
diameter = 0.6e-3
velocity = [0.2, -3.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 2e-3
[gravity]
acceleration = [1.0, -9.81]
)";

constexpr const char* fixed_fixed = R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
sound_cfl = 0.3
[drop]
diameter = 0.6e-3
arrangement = "lattice"
velocity = [0.0, -3.0]
gap = 1e-6
[solid]
kind = "fixed_fixed_beam"
length = 2e-3
artificial_stress_coefficient = 0.0
deviatoric_trace = "two_dimensional"
[surface_tension]
form = "curvature"
)";

constexpr const char* rigid_wall = R"(
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
[surface_tension]
form = "curvature"
polynomial_points = 5
)";

// Velocities reach the contact too.
constexpr const char* resisting_contact = R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
sound_cfl = 0.3
[drop]
diameter = 0.6e-3
velocity = [0.4, -2.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 2e-3
[contact]
stiffness_form = "fixed"
damping_ratio = 0.1
wall_drag = 20.0
)";

// The curve's forces act on the beam, over its free end too, from the first instant on.
constexpr const char* wetted_cantilever = R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
sound_cfl = 0.3
[drop]
diameter = 0.6e-3
velocity = [0.2, -2.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 2e-3
[surface_tension]
contact_angle = 40.0
[contact]
stiffness_form = "fixed"
wall_drag = 1.0
)";

constexpr const char* wetted_wall = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
sound_cfl = 0.3
[drop]
diameter = 0.8e-3
velocity = [0.0, -1.0]
centre_x = 0.7e-3
gap = 1e-6
[solid]
kind = "rigid_wall"
length = 2e-3
[surface_tension]
contact_angle = 120.0
detection_displacement = 0.1
)";

constexpr const char* oscillating_drop = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
[drop]
oscillation_velocity = 1.5
)";

constexpr const char* square_drop = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
[drop]
shape = "square"
diameter = 0.6e-3
)";

// They meet within the steps run.
constexpr const char* two_drops = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
sound_cfl = 0.25
[[drop]]
diameter = 0.5e-3
velocity = [4, 0]
[[drop]]
shape = "ellipse"
aspect_ratio = 2
diameter = 0.5e-3
velocity = [-4, 0]
centre_x = 0.66e-3
centre_y = 0.1e-3
)";

constexpr const char* free_vibration = R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
[drop]
shape = "none"
[solid]
kind = "cantilever"
length = 2e-3
initial_tip_velocity = 2.0
)";

constexpr const char* rigid_ball = R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
sound_cfl = 0.3
[drop]
material = "rigid"
density = 1500.0
diameter = 0.6e-3
velocity = [0.2, -3.0]
initial_spin = 5000.0
gap = 1e-6
[solid]
kind = "cantilever"
length = 2e-3
[gravity]
acceleration = [1.0, -9.81]
)";

// So soft that the beam goes down by several spacings under the drop, and its free end with it.
constexpr const char* modern_beam = R"(
mode = "modern"
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
[drop]
diameter = 0.6e-3
velocity = [0.2, -3.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 2e-3
youngs_modulus = 6e6
[gravity]
acceleration = [1.0, -9.81]
)";

constexpr const char* damped_cells = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
sound_cfl = 0.3
[drop]
diameter = 0.6e-3
velocity = [0.0, -3.0]
gap = 1e-6
[solid]
kind = "fixed_fixed_beam"
length = 2e-3
youngs_modulus = 20e6
formulation = "cells"
material_law = "neo_hookean"
damping_ratio = 0.1
viscous_time = 1e-8
)";

// Thick enough to be cut lengthwise too.
constexpr const char* total_lagrangian = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
sound_cfl = 0.3
[drop]
diameter = 0.6e-3
velocity = [0.0, -3.0]
gap = 1e-6
[solid]
kind = "fixed_fixed_beam"
length = 1.5e-3
thickness = 0.5e-3
youngs_modulus = 20e6
formulation = "total_lagrangian"
material_law = "neo_hookean"
damping_ratio = 0.1
viscous_time = 1e-8
)";

// Half of it over the end of the wall.
constexpr const char* rigid_square = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
[drop]
material = "rigid"
shape = "square"
diameter = 0.6e-3
velocity = [0.0, -1.0]
gap = 1e-6
centre_x = 0.975e-3
[solid]
kind = "rigid_wall"
length = 2e-3
)";

// Fewer cells than ranks: some ranks hold nothing.
constexpr const char* tiny_drop = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
[drop]
diameter = 0.2e-3
velocity = [0.0, -1.0]
)";

// Everything that makes the liquid a modern one; by the end half a dozen shifts a redistribution.
constexpr const char* modern_wall = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
sound_cfl = 0.2
capillary_cfl = 0.2
[fluid]
viscosity_form = "physical"
gauge_pressure = "on"
gauge_relaxation_time = 5e-6
shifting = "on"
[drop]
diameter = 0.8e-3
velocity = [0.0, -2.0]
gap = 1e-6
[solid]
kind = "rigid_wall"
)";

// The other choices; the drop starts half way.
constexpr const char* relaxed_drop = R"(
[resolution]
spacing = 0.05e-3
smoothing_ratio = 1.5
kernel = "wendland_c2"
[time]
end = 1e-3
sound_cfl = 0.2
capillary_cfl = 0.2
[fluid]
viscosity_form = "physical"
density_treatment = "density_diffusion"
gauge_pressure = "on"
shifting = "on"
shifting_interval = 3
[drop]
diameter = 0.8e-3
relaxation_time = 30e-6
oscillation_velocity = 1.5
velocity = [0.5, 0.0]
)";

// Wendland's kernel under the artificial viscosity.
constexpr const char* wendland_beam = R"(
[resolution]
spacing = 0.0625e-3
smoothing_ratio = 1.3
kernel = "wendland_c2"
[time]
end = 1e-3
sound_cfl = 0.3
[fluid]
density_treatment = "none"
gauge_pressure = "on"
[drop]
diameter = 0.6e-3
velocity = [0.2, -3.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 2e-3
artificial_stress_coefficient = 0.0
)";

class RankEquality : public testing::TestWithParam<EqualityCase> {};

TEST_P(RankEquality, AllRanksTogetherGiveWhatOneGivesAlone) {
  const EqualityCase& c = GetParam();
  test::expect_case_equal_on_ranks(c.text, c.steps, c.recorded_hash);
}

// Lists that reach further hold more pairs out of range, and age longer; neither may show.
TEST(ListEquality, TheSkinDoesNotMatter) {
  const Communicator world(MPI_COMM_WORLD);
  const WholeState thin = run_steps(world, cantilever, 200, {"parallel.skin=0.1"});
  const WholeState thick = run_steps(world, cantilever, 200, {"parallel.skin=0.7"});
  EXPECT_GT(thin.redistributions, thick.redistributions);
  expect_equal(thin, thick, "skin");
}

TEST(ListEquality, NorDoesItForCells) {
  const Communicator world(MPI_COMM_WORLD);
  const WholeState thin = run_steps(world, modern_beam, 300, {"parallel.skin=0.1"});
  const WholeState thick = run_steps(world, modern_beam, 300, {"parallel.skin=0.7"});
  EXPECT_GT(thin.redistributions, thick.redistributions);
  expect_equal(thin, thick, "skin");
}

// Nor may the size of the cells that are dealt out: as few of them as ranks, several lists' reach wide.
TEST(CellEquality, TheCellsDoNotMatter) {
  const Communicator world(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  for (const char* text : {cantilever, oscillating_drop, modern_wall, rigid_ball}) {
    const WholeState fine = run_steps(self, text, 150);
    const WholeState coarse =
        run_steps(world, text, 150, {"parallel.cells_per_process=1", "parallel.repartition_interval=29"});
    if (world.rank() == 0) {
      EXPECT_GT(coarse.redistributions, fine.redistributions);
      expect_equal(fine, coarse, text);
    }
  }
}

TEST(Equality, AnotherCaseHasAnotherHash) {
  const Communicator world(MPI_COMM_WORLD);
  const WholeState one = run_steps(world, cantilever, 20);
  const WholeState other = run_steps(world, cantilever, 20, {"drop.velocity=[0.2, -2.9999999]"});
  EXPECT_NE(one.hash, other.hash);
}

INSTANTIATE_TEST_SUITE_P(Cases, RankEquality,
                         testing::Values(EqualityCase{"cantilever", cantilever, 400, 0x1ae4f7199c2c265d},
                                         EqualityCase{"fixed_fixed", fixed_fixed, 300, 0xba133bd81299003b},
                                         EqualityCase{"rigid_wall", rigid_wall, 300, 0x05099cca370879b8},
                                         EqualityCase{"resisting_contact", resisting_contact, 300, 0x9b54e3511de240dc},
                                         EqualityCase{"wetted_cantilever", wetted_cantilever, 400, 0x204cae63d459b007},
                                         EqualityCase{"wetted_wall", wetted_wall, 300, 0xa13a01f0ab0c0f15},
                                         EqualityCase{"oscillating_drop", oscillating_drop, 200, 0x10767d66cf98d385},
                                         EqualityCase{"square_drop", square_drop, 150, 0x523fc3a1d17f4e1d},
                                         EqualityCase{"free_vibration", free_vibration, 200, 0x4559d4d28dc930db},
                                         EqualityCase{"tiny_drop", tiny_drop, 100, 0xb48e0b3cc3461e2b},
                                         EqualityCase{"rigid_ball", rigid_ball, 400, 0x16f5c0d39849342a},
                                         EqualityCase{"rigid_square", rigid_square, 400, 0xbf61398f3fbc045d},
                                         EqualityCase{"modern_beam", modern_beam, 400, 0x244a78e680ee648d},
                                         EqualityCase{"total_lagrangian", total_lagrangian, 300, 0x947da3d26bfad5c7},
                                         EqualityCase{"damped_cells", damped_cells, 300, 0x6796322f3a8746e5},
                                         EqualityCase{"two_drops", two_drops, 200, 0x259449168e48b2b6},
                                         EqualityCase{"modern_wall", modern_wall, 300, 0x93fd3f953c910025},
                                         EqualityCase{"relaxed_drop", relaxed_drop, 200, 0xb39fe73f4dddca67},
                                         EqualityCase{"wendland_beam", wendland_beam, 200, 0x17f379e48b7104c4}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace sphdrop
