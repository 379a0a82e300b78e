#include "surface_tension/surface_points.hpp"

#include <cassert>
#include <cmath>
#include <vector>

#include "surface_tension/node_lanes.hpp"

namespace sphdrop {

namespace {

/// The line through a node's neighbours: its length and, if that is not zero, the unit vector to its right.
template <class Real>
struct Chord {
  Real length;
  Components<Real> normal;
};

template <class Real>
Chord<Real> chord_along(const Components<Real>& along) {
  using std::sqrt;
  const Real length = sqrt(along.y * along.y + along.x * along.x);
  return {length, {along.y / length, -along.x / length}};
}

/// T_k of a force on its point. The normal turns as the chord does: d/2 dn/dt = d/2 (chord x chord's rate)/chord^2
/// along the chord.
template <class Real>
Components<Real> turning_force(const Components<Real>& along, const Real& cubed_length, const Components<Real>& force,
                               double offset) {
  const Real across = offset * (force.x * along.x + force.y * along.y) / cubed_length;
  return {-across * along.y, across * along.x};
}

}  // namespace

[[gnu::flatten]] void surface_points(const SurfaceCurves& curves, std::span<const Vector> node_positions,
                                     double spacing, std::span<Vector> points, std::span<double> chords) {
  assert(node_positions.size() == curves.nodes.size() && points.size() == curves.nodes.size());
  assert(chords.size() == curves.nodes.size());
  const double offset = 0.5 * spacing;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    const auto one = [&](std::size_t k) {
      const Vector along = node_positions[curve.next(k)] - node_positions[curve.previous(k)];
      const Chord<double> chord = chord_along(components(along));
      const Vector normal = chord.length > 0.0 ? Vector{chord.normal.x, chord.normal.y} : curves.nodes[k].arc_direction;
      points[k] = node_positions[k] + offset * normal;
      chords[k] = chord.length;
    };
    const auto many = [&](std::size_t k) {
      const Chord<Pack> chord = chord_along(load_lanes(node_positions, k + 1) - load_lanes(node_positions, k - 1));
      if (!(hmin(chord.length) > 0.0)) return false;
      const Components<Pack> node = load_lanes(node_positions, k);
      store_lanes({node.x + offset * chord.normal.x, node.y + offset * chord.normal.y}, points, k);
      store(chord.length, &chords[k]);
      return true;
    };
    for_each_node(curve, many, one);
  }
}

void surface_points(const SurfaceCurves& curves, std::span<const Vector> node_positions, double spacing,
                    std::span<Vector> points) {
  std::vector<double> chords(points.size());
  surface_points(curves, node_positions, spacing, points, chords);
}

[[gnu::flatten]] void turning_forces(const SurfaceCurves& curves, std::span<const Vector> node_positions,
                                     std::span<const double> chords, double spacing, std::span<const Vector> forces,
                                     std::span<Vector> turning) {
  assert(node_positions.size() == curves.nodes.size() && chords.size() == curves.nodes.size());
  assert(forces.size() == curves.nodes.size() && turning.size() == curves.nodes.size());
  const double offset = 0.5 * spacing;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    const auto one = [&](std::size_t k) {
      const double cubed = chords[k] * chords[k] * chords[k];
      turning[k] = {};
      if (!(cubed > 0.0)) return;
      const Vector along = node_positions[curve.next(k)] - node_positions[curve.previous(k)];
      const Components<double> force = turning_force(components(along), cubed, components(forces[k]), offset);
      turning[k] = {force.x, force.y};
    };
    const auto many = [&](std::size_t k) {
      const Pack length = load(&chords[k]), cubed = length * length * length;
      if (!(hmin(cubed) > 0.0)) return false;
      const Components<Pack> along = load_lanes(node_positions, k + 1) - load_lanes(node_positions, k - 1);
      store_lanes(turning_force(along, cubed, load_lanes(forces, k), offset), turning, k);
      return true;
    };
    for_each_node(curve, many, one);
  }
}

}  // namespace sphdrop
