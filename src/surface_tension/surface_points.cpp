#include "surface_tension/surface_points.hpp"

#include <cassert>
#include <cmath>
#include <vector>

namespace sphdrop {

void surface_points(const SurfaceCurves& curves, std::span<const Vector> node_positions, double spacing,
                    std::span<Vector> points, std::span<double> chords) {
  assert(node_positions.size() == curves.nodes.size() && points.size() == curves.nodes.size());
  assert(chords.size() == curves.nodes.size());
  const double offset = 0.5 * spacing;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    Vector previous = node_positions[curve.last - 1];
    Vector position = node_positions[curve.first];
    for (std::size_t k = curve.first; k < curve.last; ++k) {
      const Vector next = node_positions[curve.next(k)];
      const Vector outward = right_normal(next - previous);
      const double chord = std::sqrt(squared_length(outward));
      const Vector normal = chord > 0.0 ? outward / chord : curves.nodes[k].arc_direction;
      points[k] = position + offset * normal;
      chords[k] = chord;
      previous = position;
      position = next;
    }
  }
}

void surface_points(const SurfaceCurves& curves, std::span<const Vector> node_positions, double spacing,
                    std::span<Vector> points) {
  std::vector<double> chords(points.size());
  surface_points(curves, node_positions, spacing, points, chords);
}

void turning_forces(const SurfaceCurves& curves, std::span<const Vector> node_positions, std::span<const double> chords,
                    double spacing, std::span<const Vector> forces, std::span<Vector> turning) {
  assert(node_positions.size() == curves.nodes.size() && chords.size() == curves.nodes.size());
  assert(forces.size() == curves.nodes.size() && turning.size() == curves.nodes.size());
  const double offset = 0.5 * spacing;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    Vector previous = node_positions[curve.last - 1];
    Vector position = node_positions[curve.first];
    for (std::size_t k = curve.first; k < curve.last; ++k) {
      const Vector next = node_positions[curve.next(k)];
      const Vector chord = next - previous;
      // The normal turns as the chord does: d/2 dn/dt = d/2 (chord x chord's rate)/chord^2 along the chord.
      const double cubed = chords[k] * chords[k] * chords[k];
      turning[k] = cubed > 0.0 ? (offset * dot(forces[k], chord) / cubed) * left_normal(chord) : Vector{};
      previous = position;
      position = next;
    }
  }
}

}  // namespace sphdrop
