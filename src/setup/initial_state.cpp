#include "setup/initial_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/contact_solver.hpp"
#include "contact/contact_surface.hpp"
#include "rigid_body/rigid_body.hpp"
#include "setup/beam.hpp"
#include "setup/droplet.hpp"
#include "setup/given_drop.hpp"
#include "setup/holds.hpp"
#include "setup/polygon_body.hpp"
#include "setup/polygon_geometry.hpp"
#include "setup/setup_error.hpp"
#include "setup/several_solids.hpp"
#include "sph/cell_grid.hpp"

namespace sphdrop {
namespace {

/// Particles are numbered in 32 bits and first built on one process; a slipped decimal point in the spacing should say
/// so.
void refuse_too_many_particles(const Case& input) {
  constexpr double limit = 1e8;
  const double d = input.resolution.spacing;
  double count = 0.0;
  for (std::size_t k = 0; k < input.drop_count(); ++k) {
    const Case::Drop drop = input.with_drop(k).drop;
    if (drop.shape != DropShape::none) count += (drop.diameter / d) * (drop.diameter / d);
  }
  for (std::size_t k = 0; k < input.solid_count(); ++k) {
    const Case::Solid& solid = input.solid_at(k);
    const double length = solid.length / d;
    if (solid.kind == SolidKind::rigid_wall) count += length;
    if (solid.is_straight_beam())
      count += (length + 2.0 * solid.clamp_length / d) *
               (solid.thickness / d + 2.0 * static_cast<double>(solid.clamp_layers));
    if (solid.kind == SolidKind::polygon) count += std::abs(signed_area(counterclockwise_polygon(solid.polygon, d)));
  }
  if (count <= limit) return;
  throw SetupError(fmt::format(
      "a spacing of {:g} m makes about {:.2g} particles; at most {:.2g} can be set up: choose a larger spacing", d,
      count, limit));
}

InitialSolid build_solid(const Case::Solid& solid, double spacing) {
  InitialSolid body;
  switch (solid.kind) {
    case SolidKind::cantilever:
    case SolidKind::fixed_fixed_beam:
      body = build_beam(solid, spacing);
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

std::vector<InitialSolid> build_solids(const Case& input) {
  std::vector<InitialSolid> solids;
  for (std::size_t k = 0; k < input.solid_count(); ++k)
    solids.push_back(build_solid(input.solid_at(k), input.resolution.spacing));
  return solids;
}

/// About the origin.
DropParticles build_drop(const Case& input) {
  const double d = input.resolution.spacing;
  const double density = input.drop.is_rigid() ? input.drop.density : input.fluid.density;
  if (input.drop.shape == DropShape::none) return {};
  if (input.drop.shape == DropShape::particles) return drop_of_file(input);
  const bool is_round = input.drop.shape == DropShape::round;
  if (is_round && input.drop.arrangement == DropArrangement::rings)
    return round_drop_of_rings(0.5 * input.drop.diameter, d, density);
  DropParticles drop;
  if (is_round) {
    drop = round_drop_of_lattice(0.5 * input.drop.diameter, d, density);
  } else if (input.drop.shape == DropShape::ellipse) {
    const double stretch = std::sqrt(input.drop.aspect_ratio), radius = 0.5 * input.drop.diameter;
    drop = elliptic_drop(radius * stretch, radius / stretch, d, density);
  } else {
    drop = square_drop(input.drop.diameter, d, density);
  }
  // Jitter breaks the symmetric clumps of a liquid; a rigid drop has none, and keeps an even surface.
  if (input.drop.jitter != 0.0 && !input.drop.is_rigid())
    jitter_positions(drop.positions, input.drop.jitter * d, input.drop.seed);
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
double drop_centre_y(const Case& input, const DropParticles& drop, double centre_x,
                     const std::vector<InitialSolid>& solids) {
  if (!input.has_solid() || input.drop.placement != DropPlacement::above_solid) return input.drop.centre_y;
  return height_above_solids(solids, drop.positions, centre_x, input.drop.gap, 0.5 * input.resolution.spacing);
}

InitialFluid place_drop(const Case& input, const DropParticles& drop, Vector centre) {
  if (input.drop.oscillation_velocity != 0.0 && !(input.drop.oscillation_radius > 0.0))
    throw SetupError("an oscillating drop needs an oscillation radius greater than 0");
  InitialFluid fluid;
  fluid.masses = drop.masses;
  fluid.centre = centre;
  const Vector mass_centre = input.drop.is_rigid() ? mass_properties(drop.positions, drop.masses).centre : Vector{};
  // To the file's centre and back again they would be rounded.
  const GivenParticles* unmoved =
      input.drop.placement == DropPlacement::file ? input.drop.given.particles.get() : nullptr;
  for (std::size_t k = 0; k < drop.positions.size(); ++k) {
    const Vector from_centre = drop.positions[k];
    Vector velocity = input.drop.relaxation_time > 0.0 ? Vector{} : drop_velocity(input, from_centre);
    if (input.drop.is_rigid()) velocity = rigid_velocity(velocity, input.drop.initial_spin, from_centre - mass_centre);
    if (!drop.velocities.empty()) velocity += drop.velocities[k];
    fluid.positions.push_back(unmoved != nullptr ? Vector{unmoved->x[k], unmoved->y[k]} : centre + from_centre);
    fluid.velocities.push_back(velocity);
  }
  return fluid;
}

void append(const InitialFluid& drop, InitialFluid& all) {
  if (all.positions.empty()) all.centre = drop.centre;
  all.positions.insert(all.positions.end(), drop.positions.begin(), drop.positions.end());
  all.velocities.insert(all.velocities.end(), drop.velocities.begin(), drop.velocities.end());
  all.masses.insert(all.masses.end(), drop.masses.begin(), drop.masses.end());
}

struct Coordinates {
  std::vector<double> x, y;

  explicit Coordinates(const std::vector<Vector>& positions) {
    for (const Vector& position : positions) {
      x.push_back(position.x);
      y.push_back(position.y);
    }
  }
};

/// `ends`: of the drops' particles, in the order of the drops. Nearer than most of a spacing, particles would be flung
/// apart by the pressure between them.
void refuse_overlapping_drops(const Case& input, const std::vector<Vector>& positions,
                              const std::vector<std::size_t>& ends) {
  if (ends.size() < 2) return;
  const double nearest_allowed = 0.7 * input.resolution.spacing;
  const Coordinates all(positions);
  const CellGrid grid(all.x, all.y, nearest_allowed);
  const auto drop_of = [&](std::size_t particle) {
    return std::upper_bound(ends.begin(), ends.end(), particle) - ends.begin() + 1;
  };
  for (std::size_t i = 0; i < positions.size(); ++i)
    grid.for_each_near(positions[i], [&](std::int32_t near) {
      const auto j = static_cast<std::size_t>(near);
      if (drop_of(i) >= drop_of(j) || length(positions[i] - positions[j]) >= nearest_allowed) return;
      throw SetupError(fmt::format(
          "the drops {} and {} overlap at the start, at x = {:.6g} m, y = {:.6g} m; move one of them (drop.centre_x, "
          "drop.centre_y), particles of different drops must be {:g} m apart",
          drop_of(i), drop_of(j), positions[i].x, positions[i].y, nearest_allowed));
    });
}

/// The places of the contact surface's vertices.
std::vector<Vector> contact_places(const InitialSolid& solid) {
  if (solid.contact_vertices.empty()) return solid.positions;
  std::vector<Vector> places;
  for (const ContactVertex& vertex : solid.contact_vertices) {
    Vector place;
    for (std::size_t k = 0; k < static_cast<std::size_t>(vertex.count); ++k)
      place += vertex.weight[k] * solid.positions[static_cast<std::size_t>(vertex.particle[k])];
    places.push_back(place);
  }
  return places;
}

/// Measures with the contact algorithm itself, so that what passes here is at rest there.
void refuse_overlap(const Case& input, const InitialState& state) {
  const double d = input.resolution.spacing;
  const double contact_distance = input.contact.distance_ratio * d;
  if (state.fluid.positions.empty() || state.solid.contact_polylines.empty() || !(contact_distance > 0.0)) return;
  const Coordinates fluid(state.fluid.positions);
  const Coordinates solid(contact_places(state.solid));
  const auto [lowest, highest] = std::minmax_element(solid.y.begin(), solid.y.end());
  // Far enough to find the boundary from anywhere inside the solid.
  const double reach = contact_distance + (*highest - *lowest);
  ContactSolver contact;
  contact.rebuild(fluid.x, fluid.y, solid.x, solid.y, segments_of_polylines(state.solid.contact_polylines), reach);

  std::vector<double> unused_x(fluid.x.size()), unused_y(fluid.x.size());
  std::vector<double> unused_force_x(solid.x.size()), unused_force_y(solid.x.size());
  const ContactSummary overlap =
      contact.apply({fluid.x, fluid.y, state.fluid.masses, unused_x, unused_y},
                    {solid.x, solid.y, unused_force_x, unused_force_y}, {1.0, contact_distance, 0.0});
  if (overlap.largest_overlap <= 1e-6 * d) return;
  const bool is_above = input.drop.placement == DropPlacement::above_solid;
  const bool is_where_file_has_it = input.drop.placement == DropPlacement::file;
  const std::string advice =
      is_where_file_has_it
          ? "move the drop away by at least that much in its file, or by drop.placement = \"centre\" with "
            "drop.centre_x and drop.centre_y; drop.placement = \"above_solid\" puts it above the solid"
      : is_above ? fmt::format(
                       "make drop.gap (now {:g} m) larger by at least that much, or move the drop (drop.centre_x, "
                       "now {:g} m) off the clamps",
                       input.drop.gap, state.drop_centre.x)
                 : fmt::format(
                       "move the drop away by at least that much (drop.centre_x, drop.centre_y, now {:g} m and {:g} "
                       "m), or leave out drop.placement, which puts it above the solid",
                       state.drop_centre.x, state.drop_centre.y);
  throw SetupError(fmt::format(
      "the drop overlaps the solid at the start: the particle at x = {:.6g} m, y = {:.6g} m is nearer to "
      "the solid than the contact distance of {:g} m by {:.3g} m and would be shot away; {}",
      fluid.x[overlap.deepest], fluid.y[overlap.deepest], contact_distance, overlap.largest_overlap, advice));
}

}  // namespace

Vector drop_velocity(const Case& input, Vector from_centre) {
  Vector velocity{input.drop.velocity_x, input.drop.velocity_y};
  if (input.drop.oscillation_velocity != 0.0)
    velocity += oscillation_velocity(from_centre, input.drop.oscillation_velocity, input.drop.oscillation_radius);
  return velocity;
}

InitialState build_initial_state(const Case& input) {
  refuse_too_many_particles(input);
  InitialState state;
  const std::vector<InitialSolid> solids = build_solids(input);
  state.solid = joined_solids(solids);
  const bool is_of_cells = input.any_solid(
      [](const Case::Solid& one) { return one.is_elastic() && one.formulation == SolidFormulation::cells; });
  // Kernel sums make one body of what is nearer than their support.
  refuse_near_solids(state.solid,
                     (is_of_cells ? 1.0 : 2.0 * input.resolution.smoothing_ratio) * input.resolution.spacing);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  state.drop_centre = {nan, nan};
  std::vector<std::size_t> ends;
  for (std::size_t k = 0; k < input.drop_count(); ++k) {
    const Case one = input.with_drop(k);
    const DropParticles drop = build_drop(one);
    if (drop.positions.empty()) continue;
    const double centre_x = drop_centre_x(one);
    const Vector centre{centre_x, drop_centre_y(one, drop, centre_x, solids)};
    if (k == 0) state.drop_centre = centre;
    if (one.drop.given)
      if (std::string doubt = doubt_of_file(one); !doubt.empty()) state.warnings.push_back(std::move(doubt));
    append(place_drop(one, drop, centre), state.fluid);
    ends.push_back(state.fluid.positions.size());
  }
  if (state.fluid.positions.empty()) return state;
  refuse_overlapping_drops(input, state.fluid.positions, ends);
  refuse_overlap(input, state);
  return state;
}

}  // namespace sphdrop
