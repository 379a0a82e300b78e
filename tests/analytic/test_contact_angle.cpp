// A drop that wets a solid: its shape at rest, and the balance of momentum with a beam that bends under it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "surface_tension/boundary_detection.hpp"
#include "tests/support/watched_run.hpp"

namespace sphdrop {
namespace {

using test::watch;
using test::WatchedRun;

constexpr double spacing = 0.05e-3;

/// A drop of 1 mm, set down on a wall, in a liquid viscous enough to come to rest soon.
WatchedRun settled(double contact_angle, const std::function<void(const Simulation&)>& each_step) {
  return watch(fmt::format(R"(
[resolution]
spacing = {}
[time]
end = 7.5e-3
sound_cfl = 0.3
[fluid]
artificial_viscosity_alpha = 1.0
[solid]
kind = "rigid_wall"
[surface_tension]
contact_angle = {}
[contact]
stiffness_form = "fixed"
)",
                           spacing, contact_angle),
               1e-4, each_step);
}

/// The liquid's boundary particles.
std::vector<Vector> outline(const Simulation& simulation) {
  const FluidParticles& liquid = simulation.fluid();
  std::vector<Vector> positions;
  std::vector<std::int64_t> ids;
  liquid.for_each_owned([&](std::size_t row) {
    positions.push_back(liquid.position.at(row));
    ids.push_back(liquid.id[row]);
  });
  ArcFinder finder(2.0 * 1.2 * spacing);
  std::vector<Vector> boundary;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    std::vector<Vector> others = positions;
    std::vector<std::int64_t> other_ids = ids;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    other_ids.erase(other_ids.begin() + static_cast<std::ptrdiff_t>(i));
    std::vector<Arc> arcs;
    finder.find(ids[i], positions[i], other_ids, others, arcs);
    if (!arcs.empty()) boundary.push_back(positions[i]);
  }
  return boundary;
}

/// The angle in degrees at which the circle through the outline, but for what is near the wall at y = 0, meets the
/// wall.
double measured_angle(const Simulation& simulation) {
  std::vector<Vector> points;
  Vector mean;
  for (const Vector& p : outline(simulation))
    if (p.y > 2.0 * spacing) {
      points.push_back(p);
      mean += p;
    }
  mean = mean / static_cast<double>(points.size());
  // Kasa's fit: 2 a x + 2 b y + c = x^2 + y^2 in coordinates about the mean, so that c is the mean of x^2 + y^2.
  double xx = 0, xy = 0, yy = 0, x_square = 0, y_square = 0, square = 0;
  for (const Vector& point : points) {
    const Vector p = point - mean;
    xx += p.x * p.x;
    xy += p.x * p.y;
    yy += p.y * p.y;
    x_square += p.x * squared_length(p);
    y_square += p.y * squared_length(p);
    square += squared_length(p);
  }
  const double determinant = 2.0 * (xx * yy - xy * xy);
  const Vector centre{(x_square * yy - y_square * xy) / determinant, (y_square * xx - x_square * xy) / determinant};
  const double radius = std::sqrt(square / static_cast<double>(points.size()) + squared_length(centre)) + 0.5 * spacing;
  return std::acos(-(mean.y + centre.y) / radius) * 180.0 / std::numbers::pi;
}

TEST(SessileDrop, TakesTheContactAngle) {
  constexpr double area = 0.25e-6 * std::numbers::pi;
  for (const double angle : {60.0, 90.0, 120.0}) {
    double measured = 0;
    const WatchedRun run = settled(angle, [&](const Simulation& simulation) {
      if (simulation.time() >= simulation.input().time.end) measured = measured_angle(simulation);
    });
    const Observation& last = run.last();
    EXPECT_NEAR(measured, angle, 2.0);
    EXPECT_LT(last.kinetic_fluid, 1e-4 * last.surface) << angle;  // at rest
    const double in_radians = angle * std::numbers::pi / 180.0;
    const double radius = std::sqrt(area / (in_radians - std::sin(in_radians) * std::cos(in_radians)));
    EXPECT_NEAR(last.base_width, 2.0 * radius * std::sin(in_radians), 4.0 * spacing) << angle;
    EXPECT_NEAR(last.adhesion / (-0.072 * (1.0 + std::cos(in_radians)) * last.base_width), 1.0, 1e-12);
    EXPECT_NEAR(last.drop_centre_x, 0.0, 0.1 * spacing) << angle;
    for (const Observation& row : run.rows)
      EXPECT_LT(std::abs(row.unaccounted), 0.001 * run.first().surface) << angle << " at " << row.time;
    EXPECT_TRUE(run.contact.gaps().empty());  // it never leaves
    EXPECT_NEAR(*run.contact.last_contact(), last.time, 1e-6);
  }
}

// Springs, adhesion and the couple on the beam's segments: what the drop loses, the beam gets.
TEST(WettingDrop, GivesACantileverWhatItLoses) {
  const WatchedRun run = watch(R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 0.4e-3
sound_cfl = 0.3
[drop]
diameter = 0.6e-3
velocity = [0.3, -0.8]
[solid]
kind = "cantilever"
length = 2e-3
[surface_tension]
contact_angle = 60.0
[contact]
stiffness_form = "fixed"
)",
                               2e-6);
  const Observation& first = run.first();
  const double momentum = std::hypot(first.momentum_fluid_x, first.momentum_fluid_y);
  double pull = 0, push = 0, sideways = 0;
  for (const Observation& row : run.rows) {
    EXPECT_NEAR(row.momentum_fluid_x + row.contact_impulse_x, first.momentum_fluid_x, 1e-11 * momentum) << row.time;
    EXPECT_NEAR(row.momentum_fluid_y + row.contact_impulse_y, first.momentum_fluid_y, 1e-11 * momentum) << row.time;
    pull = std::max(pull, row.contact_force_y);
    push = std::min(push, row.contact_force_y);
    sideways = std::max(sideways, std::abs(row.contact_impulse_x));
  }
  EXPECT_GT(pull, 0.0);  // before the springs meet, the drop draws the beam up
  EXPECT_LT(push, 0.0);
  EXPECT_GT(sideways, 1e-6 * momentum);  // the beam bends, and its end is round
  EXPECT_LT(run.last().deflection, -3e-6);
}

}  // namespace
}  // namespace sphdrop
