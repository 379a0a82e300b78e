#include "setup/initial_state.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "setup/beam.hpp"
#include "setup/droplet.hpp"
#include "setup/given_drop.hpp"
#include "setup/holds.hpp"
#include "setup/polygon_body.hpp"
#include "setup/refusals.hpp"
#include "setup/several_solids.hpp"

namespace sphdrop {
namespace {

InitialSolid build_solid(const Case::Solid& solid, double spacing, Share share) {
  InitialSolid body;
  switch (solid.kind) {
    case SolidKind::cantilever:
    case SolidKind::fixed_fixed_beam:
      body = build_beam(solid, spacing, share);
      break;
    case SolidKind::rigid_wall:
      body = build_rigid_wall(solid, spacing);
      break;
    case SolidKind::polygon:
      body = build_polygon_body(solid, spacing);
      break;
    case SolidKind::obstacle:
      body = build_obstacle(solid, spacing);
      break;
    case SolidKind::none:
      return body;
  }
  if (solid.is_elastic()) {
    add_holds(solid, spacing, body);
    choose_probe(solid, spacing, body);
  }
  move_body(body, {solid.origin_x, solid.origin_y});
  return body;
}

bool is_of_cells(const Case::Solid& solid) {
  return solid.is_elastic() && solid.formulation == SolidFormulation::cells;
}

/// Of a straight beam, which is alone and whose supports and probes are those of its kind. Others' cells, supports and
/// probes are found by looking at all particles.
bool can_be_shared(const Case& input) {
  const Case::Solid& solid = input.solid;
  return input.solid_count() == 1 && solid.is_straight_beam() && solid.pinned.empty() && solid.held_in_x.empty() &&
         solid.held_in_y.empty() && solid.probe.empty();
}

std::vector<InitialSolid> build_solids(const Case& input, Share share) {
  if (!can_be_shared(input)) share = {};
  std::vector<InitialSolid> solids;
  for (std::size_t k = 0; k < input.solid_count(); ++k)
    solids.push_back(build_solid(input.solid_at(k), input.resolution.spacing, share));
  return solids;
}

/// About the origin.
Drop build_drop(const Case& input) {
  const double d = input.resolution.spacing;
  const double density = input.drop.is_rigid() ? input.drop.density : input.fluid.density;
  if (input.drop.shape == DropShape::none) return {};
  if (input.drop.shape == DropShape::particles) return drop_of_file(input);
  const bool is_round = input.drop.shape == DropShape::round;
  if (is_round && input.drop.arrangement == DropArrangement::rings)
    return round_drop_of_rings(0.5 * input.drop.diameter, d, density);
  Drop drop;
  if (is_round) {
    drop = round_drop_of_lattice(0.5 * input.drop.diameter, d, density);
  } else if (input.drop.shape == DropShape::ellipse) {
    const double stretch = std::sqrt(input.drop.aspect_ratio), radius = 0.5 * input.drop.diameter;
    drop = elliptic_drop(radius * stretch, radius / stretch, d, density);
  } else {
    drop = square_drop(input.drop.diameter, d, density);
  }
  // Jitter breaks the symmetric clumps of a liquid; a rigid drop has none, and keeps an even surface.
  if (input.drop.jitter != 0.0 && !input.drop.is_rigid()) drop.jitter(input.drop.jitter * d, input.drop.seed);
  return drop;
}

double drop_centre_x(const Case& input) {
  if (!std::isnan(input.drop.centre_x)) return input.drop.centre_x;
  switch (input.solid.kind) {
    case SolidKind::cantilever:
      return input.solid.length - 0.5 * input.drop.diameter;
    case SolidKind::fixed_fixed_beam:
      return 0.5 * input.solid.length;
    case SolidKind::rigid_wall:
    case SolidKind::polygon:
    case SolidKind::obstacle:
    case SolidKind::none:
      break;
  }
  return 0.0;
}

/// Rings end at R - d'/2, a jittered lattice somewhere near R: counted from the lowest particle, the first contact
/// comes at the same time whatever the arrangement.
double drop_centre_y(const Case& input, const Drop& drop, double centre_x, const std::vector<InitialSolid>& solids) {
  if (!input.has_solid() || input.drop.placement != DropPlacement::above_solid) return input.drop.centre_y;
  return height_above_solids(solids, drop, centre_x, input.drop.gap, 0.5 * input.resolution.spacing);
}

/// Of all drops, with the particles of one share.
InitialFluid fluid_of(const Case& input, const std::vector<PlacedDrop>& drops, Share share) {
  InitialFluid fluid;
  if (drops.empty()) return fluid;
  fluid.total = drops.back().ids().last;
  fluid.centre = drops.front().centre();
  const IdRange mine = share.of(fluid.total);
  const auto rows = static_cast<std::size_t>(mine.count());
  fluid.first_id = mine.first;
  fluid.positions.reserve(rows);
  fluid.velocities.reserve(rows);
  fluid.masses.reserve(rows);
  for (const PlacedDrop& drop : drops) {
    drop.append_to(fluid, mine);
    fluid.bounds.include(drop.bounds());
    drop.for_each([&](std::int64_t, Vector, double mass) { fluid.rest_area += mass / input.fluid.density; });
  }
  if (input.drop.is_rigid()) fluid.as_body = mass_properties(drops);
  return fluid;
}

}  // namespace

InitialState build_initial_state(const Case& input, Share share) {
  refuse_too_many_particles(input);
  InitialState state;
  const std::vector<InitialSolid> solids = build_solids(input, share);
  state.solid = joined_solids(solids);
  // Kernel sums make one body of what is nearer than their support.
  refuse_near_solids(state.solid, (input.any_solid(is_of_cells) ? 1.0 : 2.0 * input.resolution.smoothing_ratio) *
                                      input.resolution.spacing);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  state.drop_centre = {nan, nan};
  std::vector<PlacedDrop> drops;
  for (std::size_t k = 0; k < input.drop_count(); ++k) {
    const Case one = input.with_drop(k);
    Drop drop = build_drop(one);
    if (drop.count() == 0) continue;
    const double centre_x = drop_centre_x(one);
    const Vector centre{centre_x, drop_centre_y(one, drop, centre_x, solids)};
    if (k == 0) state.drop_centre = centre;
    if (one.drop.given)
      if (std::string doubt = doubt_of_file(one); !doubt.empty()) state.warnings.push_back(std::move(doubt));
    drops.emplace_back(one, std::move(drop), centre, drops.empty() ? 0 : drops.back().ids().last);
  }
  refuse_overlapping_drops(drops, input.resolution.spacing);
  refuse_overlap(input, drops, state.solid, state.drop_centre);
  state.fluid = fluid_of(input, drops, share);
  return state;
}

}  // namespace sphdrop
