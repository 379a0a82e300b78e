#include "config/solid_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "config/derived_defaults.hpp"
#include "config/polygon.hpp"

namespace sphdrop {
namespace {

Verdict polygon_of_another_kind(const Case& values) {
  if (values.solid.has_polygon() || values.solid.polygon.empty()) return {};
  return "solid.polygon needs solid.kind = \"polygon\" (elastic) or \"obstacle\" (rigid)";
}

Verdict polygon_is_none(const Case& values) {
  if (!values.solid.has_polygon()) return {};
  if (values.solid.polygon.empty())
    return "solid.polygon is missing: give the corners of the outline, [[x, y], [x, y], ...] in m";
  const auto mistake = polygon_mistake(values.solid.polygon);
  return mistake ? Verdict("solid.polygon " + *mistake) : Verdict();
}

Verdict polygon_too_small(const Case& values) {
  const double d = values.resolution.spacing;
  if (!values.solid.has_polygon() || polygon_mistake(values.solid.polygon)) return {};
  const double area = area_of(values.solid.polygon);
  // Twice the area over the perimeter is the mean distance between the sides of a long body.
  const double width = 2 * area / perimeter_of(values.solid.polygon);
  if (width >= 2 * d) return {};
  return fmt::format(
      "solid.polygon has an area of {:.4g} m2 and is {:.3g} m thick in the mean, less than 2 spacings of {} m; take "
      "resolution.spacing <= {:.4g} m, or check the units (m) of its corners",
      area, width, d, values.solid.kind == SolidKind::obstacle ? width / 2 : width / 4);
}

Verdict clamps_of_another_kind(const Case& values) {
  if (values.solid.clamps.empty() || values.solid.kind == SolidKind::polygon) return {};
  return "solid.clamps needs solid.kind = \"polygon\": a cantilever or fixed_fixed_beam has its own "
         "(solid.clamp_length), a wall or an obstacle does not move";
}

Verdict clamp_is_no_region(const Case& values) {
  for (std::size_t k = 0; k < values.solid.clamps.size(); ++k) {
    const Points& region = values.solid.clamps[k];
    if (region.size() == 2) {
      if (region[0].x != region[1].x && region[0].y != region[1].y) continue;
      return fmt::format("solid.clamps: region {} is a box without area; its two points are opposite corners", k + 1);
    }
    if (const auto mistake = polygon_mistake(region)) return fmt::format("solid.clamps: region {} {}", k + 1, *mistake);
  }
  return {};
}

Verdict supports_of_a_rigid_solid(const Case& values) {
  const Case::Solid& solid = values.solid;
  if (solid.is_elastic()) return {};
  const char* key = !solid.pinned.empty()      ? "solid.pinned"
                    : !solid.held_in_x.empty() ? "solid.held_in_x"
                    : !solid.held_in_y.empty() ? "solid.held_in_y"
                    : !solid.probe.empty()     ? "solid.probe"
                                               : nullptr;
  if (key == nullptr) return {};
  return std::string(key) +
         " needs an elastic solid (solid.kind = \"cantilever\", \"fixed_fixed_beam\" or "
         "\"polygon\"): nothing else moves";
}

Verdict lattice_without_direction(const Case& values) {
  const Case::Solid& solid = values.solid;
  if (solid.lattice_x == 0 && solid.lattice_y == 0)
    return "solid.lattice_direction = [0, 0] is no direction; [1, 0] is the usual one";
  if (solid.kind == SolidKind::polygon || solid.lattice_y == 0) return {};
  return "solid.lattice_direction needs solid.kind = \"polygon\": the lattice of a straight beam lies along it";
}

Verdict damping_ratio_of_a_polygon(const Case& values) {
  if (values.solid.kind != SolidKind::polygon || values.solid.damping_ratio == 0) return {};
  return "solid.damping_ratio needs a straight beam, whose first frequency is known; give solid.damping_rate = 2 "
         "damping_ratio omega with the omega you know";
}

Verdict none_among_several(const Case& values) {
  if (values.more_solids.empty()) return {};
  for (std::size_t k = 0; k < values.solid_count(); ++k)
    if (values.solid_at(k).kind == SolidKind::none)
      return fmt::format("solid {} of {} has solid.kind = \"none\"; give its kind or leave the section out", k + 1,
                         values.solid_count());
  return {};
}

bool are_alike(const Case::Solid& a, const Case::Solid& b) {
  return a.density == b.density && a.youngs_modulus == b.youngs_modulus && a.poisson_ratio == b.poisson_ratio &&
         a.material_law == b.material_law && a.deviatoric_trace == b.deviatoric_trace &&
         a.artificial_viscosity_alpha == b.artificial_viscosity_alpha &&
         a.artificial_viscosity_beta == b.artificial_viscosity_beta &&
         a.artificial_stress_coefficient == b.artificial_stress_coefficient && a.viscous_time == b.viscous_time;
}

// Kernel sums run over all solid particles with one set of constants; a mesh of cells has its own.
Verdict materials_that_sums_cannot_mix(const Case& values) {
  const Case::Solid* first = nullptr;
  for (std::size_t k = 0; k < values.solid_count(); ++k) {
    const Case::Solid& one = values.solid_at(k);
    if (!one.is_elastic()) continue;
    if (first == nullptr) {
      first = &one;
    } else if (one.formulation != first->formulation) {
      return fmt::format("all elastic solids need the same solid.formulation, and that of solid {} is another", k + 1);
    } else if (one.formulation != SolidFormulation::cells && !are_alike(one, *first)) {
      return fmt::format(
          "solid {} is of another material than the elastic one before it: that needs solid.formulation = \"cells\" "
          "for all of them (mode = \"modern\")",
          k + 1);
    }
  }
  return {};
}

Verdict nothing_holds_it(const Case& values) {
  const Case::Solid& solid = values.solid;
  if (solid.kind != SolidKind::polygon || !solid.clamps.empty() || !solid.pinned.empty()) return {};
  if (!solid.held_in_x.empty() && solid.held_in_y.size() > 1) return {};
  if (!solid.held_in_y.empty() && solid.held_in_x.size() > 1) return {};
  return "nothing holds the polygon against motion as a whole; give solid.clamps, or solid.pinned, solid.held_in_x and "
         "solid.held_in_y";
}

Verdict few_rows_in_the_mean(const Case& values) {
  const Case::Solid& solid = values.solid;
  if (solid.kind != SolidKind::polygon || solid.polygon.empty()) return {};
  const double width = 2 * area_of(solid.polygon) / perimeter_of(solid.polygon), d = values.resolution.spacing;
  if (width >= 4 * d) return {};
  return fmt::format(
      "the polygon is {:.3g} particles thick in the mean; bending needs at least 4: take resolution.spacing <= {:.4g} "
      "m",
      width / d, width / 4);
}

/// The slope of the polygon's sides, from the nearer of the lattice's two directions, in the mean over their length.
double obliqueness(const Case::Solid& solid) {
  double along = 0, across = 0;
  const double scale = std::sqrt(solid.lattice_x * solid.lattice_x + solid.lattice_y * solid.lattice_y);
  for (std::size_t k = 0; k < solid.polygon.size(); ++k) {
    const Point &a = solid.polygon[k], &b = solid.polygon[(k + 1) % solid.polygon.size()];
    const double x = ((b.x - a.x) * solid.lattice_x + (b.y - a.y) * solid.lattice_y) / scale;
    const double y = ((b.y - a.y) * solid.lattice_x - (b.x - a.x) * solid.lattice_y) / scale;
    along += std::max(std::abs(x), std::abs(y));
    across += std::min(std::abs(x), std::abs(y));
  }
  return along > 0 ? across / along : 0;
}

Verdict oblique_to_the_lattice(const Case& values) {
  const Case::Solid& solid = values.solid;
  if (solid.kind != SolidKind::polygon || (solid.lattice_x == 0 && solid.lattice_y == 0)) return {};
  const double slope = obliqueness(solid);
  if (slope < 0.2) return {};
  return fmt::format(
      "the polygon's sides are oblique to its lattice, by a slope of {:.2g} in the mean: bending is then too soft by "
      "some "
      "percent at few particles across; take the direction of its long sides as solid.lattice_direction, or a smaller "
      "resolution.spacing",
      slope);
}

// With its clamps, at the start, m.
Extent extent_of_solid(const Case::Solid& solid, double spacing) {
  Extent box = extent_of(solid.polygon);
  const double clamp = solid.clamp_length;
  if (solid.kind == SolidKind::cantilever) box = {{-clamp, 0}, {solid.length, solid.thickness}};
  if (solid.kind == SolidKind::fixed_fixed_beam) box = {{-clamp, 0}, {solid.length + clamp, solid.thickness}};
  if (solid.kind == SolidKind::rigid_wall) box = {{-solid.length / 2, -spacing}, {solid.length / 2, 0}};
  return {{box.low.x + solid.origin_x, box.low.y + solid.origin_y},
          {box.high.x + solid.origin_x, box.high.y + solid.origin_y}};
}

Verdict solids_that_may_meet(const Case& values) {
  for (std::size_t j = 0; j < values.solid_count(); ++j)
    for (std::size_t k = j + 1; k < values.solid_count(); ++k) {
      const Case::Solid &one = values.solid_at(j), &other = values.solid_at(k);
      if (!one.is_elastic() && !other.is_elastic()) continue;
      const Extent a = extent_of_solid(one, values.resolution.spacing),
                   b = extent_of_solid(other, values.resolution.spacing);
      const double apart_x = std::max(b.low.x - a.high.x, a.low.x - b.high.x);
      const double apart_y = std::max(b.low.y - a.high.y, a.low.y - b.high.y);
      const double reach = 0.5 * ((one.is_elastic() ? one.length : 0.0) + (other.is_elastic() ? other.length : 0.0));
      if (std::max(apart_x, apart_y) >= reach) continue;
      return fmt::format(
          "the solids {} and {} are so near that they may meet: nothing keeps solids from passing through each other; "
          "look at the run's snapshots",
          j + 1, k + 1);
    }
  return {};
}

}  // namespace

const std::vector<Check>& solid_contradictions() {
  static const std::vector<Check> checks = {
      {{"solid.polygon", "solid.kind"}, polygon_of_another_kind},
      {{"solid.polygon", "solid.kind"}, polygon_is_none},
      {{"solid.polygon", "solid.kind", "resolution.spacing"}, polygon_too_small},
      {{"solid.clamps", "solid.kind"}, clamps_of_another_kind},
      {{"solid.clamps"}, clamp_is_no_region},
      {{"solid.pinned", "solid.held_in_x", "solid.held_in_y", "solid.probe", "solid.kind"}, supports_of_a_rigid_solid},
      {{"solid.lattice_direction", "solid.kind"}, lattice_without_direction},
      {{"solid.damping_ratio", "solid.kind"}, damping_ratio_of_a_polygon},
      {{"solid.kind"}, none_among_several},
      {{"solid.formulation", "solid.youngs_modulus", "solid.poisson_ratio", "solid.density"},
       materials_that_sums_cannot_mix},
  };
  return checks;
}

const std::vector<Check>& solid_doubts() {
  static const std::vector<Check> checks = {
      {{"solid.clamps", "solid.pinned", "solid.held_in_x", "solid.held_in_y"}, nothing_holds_it},
      {{"solid.lattice_direction", "solid.polygon", "resolution.spacing"}, oblique_to_the_lattice},
      {{"resolution.spacing", "solid.polygon"}, few_rows_in_the_mean},
      {{"solid.kind", "solid.origin"}, solids_that_may_meet},
  };
  return checks;
}

}  // namespace sphdrop
