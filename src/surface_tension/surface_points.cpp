#include "surface_tension/surface_points.hpp"

#include <cassert>
#include <cmath>

namespace sphdrop {

void surface_points(const SurfaceCurves& curves, std::span<const Vector> node_positions, double spacing,
                    std::span<Vector> points) {
  assert(node_positions.size() == curves.nodes.size() && points.size() == curves.nodes.size());
  const double offset = 0.5 * spacing;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    Vector previous = node_positions[curve.last - 1];
    Vector position = node_positions[curve.first];
    for (std::size_t k = curve.first; k < curve.last; ++k) {
      const Vector next = node_positions[curve.next(k)];
      const Vector outward = right_normal(next - previous);
      const double squared_chord = squared_length(outward);
      const Vector normal = squared_chord > 0.0 ? outward / std::sqrt(squared_chord) : curves.nodes[k].arc_direction;
      points[k] = position + offset * normal;
      previous = position;
      position = next;
    }
  }
}

void surface_points(const SurfaceCurves& curves, std::span<const Vector> node_positions,
                    std::span<const Vector> node_velocities, double spacing, std::span<Vector> points,
                    std::span<Vector> velocities) {
  assert(node_positions.size() == curves.nodes.size() && node_velocities.size() == curves.nodes.size());
  assert(points.size() == curves.nodes.size() && velocities.size() == curves.nodes.size());
  const double offset = 0.5 * spacing;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    std::size_t previous = curve.last - 1;
    for (std::size_t k = curve.first; k < curve.last; ++k) {
      const std::size_t next = curve.next(k);
      const Vector chord = node_positions[next] - node_positions[previous];
      const double squared_chord = squared_length(chord);
      Vector normal = curves.nodes[k].arc_direction;
      velocities[k] = node_velocities[k];
      // The normal turns as the chord does: d/2 dn/dt = d/2 (chord x chord's rate)/chord^2 along the chord.
      if (squared_chord > 0.0) {
        const double chord_length = std::sqrt(squared_chord);
        const double turning = cross(chord, node_velocities[next] - node_velocities[previous]) / squared_chord;
        normal = right_normal(chord) / chord_length;
        velocities[k] += (offset * turning / chord_length) * chord;
      }
      points[k] = node_positions[k] + offset * normal;
      previous = k;
    }
  }
}

}  // namespace sphdrop
