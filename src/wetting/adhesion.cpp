#include "wetting/adhesion.hpp"

#include <cassert>

#include "contact/contact_force.hpp"
#include "contact/foot_point.hpp"

namespace sphdrop {

namespace {

/// Half the way from the point before to the point after, e_k.
Vector curve_element(const SurfaceCurves::Range& curve, std::span<const Vector> points, std::size_t k) {
  return 0.5 * (points[curve.next(k)] - points[curve.previous(k)]);
}

/// Adds to the vertices and keeps account of it.
class VertexForces {
 public:
  VertexForces(const ContactVertices& vertices, AdhesionSummary& summary) : vertices_(vertices), summary_(summary) {}

  void add(std::int32_t vertex, Vector force) {
    vertices_.force_x[vertex] += force.x;
    vertices_.force_y[vertex] += force.y;
    summary_.force_on_solid += force;
    summary_.moment_on_solid += cross({vertices_.x[vertex], vertices_.y[vertex]}, force);
  }

 private:
  const ContactVertices& vertices_;
  AdhesionSummary& summary_;
};

}  // namespace

void Adhesion::rebuild(std::span<const Vector> centres, const ContactSurface& surface, double reach) {
  std::vector<double> x(centres.size()), y(centres.size());
  for (std::size_t k = 0; k < centres.size(); ++k) {
    x[k] = centres[k].x;
    y[k] = centres[k].y;
  }
  search_.rebuild(x, y, surface, reach);
  places_.assign(centres.size(), {});
}

void Adhesion::find_places(std::span<const Vector> points, const ContactSurface& surface,
                           const AdhesionParameters& parameters) {
  assert(places_.size() == points.size());
  const std::span<const std::int32_t> active = search_.active_points();
  for (std::size_t a = 0; a < active.size(); ++a) {
    const auto k = static_cast<std::size_t>(active[a]);
    const FootPoint foot = nearest_foot_point(points[k], search_.candidates(a), surface);
    const BaseWeight weight = base_weight(foot.distance - parameters.rest_distance, parameters.spacing);
    // Beyond the range nothing of the foot point may show: which candidates there are is chance.
    places_[k] = weight.value == 0.0 ? Place{} : Place{weight,        foot.normal,   right_normal(foot.normal),
                                                       foot.distance, foot.fraction, foot.segment,
                                                       foot.at_vertex};
  }
}

AdhesionSummary Adhesion::apply(const SurfaceCurves& curves, std::span<const Vector> points,
                                std::span<const Segment> segments, const ContactVertices& vertices,
                                const AdhesionParameters& parameters, std::span<Vector> forces) {
  assert(points.size() == curves.nodes.size() && forces.size() == points.size());
  const ContactSurface surface{segments, vertices.x, vertices.y};
  find_places(points, surface, parameters);
  AdhesionSummary summary;
  VertexForces on_solid(vertices, summary);
  const double work = parameters.work;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    if (!curve.carries_force()) continue;
    for (std::size_t k = curve.first; k < curve.last; ++k) {
      // By e of both neighbours: along the wall. It telescopes to zero round the curve and leaves Young's force where
      // the weight goes from 1 to 0.
      const Place& before = places_[curve.previous(k)];
      const Place& after = places_[curve.next(k)];
      forces[k] += (0.5 * work) * (before.weight.value * before.tangent - after.weight.value * after.tangent);

      const Place& place = places_[k];
      if (place.weight.value == 0.0) continue;
      const Segment& segment = segments[static_cast<std::size_t>(place.segment)];
      const Vector element = curve_element(curve, points, k);
      const double along = dot(element, place.tangent);
      summary.base_width += place.weight.value * along;

      // By the gap: the solid's attraction on what is about to touch it or to leave it.
      const Vector attraction = (work * along * place.weight.slope) * place.normal;
      forces[k] += attraction;
      const SharedForce share = shared_force(-attraction, place.fraction);
      on_solid.add(segment.first, share.first);
      on_solid.add(segment.second, share.second);

      // By the tangent, which turns with the wall or, at a vertex, with the line from there to the point.
      const double turning = work * place.weight.value * dot(element, place.normal);
      if (place.at_vertex) {
        if (place.distance == 0.0) continue;
        const Vector on_vertex = (turning / place.distance) * place.tangent;
        forces[k] -= on_vertex;
        on_solid.add(place.fraction == 0.0 ? segment.first : segment.second, on_vertex);
      } else {
        const SharedForce couple =
            shared_moment(turning, surface.vertex(segment.first), surface.vertex(segment.second));
        on_solid.add(segment.first, couple.first);
        on_solid.add(segment.second, couple.second);
      }
    }
  }
  return summary;
}

double Adhesion::base_width(const SurfaceCurves& curves, std::span<const Vector> points, const ContactSurface& surface,
                            const AdhesionParameters& parameters) {
  assert(points.size() == curves.nodes.size());
  find_places(points, surface, parameters);
  double width = 0.0;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    if (!curve.carries_force()) continue;
    for (std::size_t k = curve.first; k < curve.last; ++k)
      if (places_[k].weight.value != 0.0)
        width += places_[k].weight.value * dot(curve_element(curve, points, k), places_[k].tangent);
  }
  return width;
}

}  // namespace sphdrop
