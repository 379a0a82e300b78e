#pragma once
// The forces between the liquid's surface and a solid that it wets (method.md, 6b): minus the gradient of -W B.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/contact_solver.hpp"
#include "contact/contact_surface.hpp"
#include "contact/segment_search.hpp"
#include "particles/vector.hpp"
#include "surface_tension/surface_curve.hpp"
#include "wetting/contact_angle.hpp"

namespace sphdrop {

struct AdhesionParameters {
  double work = 0;           ///< W, N/m
  double spacing = 0;        ///< d, m
  double rest_distance = 0;  ///< of a surface point on the base from the solid's polyline, m

  /// A surface point at this distance from the polyline has left the solid, m.
  double range() const { return rest_distance + base_ends * spacing; }
};

/// Of the drop of a case, W left out: a liquid particle rests `contact_distance` d0 (m) from the solid's polyline, its
/// surface point d/2 nearer.
constexpr AdhesionParameters adhesion_parameters(double spacing, double contact_distance, double work = 0.0) {
  return {work, spacing, contact_distance - 0.5 * spacing};
}

/// What the solid gets in one step. Per metre of depth.
struct AdhesionSummary {
  double base_width = 0;       ///< B, m: the width of the liquid's base on the solid
  Vector force_on_solid;       ///< N/m
  double moment_on_solid = 0;  ///< about the origin, counterclockwise, N m/m
};

/// The base's width is B = sum over the surface points s_k of w_k e_k . t_k, with e_k = (s_{k+1} - s_{k-1})/2 and, at
/// the point of the solid's boundary nearest to s_k, the tangent t_k along which the curve runs on the base. It is a
/// function of surface points and boundary vertices, smooth but for the bends of the boundary. The forces are its exact
/// gradient times W: they sum to zero over liquid and solid, and so do their moments.
class Adhesion {
 public:
  /// Finds for every node the segments within `reach` (m) of `centres`, by node: the distance within which a surface
  /// point matters (AdhesionParameters::range) plus what it may be away from there until the next rebuild().
  void rebuild(std::span<const Vector> centres, const ContactSurface& surface, double reach);

  /// Adds the forces (N/m) to those on the surface points and on the boundary's vertices. `points` (m) and `forces`: by
  /// node of the curves, as in rebuild(). Curves of fewer than three nodes do not take part.
  AdhesionSummary apply(const SurfaceCurves& curves, std::span<const Vector> points, std::span<const Segment> segments,
                        const ContactVertices& vertices, const AdhesionParameters& parameters,
                        std::span<Vector> forces);

  /// B alone, m.
  double base_width(const SurfaceCurves& curves, std::span<const Vector> points, const ContactSurface& surface,
                    const AdhesionParameters& parameters);

 private:
  /// A surface point as the solid sees it.
  struct Place {
    BaseWeight weight;
    Vector normal, tangent;
    double distance = 0;  ///< m
    double fraction = 0;
    std::int32_t segment = -1;
    bool at_vertex = false;
  };

  void find_places(std::span<const Vector> points, const ContactSurface& surface, const AdhesionParameters& parameters);

  SegmentSearch search_;
  std::vector<Place> places_;  // by node; beyond the range the weight is zero
};

}  // namespace sphdrop
