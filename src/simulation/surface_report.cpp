// What is known of the liquid's surface as a whole: sums over the ranks' nodes, which do not depend on who has which.

#include <algorithm>
#include <array>
#include <cmath>

#include "decomposition/exact_sum.hpp"
#include "simulation/surface_tension_step.hpp"
#include "surface_tension/surface_points.hpp"

namespace sphdrop {

double SurfaceTensionStep::area_of(const OwnNode& own, std::span<const Vector> points) const {
  return 0.5 * cross(points[own.node] - own.curve_place, points[own.next] - own.curve_place);
}

void SurfaceTensionStep::add_area(QuantisedSum& area) const {
  for (const OwnNode& own : own_nodes_) area.add(area_of(own, points_));
}

SurfaceTensionStep::Extent SurfaceTensionStep::extent_on_all_ranks(const ContactStep& contact, bool needs_area) {
  // A drop's outline is far below 2^17 spacings, and what comes or goes of it far above 2^-34 of one.
  QuantisedSum curve_length(0x1p-34 * spacing_);
  ExactSum area;
  for (const OwnNode& own : own_nodes_) {
    curve_length.add(length(points_[own.next] - points_[own.node]));
    if (needs_area) area.add(area_of(own, points_));
  }
  if (needs_area) ExactSum::reduce({&area, 1}, communicator_);
  std::vector<double> base(1, 0.0);
  if (is_wetting_) {
    if (works_on_adhesion()) base[0] = adhesion_.base_width(curves_, points_, contact.boundary(), adhesion_parameters_);
    communicator_.broadcast(base, node_forces_.owner());
  }
  const auto quanta = static_cast<double>(communicator_.sum(curve_length.quanta()));
  return {quanta * curve_length.quantum(), base[0], area.value()};
}

void SurfaceTensionStep::add_energy_of_displacement(std::span<const double> x, std::span<const double> y,
                                                    double gauge_pressure, const ContactStep& contact,
                                                    SharedEnergy& energy) {
  displacements_.resize(band_.size() + 1);
  band_.start(std::array<const void*, 2>{x.data(), y.data()});
  band_.finish_pairs(&displacements_[0].x);
  displaced_positions_.resize(node_positions_.size());
  displaced_points_.resize(points_.size());
  for (std::size_t k = 0; k < node_place_.size(); ++k) {
    displaced_positions_[k] = node_positions_[k] + displacements_[static_cast<std::size_t>(node_place_[k])];
  }
  surface_points(curves_, displaced_positions_, spacing_, displaced_points_);
  for (const OwnNode& own : own_nodes_) {
    const auto segment = [&](const std::vector<Vector>& points) { return length(points[own.next] - points[own.node]); };
    energy.add(coefficient_ * (segment(displaced_points_) - segment(points_)) -
               gauge_pressure * (area_of(own, displaced_points_) - area_of(own, points_)));
  }
  if (!works_on_adhesion()) return;
  const auto base_width = [&](const std::vector<Vector>& points) {
    return adhesion_.base_width(curves_, points, contact.boundary(), adhesion_parameters_);
  };
  energy.add(-work_of_adhesion() * (base_width(displaced_points_) - base_width(points_)));
}

SurfaceReport SurfaceTensionStep::report() const {
  enum Sum : std::size_t {
    length_sum,
    area_sum,
    first_moment,
    second_moment,
    force_x,
    force_y,
    magnitudes,
    weight,
    count
  };
  std::array<ExactSum, count> sums;
  std::vector<double> curvature(points_.size());
  curvatures(curves_, points_, polynomial_points_, curvature);
  for (const OwnNode& own : own_nodes_) {
    const double after = length(points_[own.next] - points_[own.node]);
    const double arc_length = 0.5 * (after + length(points_[own.node] - points_[own.previous]));
    const double kappa = curvature[own.node];
    sums[length_sum].add(after);
    sums[area_sum].add(area_of(own, points_));
    sums[weight].add(arc_length);
    sums[first_moment].add(arc_length * kappa);
    sums[second_moment].add(arc_length * kappa * kappa);
    sums[force_x].add(forces_[own.node].x);
    sums[force_y].add(forces_[own.node].y);
    sums[magnitudes].add(length(forces_[own.node]));
  }
  ExactSum::reduce(sums, communicator_);
  const auto value = [&](Sum sum) { return sums[sum].value(); };

  SurfaceReport report;
  report.length = value(length_sum);
  report.area = value(area_sum);
  report.curve_count = curve_count_;
  if (value(weight) > 0) {
    report.mean_curvature = value(first_moment) / value(weight);
    const double variance = value(second_moment) / value(weight) - report.mean_curvature * report.mean_curvature;
    report.curvature_scatter = std::sqrt(std::max(0.0, variance));
  }
  if (value(magnitudes) > 0) report.net_force = length(Vector{value(force_x), value(force_y)}) / value(magnitudes);
  if (is_wetting_) {
    std::vector<double> base{adhesion_summary_.base_width};
    communicator_.broadcast(base, node_forces_.owner());
    report.base_width = base[0];
  }
  return report;
}

}  // namespace sphdrop
