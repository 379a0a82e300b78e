#include "simulation/surface_tension_step.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "diagnostics/number_reader.hpp"
#include "fluid/particle_shifting.hpp"
#include "sph/cell_grid.hpp"
#include "surface_tension/near_particles.hpp"
#include "surface_tension/surface_points.hpp"

namespace sphdrop {

SurfaceTensionStep::SurfaceTensionStep(const Communicator& communicator, const Case& input,
                                       const SmoothingKernel& kernel)
    : communicator_(communicator),
      kernel_(kernel),
      form_(input.surface_tension.coefficient > 0 && !input.drop.is_rigid() ? input.surface_tension.form
                                                                            : SurfaceTensionForm::none),
      coefficient_(input.surface_tension.coefficient),
      spacing_(input.resolution.spacing),
      support_(2.0 * input.resolution.smoothing_ratio * input.resolution.spacing),
      detection_displacement_(input.surface_tension.detection_displacement * input.resolution.spacing),
      polynomial_points_(static_cast<int>(input.surface_tension.polynomial_points)),
      orients_particles_(input.fluid.shifting == Switch::on),
      displacement_is_relative_(input.surface_tension.detection_motion == DetectionMotion::relative &&
                                !input.is_wetting()),
      search_(support_),
      is_wetting_(is_enabled() && input.is_wetting()),
      adhesion_parameters_(adhesion_parameters(
          spacing_, input.contact.distance_ratio * spacing_,
          is_wetting_ ? sphdrop::work_of_adhesion(coefficient_, input.surface_tension.contact_angle) : 0.0)),
      // From where the particle was at detection. Until the next one it moves by the displacement and a step, the
      // boundary, in the same time or until a redistribution, by a skin.
      adhesion_reach_(adhesion_parameters_.range() + 0.6 * spacing_ + detection_displacement_ +
                      input.parallel.skin * spacing_) {}

void SurfaceTensionStep::detect(FluidParticles& fluid, const SolidParticles& solid, Distribution& distribution,
                                ContactStep& contact, double gauge_pressure) {
  Extent old;
  if (has_curves_) {
    gather_points(fluid);
    if (is_wetting_) contact.gather_boundary(solid);
    old = extent_on_all_ranks(contact);
  }
  fluid.for_each_owned([&](std::size_t row) { fluid.detection_position.set(row, fluid.position.at(row)); });
  find_arcs(fluid, distribution);
  regather(fluid, contact, distribution);
  if (has_curves_) {
    const Extent present = extent_on_all_ranks(contact);
    reconnected_length_ += present.length - old.length;
    reconnected_base_ += present.base - old.base;
    reconnected_gauge_energy_ -= gauge_pressure * (present.area - old.area);
  }
  has_curves_ = true;
}

bool SurfaceTensionStep::detection_is_due(double squared_displacement, const DisplacementBox& displacements) const {
  const double squared_limit = detection_displacement_ * detection_displacement_;
  return squared_displacement >= squared_limit &&
         (!displacement_is_relative_ || 0.25 * displacements.squared_diagonal() >= squared_limit);
}

void SurfaceTensionStep::recover(FluidParticles& fluid, Distribution& distribution, const ContactStep& contact) {
  if (!has_curves_) return;
  find_arcs(fluid, distribution);
  regather(fluid, contact, distribution);
}

std::vector<double> SurfaceTensionStep::to_numbers() const {
  return {has_curves_ ? 1.0 : 0.0, reconnected_length_, reconnected_base_, reconnected_gauge_energy_, sharing_work_};
}

void SurfaceTensionStep::from_numbers(std::span<const double> numbers) {
  NumberReader reader(numbers, "surface");
  has_curves_ = reader.flag();
  reconnected_length_ = reader.number();
  reconnected_base_ = reader.number();
  reconnected_gauge_energy_ = reader.number();
  sharing_work_ = reader.number();
  reader.expect_end();
}

// The present surface points at the owner, on the curves of the last detection.
void SurfaceTensionStep::gather_points(const FluidParticles& fluid) {
  gather_.start_gather(std::array<const void*, 2>{fluid.position.x.data(), fluid.position.y.data()});
  gather_.finish_gather(std::array<void*, 2>{x_.data(), y_.data()});
  place_nodes();
  surface_points(curves_, node_positions_, spacing_, points_);
}

SurfaceTensionStep::Extent SurfaceTensionStep::extent_on_all_ranks(const ContactStep& contact) {
  std::vector<double> numbers;
  if (owner() == communicator_.rank()) {
    numbers = {total_length(curves_, points_), 0.0, total_area(curves_, points_)};
    if (is_wetting_) numbers[1] = adhesion_.base_width(curves_, points_, contact.boundary(), adhesion_parameters_);
  }
  communicator_.broadcast(numbers, owner());
  return {numbers[0], numbers[1], numbers[2]};
}

void SurfaceTensionStep::place_nodes() {
  for (std::size_t k = 0; k < node_particle_.size(); ++k) {
    const auto index = static_cast<std::size_t>(node_particle_[k]);
    node_positions_[k] = {x_[index], y_[index]};
  }
}

void SurfaceTensionStep::find_arcs(FluidParticles& fluid, Distribution& distribution) {
  // Owned rows first, then what the wide halo brings.
  ExchangePlan& halo = distribution.wide_halo();
  const std::size_t owned = fluid.owned_count();
  const std::size_t all = owned + halo.received_row_count();
  std::vector<double> x(all), y(all);
  std::vector<std::int64_t> id(all);
  std::copy_n(fluid.detection_position.x.data(), owned, x.begin());
  std::copy_n(fluid.detection_position.y.data(), owned, y.begin());
  std::copy_n(fluid.id.data(), owned, id.begin());
  halo.start(std::array<const void*, 3>{x.data(), y.data(), id.data()});
  halo.finish(std::array<void*, 3>{x.data(), y.data(), id.data()});

  std::vector<Arc> arcs;
  std::vector<Vector> centres;
  search_.find(x, y, id, owned, arcs, centres);

  struct LocatedArc {
    Arc arc;
    Vector centre;
  };
  std::vector<LocatedArc> mine;
  mine.reserve(arcs.size());
  for (std::size_t k = 0; k < arcs.size(); ++k) mine.push_back({arcs[k], centres[k]});
  std::vector<LocatedArc> everyone = communicator_.all_gather(std::span<const LocatedArc>(mine));
  std::sort(everyone.begin(), everyone.end(), [](const LocatedArc& a, const LocatedArc& b) {
    return std::pair(a.arc.particle, a.arc.previous) < std::pair(b.arc.particle, b.arc.previous);
  });
  arcs_.clear();
  arc_centres_.clear();
  for (const LocatedArc& located : everyone) {
    arcs_.push_back(located.arc);
    arc_centres_.push_back(located.centre);
  }
  if (orients_particles_) find_arc_normals();
}

// Of the line through an arc's neighbours on the curve, or the middle of the arc where there is no such line.
void SurfaceTensionStep::find_arc_normals() {
  const auto centre_of = [&](std::int64_t particle) -> const Vector* {
    const auto found = std::lower_bound(arcs_.begin(), arcs_.end(), particle,
                                        [](const Arc& arc, std::int64_t id) { return arc.particle < id; });
    if (found == arcs_.end() || found->particle != particle) return nullptr;
    return &arc_centres_[static_cast<std::size_t>(found - arcs_.begin())];
  };
  arc_normals_.clear();
  for (const Arc& arc : arcs_) {
    const Vector *next = centre_of(arc.next), *previous = centre_of(arc.previous);
    Vector normal = next != nullptr && previous != nullptr ? right_normal(*next - *previous) : Vector{};
    if (squared_length(normal) == 0.0) normal = arc.start + arc.end;
    const double squared = squared_length(normal);
    arc_normals_.push_back(squared > 0.0 ? normal / std::sqrt(squared) : Vector{});
  }
}

void SurfaceTensionStep::orient_along_surface(FluidParticles& fluid) const {
  std::vector<double> arc_x(arc_centres_.size()), arc_y(arc_centres_.size());
  for (std::size_t k = 0; k < arc_centres_.size(); ++k) {
    arc_x[k] = arc_centres_[k].x;
    arc_y[k] = arc_centres_[k].y;
  }
  const CellGrid grid(arc_x, arc_y, support_);
  std::vector<std::size_t> near;
  fluid.for_each_owned([&](std::size_t row) {
    const Vector here = fluid.detection_position.at(row);
    near.clear();
    grid.for_each_near(here, [&](std::int32_t k) { near.push_back(static_cast<std::size_t>(k)); });
    std::sort(near.begin(), near.end());  // arcs are in the order of ids
    OrientationSums sums;
    for (const std::size_t k : near) sums.add(arc_normals_[k], kernel_value(kernel_, length(arc_centres_[k] - here)));
    const OrientationSums mean = normalised(sums);
    fluid.surface_orientation.xx[row] = mean.xx;
    fluid.surface_orientation.xy[row] = mean.xy;
    fluid.surface_orientation.yy[row] = mean.yy;
  });
}

void SurfaceTensionStep::regather(FluidParticles& fluid, const ContactStep& contact, const Distribution& distribution) {
  if (orients_particles_) orient_along_surface(fluid);
  SurfaceCurves curves = connect_arcs(arcs_, arc_centres_, support_);
  std::vector<Vector> node_positions, points(curves.nodes.size());
  for (const SurfaceCurves::Node& node : curves.nodes) node_positions.push_back(node.centre);
  surface_points(curves, node_positions, spacing_, points);
  // A surface point acts as far as 2h. Until the next detection both ends move by its displacement and a step, the
  // point a little more, as it also turns about its particle.
  const double action = support_ + 6.0 * detection_displacement_ + 0.02 * spacing_;
  const std::size_t owned = fluid.owned_count();
  band_rows_ = particles_near(points, {fluid.detection_position.x.data(), owned},
                              {fluid.detection_position.y.data(), owned}, action);
  std::vector<std::int64_t> ids;
  for (const std::int32_t row : band_rows_) ids.push_back(fluid.id[static_cast<std::size_t>(row)]);
  int owner = is_wetting_ ? contact.owner() : distribution.surface_owner();
  if (owner < 0) owner = rank_with_most(communicator_, static_cast<std::int64_t>(band_rows_.size()));
  gather_ = InterfaceGather(communicator_, ids, band_rows_, owner, tags::surface, GatheredOrder::as_arrived);
  returned_x_.assign(band_rows_.size(), 0.0);
  returned_y_.assign(band_rows_.size(), 0.0);

  const std::size_t gathered = gather_.ids().size();
  x_.assign(gathered + 1, ForceSharing::far_away);
  y_.assign(gathered + 1, ForceSharing::far_away);
  velocity_x_.resize(gathered);
  velocity_y_.resize(gathered);
  mass_.resize(gathered);
  powers_.resize(gathered);
  acceleration_x_.resize(gathered);
  acceleration_y_.resize(gathered);
  gather_.start_gather(std::array<const void*, 3>{fluid.detection_position.x.data(), fluid.detection_position.y.data(),
                                                  fluid.mass.data()});
  gather_.finish_gather(std::array<void*, 3>{x_.data(), y_.data(), mass_.data()});
  if (owner != communicator_.rank()) {
    curves = {};
    node_positions.clear();
    points.clear();
  }
  curves_ = std::move(curves);
  node_positions_ = std::move(node_positions);
  points_ = std::move(points);
  const std::size_t nodes = curves_.nodes.size();
  node_velocities_.resize(nodes);
  point_velocities_.resize(nodes);
  forces_.resize(nodes);
  node_particle_.clear();
  for (const SurfaceCurves::Node& node : curves_.nodes) {
    node_particle_.push_back(gather_.index_of(node.particle));
    assert(node_particle_.back() >= 0);
  }
  if (owner != communicator_.rank()) return;
  sharing_.rebuild(points_, std::span(x_).first(gathered), std::span(y_).first(gathered), mass_, gather_.by_id(),
                   action);
  if (is_wetting_) {
    adhesion_.rebuild(node_positions_, contact.boundary(), adhesion_reach_);
    all_forces_.resize(nodes);
  }
}

void SurfaceTensionStep::start(const FluidParticles& fluid) {
  gather_.start_gather(std::array<const void*, 4>{fluid.position.x.data(), fluid.position.y.data(),
                                                  fluid.velocity.x.data(), fluid.velocity.y.data()});
}

void SurfaceTensionStep::receive() {
  gather_.finish_gather(std::array<void*, 4>{x_.data(), y_.data(), velocity_x_.data(), velocity_y_.data()});
}

void SurfaceTensionStep::work(ContactStep& contact, double gauge_pressure) {
  if (owner() == communicator_.rank()) {
    place_nodes();
    for (std::size_t k = 0; k < node_particle_.size(); ++k) {
      const auto index = static_cast<std::size_t>(node_particle_[k]);
      node_velocities_[k] = {velocity_x_[index], velocity_y_[index]};
    }
    surface_points(curves_, node_positions_, node_velocities_, spacing_, points_, point_velocities_);
    if (form_ == SurfaceTensionForm::conservative)
      conservative_forces(curves_, points_, coefficient_, forces_);
    else
      curvature_forces(curves_, points_, coefficient_, polynomial_points_, forces_);
    if (gauge_pressure != 0.0) add_pressure_forces(curves_, points_, gauge_pressure, forces_);
    std::fill(acceleration_x_.begin(), acceleration_x_.end(), 0.0);
    std::fill(acceleration_y_.begin(), acceleration_y_.end(), 0.0);
    if (is_wetting_) {
      all_forces_ = forces_;
      adhesion_summary_ = adhesion_.apply(curves_, points_, contact.boundary().segments, contact.boundary_forces(),
                                          adhesion_parameters_, all_forces_);
    }
    const std::vector<Vector>& shared = is_wetting_ ? all_forces_ : forces_;
    lost_points_ = sharing_.share(points_, shared, x_, y_, kernel_, acceleration_x_, acceleration_y_);
    sharing_power_ = power_of_sharing(shared);
  }
  gather_.start_scatter(std::array<const void*, 2>{acceleration_x_.data(), acceleration_y_.data()});
}

double SurfaceTensionStep::power_of_sharing(std::span<const Vector> forces) {
  // Apart from the sum, which has an order and waits for each of its terms.
  for (std::size_t k = 0; k < powers_.size(); ++k)
    powers_[k] = mass_[k] * (acceleration_x_[k] * velocity_x_[k] + acceleration_y_[k] * velocity_y_[k]);
  double on_particles = 0, on_points = 0;
  for (const std::int32_t k : sharing_.particles()) on_particles += powers_[static_cast<std::size_t>(k)];
  for (std::size_t k = 0; k < forces.size(); ++k) on_points += dot(forces[k], point_velocities_[k]);
  return on_particles - on_points;
}

void SurfaceTensionStep::finish(FluidParticles& fluid) {
  gather_.finish_scatter(std::array<void*, 2>{returned_x_.data(), returned_y_.data()});
  for (std::size_t k = 0; k < band_rows_.size(); ++k) {
    const auto row = static_cast<std::size_t>(band_rows_[k]);
    fluid.acceleration.x[row] += returned_x_[k];
    fluid.acceleration.y[row] += returned_y_[k];
  }
}

double SurfaceTensionStep::energy_of_displacement(std::span<const double> x, std::span<const double> y,
                                                  double gauge_pressure, const ContactStep& contact) {
  displacement_x_.resize(mass_.size());
  displacement_y_.resize(mass_.size());
  gather_.start_gather(std::array<const void*, 2>{x.data(), y.data()});
  gather_.finish_gather(std::array<void*, 2>{displacement_x_.data(), displacement_y_.data()});
  if (owner() != communicator_.rank()) return -std::numeric_limits<double>::infinity();
  displaced_positions_.resize(node_positions_.size());
  displaced_points_.resize(points_.size());
  for (std::size_t k = 0; k < node_particle_.size(); ++k) {
    const auto index = static_cast<std::size_t>(node_particle_[k]);
    displaced_positions_[k] = node_positions_[k] + Vector{displacement_x_[index], displacement_y_[index]};
  }
  surface_points(curves_, displaced_positions_, spacing_, displaced_points_);
  const auto base_width = [&](const std::vector<Vector>& points) {
    return is_wetting_ ? adhesion_.base_width(curves_, points, contact.boundary(), adhesion_parameters_) : 0.0;
  };
  return coefficient_ * (total_length(curves_, displaced_points_) - total_length(curves_, points_)) -
         work_of_adhesion() * (base_width(displaced_points_) - base_width(points_)) -
         gauge_pressure * (total_area(curves_, displaced_points_) - total_area(curves_, points_));
}

SurfaceReport SurfaceTensionStep::report() const {
  SurfaceReport report;
  report.length = total_length(curves_, points_);
  report.area = enclosed_area();
  report.node_count = static_cast<double>(curves_.nodes.size());
  report.unmatched_arcs = static_cast<double>(curves_.unmatched_arcs);
  report.lost_points = static_cast<double>(lost_points_);
  report.base_width = adhesion_summary_.base_width;

  std::vector<double> curvature(points_.size());
  curvatures(curves_, points_, polynomial_points_, curvature);
  double weight = 0, first = 0, second = 0, magnitudes = 0;
  Vector sum;
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    const SurfaceCurves::Range range = curves_.curve(c);
    if (!range.carries_force()) continue;
    report.curve_count += 1.0;
    for (std::size_t k = range.first; k < range.last; ++k) {
      const double arc_length =
          0.5 * (length(points_[range.next(k)] - points_[k]) + length(points_[k] - points_[range.previous(k)]));
      weight += arc_length;
      first += arc_length * curvature[k];
      second += arc_length * curvature[k] * curvature[k];
      sum += forces_[k];
      magnitudes += length(forces_[k]);
    }
  }
  if (weight > 0) {
    report.mean_curvature = first / weight;
    report.curvature_scatter =
        std::sqrt(std::max(0.0, second / weight - report.mean_curvature * report.mean_curvature));
  }
  if (magnitudes > 0) report.net_force = length(sum) / magnitudes;
  return report;
}

}  // namespace sphdrop
