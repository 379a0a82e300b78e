#include "simulation/surface_tension_step.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "diagnostics/number_reader.hpp"
#include "fluid/particle_shifting.hpp"
#include "simulation/surface_share.hpp"
#include "sph/cell_grid.hpp"
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
      skin_(input.parallel.skin * input.resolution.spacing),
      polynomial_points_(static_cast<int>(input.surface_tension.polynomial_points)),
      orients_particles_(input.fluid.shifting == Switch::on),
      displacement_is_relative_(input.surface_tension.detection_motion == DetectionMotion::relative &&
                                !input.is_wetting()),
      search_(support_),
      sharing_work_(communicator, surface_energy_quantum(coefficient_, spacing_)),
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
    place_points(fluid);
    if (is_wetting_) contact.gather_boundary(solid);
    old = extent_on_all_ranks(contact, gauge_pressure != 0.0);
  }
  fluid.for_each_owned([&](std::size_t row) { fluid.detection_position.set(row, fluid.position.at(row)); });
  find_arcs(fluid, distribution);
  regather(fluid, contact, distribution);
  if (has_curves_) {
    const Extent present = extent_on_all_ranks(contact, gauge_pressure != 0.0);
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
  return {has_curves_ ? 1.0 : 0.0, reconnected_length_, reconnected_base_, reconnected_gauge_energy_,
          sharing_work_.total()};
}

void SurfaceTensionStep::from_numbers(std::span<const double> numbers) {
  NumberReader reader(numbers, "surface");
  has_curves_ = reader.flag();
  reconnected_length_ = reader.number();
  reconnected_base_ = reader.number();
  reconnected_gauge_energy_ = reader.number();
  sharing_work_.restore(reader.number());
  reader.expect_end();
}

// The present surface points, on the curves of the last detection.
void SurfaceTensionStep::place_points(const FluidParticles& fluid) {
  start(fluid);
  receive();
  place_nodes();
  surface_points(curves_, node_positions_, spacing_, points_);
}

void SurfaceTensionStep::place_nodes() {
  for (std::size_t k = 0; k < node_place_.size(); ++k) {
    node_positions_[k] = positions_[static_cast<std::size_t>(node_place_[k])];
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
  std::vector<Vector> centres, points(curves.nodes.size());
  for (const SurfaceCurves::Node& node : curves.nodes) centres.push_back(node.centre);
  surface_points(curves, centres, spacing_, points);
  curve_count_ = 0;
  for (std::size_t c = 0; c < curves.size(); ++c) curve_count_ += curves.curve(c).carries_force() ? 1.0 : 0.0;
  // A surface point acts as far as 2h. Until the next detection both ends move by its displacement and a step, the
  // point a little more, as it also turns about its particle. Between detection and distribution, whichever came first,
  // two particles move against each other by as much, or by a skin.
  const double action = support_ + 6.0 * detection_displacement_ + 0.02 * spacing_;
  const double looseness = std::max(skin_, 2.0 * detection_displacement_) + 0.1 * spacing_;
  SurfaceShare share = share_of_surface(communicator_, fluid, distribution, curves, points, {action, looseness},
                                        is_wetting_ ? contact.owner() : -1);
  band_ = CollectedRows(communicator_, {fluid.id.data(), fluid.id.size()}, std::move(share.rows),
                        std::move(share.sends), tags::surface);
  const std::size_t collected = band_.size();
  positions_.assign(collected + 1, ForceSharing::far_away);
  band_.start(std::array<const void*, 2>{fluid.detection_position.x.data(), fluid.detection_position.y.data()});
  band_.finish_pairs(&positions_[0].x);
  inverse_mass_.clear();
  for (const std::int32_t row : band_.own_rows())
    inverse_mass_.push_back(1.0 / fluid.mass[static_cast<std::size_t>(row)]);
  take_piece(piece_of_curves(std::move(curves), share.is_wanted, steps_of_a_force), contact.owner());
  place_nodes();
  surface_points(curves_, node_positions_, spacing_, points_);
  sharing_.rebuild(points_, std::span(positions_).first(collected), band_.order().by_id(), action);
  if (works_on_adhesion()) adhesion_.rebuild(node_positions_, contact.boundary(), adhesion_reach_);
}

void SurfaceTensionStep::take_piece(CurvePiece piece, int contact_owner) {
  curves_ = std::move(piece.curves);
  beyond_ = std::move(piece.beyond);
  const std::size_t nodes = curves_.nodes.size();
  for (auto* by_node : {&node_positions_, &points_, &forces_, &turning_}) by_node->resize(nodes);
  chords_.resize(nodes);
  node_place_.clear();
  for (const SurfaceCurves::Node& node : curves_.nodes) {
    node_place_.push_back(band_.order().place_of(node.particle));
    assert(node_place_.back() >= 0);
  }
  own_nodes_.clear();
  const std::span<const std::int32_t> own_rows = band_.own_rows();
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    const SurfaceCurves::Range curve = curves_.curve(c);
    if (!curve.carries_force()) continue;
    for (std::size_t k = curve.first; k < curve.last; ++k)
      if (const auto place = static_cast<std::size_t>(node_place_[k]); place < own_rows.size())
        own_nodes_.push_back({static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(curve.previous(k)),
                              static_cast<std::uint32_t>(curve.next(k)), static_cast<std::uint32_t>(own_rows[place]),
                              piece.first_places[c]});
  }
  energies_.resize(inverse_mass_.size() + own_nodes_.size());
  if (!is_wetting_) return;
  std::vector<std::int64_t> numbers(piece.number.begin(), piece.number.end());
  std::vector<std::int32_t> places(nodes);
  std::iota(places.begin(), places.end(), 0);
  node_forces_ = InterfaceGather(communicator_, numbers, places, contact_owner, tags::surface + 1);
  all_forces_.resize(nodes);
  for (auto* column : {&force_x_, &force_y_}) column->resize(nodes);
  for (auto* column : {&sent_force_x_, &sent_force_y_}) column->resize(node_forces_.ids().size());
}

