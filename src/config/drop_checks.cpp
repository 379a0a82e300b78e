#include "config/drop_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace sphdrop {
namespace {

Verdict file_of_another_shape(const Case& values) {
  if (values.drop.particles_file.empty() || values.drop.shape == DropShape::particles) return {};
  return "drop.particles_file gives the drop's shape; leave out drop.shape, or the file";
}

Verdict particles_without_file(const Case& values) {
  if (values.drop.shape != DropShape::particles || !values.drop.particles_file.empty()) return {};
  return "drop.shape = \"particles\" needs drop.particles_file, the file that holds them";
}

Verdict checksum_without_file(const Case& values) {
  if (values.drop.particles_checksum.empty() || !values.drop.particles_file.empty()) return {};
  return "drop.particles_checksum is given but there is no drop.particles_file";
}

Verdict place_without_file(const Case& values) {
  if (values.drop.placement != DropPlacement::file || values.drop.shape == DropShape::particles) return {};
  return "drop.placement = \"file\" needs drop.particles_file: it is the place that the file's particles have";
}

Verdict velocities_at_rest(const Case& values) {
  if (!values.drop.given || !values.drop.given->has_velocities() || values.drop.relaxation_time == 0) return {};
  return fmt::format(
      "drop.relaxation_time lets the drop come to rest before it starts, and {} has velocities; leave out one of them",
      values.drop.given->file);
}

Verdict velocities_of_a_rigid_drop(const Case& values) {
  if (!values.drop.given || !values.drop.given->has_velocities() || !values.drop.is_rigid()) return {};
  return fmt::format(
      "drop.material = \"rigid\" takes the drop's motion from drop.velocity and drop.initial_spin, and {} has "
      "velocities "
      "of each particle; leave them out",
      values.drop.given->file);
}

// Particles that stand for much more or less than the lattice's square would be pressed together or torn at once.
Verdict another_area(const Case& values) {
  constexpr double tolerance = 0.1;
  if (!values.drop.given || !values.drop.given->mass.empty()) return {};
  const double own =
      static_cast<double>(values.drop.given->size()) * values.resolution.spacing * values.resolution.spacing;
  const double given = std::numbers::pi / 4 * values.drop.diameter * values.drop.diameter;
  if (std::abs(given - own) <= tolerance * own) return {};
  return fmt::format(
      "drop.diameter = {} m is that of a circle of {:.4g} m2, and the {} particles of {} have {:.4g} m2 together, one "
      "resolution.spacing squared each; leave the diameter out ({:.4g} m then), or give particles that fill its area",
      values.drop.diameter, given, values.drop.given->size(), values.drop.given->file, own,
      std::sqrt(4 / std::numbers::pi * own));
}

}  // namespace

const std::vector<Check>& drop_contradictions() {
  static const std::vector<Check> checks = {
      {{"drop.particles_file", "drop.shape"}, file_of_another_shape},
      {{"drop.shape", "drop.particles_file"}, particles_without_file},
      {{"drop.particles_checksum", "drop.particles_file"}, checksum_without_file},
      {{"drop.placement", "drop.particles_file"}, place_without_file},
      {{"drop.relaxation_time", "drop.particles_file"}, velocities_at_rest},
      {{"drop.material", "drop.particles_file"}, velocities_of_a_rigid_drop},
      {{"drop.diameter", "drop.particles_file", "resolution.spacing"}, another_area},
  };
  return checks;
}

}  // namespace sphdrop
