#pragma once
// Arrangements of particles, their curves, and outlines of known shape.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "surface_tension/boundary_detection.hpp"
#include "surface_tension/surface_curve.hpp"

namespace sphdrop::test {

constexpr double spacing = 2.5e-5;
constexpr double smoothing_length = 1.2 * spacing;
constexpr double circle_radius = 2.0 * smoothing_length;

using Positions = std::vector<Vector>;

/// The lattice points for which inside(x, y), in units of the spacing, is true.
template <class Inside>
Positions lattice(int half_width, double offset, Inside inside) {
  Positions positions;
  for (int ix = -half_width; ix <= half_width; ++ix)
    for (int iy = -half_width; iy <= half_width; ++iy)
      if (inside(ix + offset, iy + offset)) positions.push_back({spacing * (ix + offset), spacing * (iy + offset)});
  return positions;
}

/// Disc cut out of a lattice; radius in spacings.
inline Positions lattice_disc(double radius) {
  return lattice(static_cast<int>(radius) + 2, 0.5,
                 [=](double x, double y) { return x * x + y * y < radius * radius; });
}

inline Positions rectangle(int columns, int rows) {
  Positions positions;
  for (int ix = 0; ix < columns; ++ix)
    for (int iy = 0; iy < rows; ++iy) positions.push_back({spacing * ix, spacing * iy});
  return positions;
}

/// Concentric rings, one spacing apart; the outermost has radius (rings - 1/2) spacings.
inline Positions ring_disc(int rings) {
  Positions positions;
  for (int ring = 0; ring < rings; ++ring) {
    const double radius = (ring + 0.5) * spacing;
    const auto count = static_cast<int>(std::lround(2.0 * std::numbers::pi * (ring + 0.5)));
    for (int k = 0; k < count; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / count;
      positions.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  }
  return positions;
}

inline void jitter(Positions& positions, double amplitude, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> shift(-amplitude, amplitude);
  for (Vector& position : positions) position += {shift(generator), shift(generator)};
}

inline Positions moved(Positions positions, Vector by) {
  for (Vector& position : positions) position += by;
  return positions;
}

inline Positions together(Positions a, const Positions& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The arcs of all particles, each with all particles as its neighbours; global id = index.
inline std::vector<Arc> arcs_of(const Positions& positions, double radius = circle_radius) {
  std::vector<std::int64_t> ids(positions.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int64_t>(i);
  ArcFinder finder(radius);
  std::vector<Arc> arcs;
  for (std::size_t i = 0; i < ids.size(); ++i) finder.find(ids[i], positions[i], ids, positions, arcs);
  return arcs;
}

inline SurfaceCurves curves_of(const Positions& positions, double radius = circle_radius) {
  const std::vector<Arc> arcs = arcs_of(positions, radius);
  Positions centres;
  for (const Arc& arc : arcs) centres.push_back(positions[static_cast<std::size_t>(arc.particle)]);
  return connect_arcs(arcs, centres, radius);
}

inline Positions node_positions(const SurfaceCurves& curves, const Positions& positions) {
  Positions nodes;
  for (const auto& node : curves.nodes) nodes.push_back(positions[static_cast<std::size_t>(node.particle)]);
  return nodes;
}

/// Area inside curve `index`, positive if it runs counterclockwise.
inline double signed_area(const SurfaceCurves& curves, std::size_t index, std::span<const Vector> points) {
  const auto curve = curves.curve(index);
  double sum = 0.0;
  for (std::size_t k = curve.first; k < curve.last; ++k) sum += 0.5 * cross(points[k], points[curve.next(k)]);
  return sum;
}

/// Curves of given numbers of nodes, the particles numbered through.
inline SurfaceCurves plain_curves(std::initializer_list<int> sizes) {
  SurfaceCurves curves;
  for (const int size : sizes) {
    for (int k = 0; k < size; ++k)
      curves.nodes.push_back({static_cast<std::int64_t>(curves.nodes.size()), Vector{1.0, 0.0}});
    curves.curve_start.push_back(static_cast<std::int32_t>(curves.nodes.size()));
  }
  return curves;
}

/// Points of an ellipse, counterclockwise, at equal steps of the parameter.
inline Positions ellipse(double a, double b, int count) {
  Positions points;
  for (int k = 0; k < count; ++k) {
    const double parameter = 2.0 * std::numbers::pi * k / count;
    points.push_back({a * std::cos(parameter), b * std::sin(parameter)});
  }
  return points;
}

}  // namespace sphdrop::test