void SurfaceTensionStep::start(const FluidParticles& fluid) {
  band_.start(std::array<const void*, 2>{fluid.position.x.data(), fluid.position.y.data()});
}

void SurfaceTensionStep::receive() {
  band_.finish_pairs(&positions_[0].x);
}

void SurfaceTensionStep::work(ContactStep& contact, double gauge_pressure) {
  place_nodes();
  surface_points(curves_, node_positions_, spacing_, points_, chords_);
  if (form_ == SurfaceTensionForm::conservative)
    conservative_forces(curves_, points_, coefficient_, forces_);
  else
    curvature_forces(curves_, points_, coefficient_, polynomial_points_, forces_);
  if (gauge_pressure != 0.0) add_pressure_forces(curves_, points_, gauge_pressure, forces_);
  for (const std::int32_t node : beyond_) forces_[static_cast<std::size_t>(node)] = {};
  if (is_wetting_)
    add_adhesion(contact);
  else
    share();
}

// Sent on its way: others need not wait before they have nothing else to do.
void SurfaceTensionStep::add_adhesion(ContactStep& contact) {
  if (works_on_adhesion()) {
    all_forces_ = forces_;
    adhesion_summary_ = adhesion_.apply(curves_, points_, contact.boundary().segments, contact.boundary_forces(),
                                        adhesion_parameters_, all_forces_);
    // It has all nodes, each in its place.
    for (std::size_t k = 0; k < node_forces_.ids().size(); ++k) {
      const Vector force = all_forces_[static_cast<std::size_t>(node_forces_.ids()[k])];
      sent_force_x_[k] = force.x;
      sent_force_y_[k] = force.y;
    }
  }
  node_forces_.start_scatter(std::array<const void*, 2>{sent_force_x_.data(), sent_force_y_.data()});
}

void SurfaceTensionStep::share() {
  shares_ = sharing_.share(points_, is_wetting_ ? all_forces_ : forces_, positions_, kernel_);
}

void SurfaceTensionStep::finish(FluidParticles& fluid, double kick) {
  if (is_wetting_) {
    node_forces_.finish_scatter(std::array<void*, 2>{force_x_.data(), force_y_.data()});
    for (std::size_t k = 0; k < all_forces_.size(); ++k) all_forces_[k] = {force_x_[k], force_y_[k]};
    for (const std::int32_t node : beyond_) all_forces_[static_cast<std::size_t>(node)] = {};
    share();
  }
  const std::span<const std::int32_t> rows = band_.own_rows();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto row = static_cast<std::size_t>(rows[k]);
    const Vector force = shares_[k];
    fluid.acceleration.x[row] += force.x * inverse_mass_[k];
    fluid.acceleration.y[row] += force.y * inverse_mass_[k];
    energies_[k] = kick * (force.x * fluid.velocity.x[row] + force.y * fluid.velocity.y[row]);
  }
  account_for_points(fluid, kick);
  sharing_work_.add(energies_);
}

void SurfaceTensionStep::account_for_points(const FluidParticles& fluid, double kick) {
  const std::vector<Vector>& forces = is_wetting_ ? all_forces_ : forces_;
  turning_forces(curves_, node_positions_, chords_, spacing_, forces, turning_);
  const std::span<double> energies = std::span(energies_).subspan(inverse_mass_.size());
  for (std::size_t k = 0; k < own_nodes_.size(); ++k) {
    const OwnNode& own = own_nodes_[k];
    const Vector on_node = forces[own.node] + turning_[own.previous] - turning_[own.next];
    energies[k] = -kick * dot(on_node, fluid.velocity.at(own.row));
  }
}

}  // namespace sphdrop
