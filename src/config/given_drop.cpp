#include "config/given_drop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace sphdrop {
namespace {

double density_of(const Case& one) {
  const bool is_rigid = one.drop.material == DropMaterial::rigid && !std::isnan(one.drop.density);
  return is_rigid ? one.drop.density : one.fluid.density;
}

// Of the circle of the particles' area, m.
double equivalent_diameter(const Case& one) {
  const GivenParticles& given = *one.drop.given.particles;
  const double d = one.resolution.spacing;
  const double area =
      given.mass.empty() ? static_cast<double>(given.size()) * d * d : given.total_mass() / density_of(one);
  return std::sqrt(4 * area / std::numbers::pi);
}

// The liquid would be pressed together or torn at once.
std::string mass_mistake(const Case& one) {
  constexpr double tolerance = 0.1;
  const GivenParticles& given = *one.drop.given.particles;
  const double d = one.resolution.spacing, expected = density_of(one) * d * d;
  const double mean = given.total_mass() / static_cast<double>(given.size());
  if (given.mass.empty() || std::isnan(expected) || std::abs(mean - expected) <= tolerance * expected) return "";
  return fmt::format(
      "drop.particles_file: the masses of {} are {:.4g} kg/m in the mean, and particles {:g} m apart of {:g} kg/m3 "
      "have {:.4g} kg/m; leave the masses out and they get that",
      given.file, mean, d, density_of(one), expected);
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
  const auto shown = [&](double own) { return std::abs(own) < tolerance ? 0.0 : own; };
  if (wrong != nullptr)
    return fmt::format(
        "{} moves the drop, and drop.placement = \"file\" leaves it where {} has it, at x = {:.6g} m, y = {:.6g} m; "
        "leave one of them out",
        wrong, drop.given->file, shown(centre.x), shown(centre.y));
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
  std::string mistake = mass_mistake(one);
  return mistake.empty() ? take_place(one, is_given) : mistake;
}

}  // namespace sphdrop
