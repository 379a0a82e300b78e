#include "config/given_drop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace sphdrop {
namespace {

// Of the circle of the particles' area, m.
double equivalent_diameter(const Case& one) {
  const GivenParticles& given = *one.drop.given.particles;
  const double d = one.resolution.spacing;
  const bool is_rigid = one.drop.material == DropMaterial::rigid && !std::isnan(one.drop.density);
  const double density = is_rigid ? one.drop.density : one.fluid.density;
  const double area = given.mass.empty() ? static_cast<double>(given.size()) * d * d : given.total_mass() / density;
  return std::sqrt(4 * area / std::numbers::pi);
}

std::string take_place(Case& one, const IsGiven& is_given) {
  Case::Drop& drop = one.drop;
  const bool is_placed =
      is_given("drop.placement") || is_given("drop.centre_x") || is_given("drop.centre_y") || is_given("drop.gap");
  if (!is_placed) drop.placement = DropPlacement::file;
  if (drop.placement != DropPlacement::file) return "";
  const Point centre = drop.given->centre();
  const double tolerance = 1e-6 * one.resolution.spacing;
  const auto differs = [&](std::string_view key, double given, double own) {
    return is_given(key) && !std::isnan(given) && std::abs(given - own) > tolerance;
  };
  const char* wrong = differs("drop.centre_x", drop.centre_x, centre.x)   ? "drop.centre_x"
                      : differs("drop.centre_y", drop.centre_y, centre.y) ? "drop.centre_y"
                                                                          : nullptr;
  if (wrong != nullptr)
    return fmt::format(
        "{} moves the drop, and drop.placement = \"file\" leaves it where {} has it, at x = {:.6g} m, y = {:.6g} m; "
        "leave one of them out",
        wrong, drop.given->file, centre.x, centre.y);
  drop.centre_x = centre.x;
  drop.centre_y = centre.y;
  return "";
}

}  // namespace

std::string particle_file_path(const std::string& named, const std::string& case_file) {
  return (std::filesystem::path(case_file).parent_path() / named).lexically_normal().string();
}

void take_shape(Case::Drop& drop, const IsGiven& is_given) {
  if (!drop.particles_file.empty() && !is_given("drop.shape")) drop.shape = DropShape::particles;
}

std::string take_given_particles(Case& one, const IsGiven& is_given, std::shared_ptr<const GivenParticles> particles) {
  Case::Drop& drop = one.drop;
  if (!drop.particles_checksum.empty() && drop.particles_checksum != particles->checksum)
    return fmt::format(
        "drop.particles_checksum = \"{}\" is not that of {}, \"{}\": the file has changed since; take the old one, or "
        "leave the checksum out",
        drop.particles_checksum, particles->file, particles->checksum);
  drop.particles_checksum = particles->checksum;
  drop.particles_file = particles->path;
  drop.given.particles = std::move(particles);
  if (!is_given("drop.diameter")) {
    const double diameter = equivalent_diameter(one);
    if (diameter > 0) drop.diameter = diameter;  // not so where the spacing itself is wrong
  }
  return take_place(one, is_given);
}

}  // namespace sphdrop
