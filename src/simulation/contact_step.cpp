#include "simulation/contact_step.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <stdexcept>

#include "contact/contact_force.hpp"

namespace sphdrop {

namespace {

// A value that goes with some particles.
double mean_over(const ContactVertex& vertex, std::span<const double> of_particles) {
  double sum = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex.count); ++k)
    sum += vertex.weight[k] * of_particles[static_cast<std::size_t>(vertex.particle[k])];
  return sum;
}

std::int32_t place_of(std::int64_t wanted, std::span<const std::int64_t> ascending) {
  return static_cast<std::int32_t>(std::lower_bound(ascending.begin(), ascending.end(), wanted) - ascending.begin());
}

}  // namespace

ContactStep::ContactStep(const Communicator& communicator, const Case& input, const InitialSolid& solid,
                         std::int64_t first_id)
    : communicator_(communicator),
      time_step_stiffness_(input.contact.stiffness_form == ContactStiffness::time_step ? input.contact.stiffness : 0.0),
      drop_is_rigid_(input.drop.is_rigid()),
      is_wetting_(input.is_wetting()),
      spacing_(input.resolution.spacing),
      vertices_are_particles_(solid.contact_vertices.empty()) {
  const double d = input.resolution.spacing;
  parameters_.contact_distance = input.contact.distance_ratio * d;
  parameters_.overlap_limit = input.contact.overlap_limit;
  if (input.contact.stiffness_form == ContactStiffness::fixed)
    parameters_.spring_stiffness = input.contact.stiffness * input.contact_modulus();
  parameters_.damping_ratio = input.contact.damping_ratio;
  parameters_.drag_rate = input.contact.wall_drag * input.fluid.viscosity / (input.fluid.density * d * d);
  std::vector<std::int32_t> used;  // vertices of the boundary, ascending
  for (const auto& polyline : solid.contact_polylines) used.insert(used.end(), polyline.begin(), polyline.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::int32_t k : used)
    vertices_.push_back(vertices_are_particles_ ? ContactVertex::at_particle(k)
                                                : solid.contact_vertices[static_cast<std::size_t>(k)]);
  for (const ContactVertex& vertex : vertices_)
    for (std::size_t k = 0; k < static_cast<std::size_t>(vertex.count); ++k)
      particle_ids_.push_back(first_id + vertex.particle[k]);
  std::sort(particle_ids_.begin(), particle_ids_.end());
  particle_ids_.erase(std::unique(particle_ids_.begin(), particle_ids_.end()), particle_ids_.end());
  for (ContactVertex& vertex : vertices_)
    for (std::size_t k = 0; k < static_cast<std::size_t>(vertex.count); ++k)
      vertex.particle[k] = place_of(first_id + vertex.particle[k], particle_ids_);
  std::vector<std::vector<std::int32_t>> polylines;
  for (const auto& polyline : solid.contact_polylines) {
    std::vector<std::int32_t>& indices = polylines.emplace_back();
    for (const std::int32_t k : polyline)
      indices.push_back(static_cast<std::int32_t>(std::lower_bound(used.begin(), used.end(), k) - used.begin()));
  }
  segments_ = segments_of_polylines(polylines);
}

ContactParameters ContactStep::parameters(double step) const {
  ContactParameters present = parameters_;
  present.spring_rate = time_step_spring_rate(time_step_stiffness_, step);
  return present;
}

// A surface point is d/2 from its particle. Until the next redistribution liquid and boundary each move by half a skin
// at most.
double ContactStep::boundary_reach(const InteractionRange& range) const {
  return adhesion_parameters(spacing_, parameters_.contact_distance).range() + 0.5 * spacing_ + range.skin;
}

void ContactStep::regather(const FluidParticles& fluid, const SolidParticles& solid, const InteractionRange& range) {
  if (segments_.empty()) return;

  // The whole boundary on every rank: O(sqrt N) positions, once in hundreds of steps.
  struct BoundaryParticle {
    std::int64_t index;
    std::int64_t row;
    Vector position;
  };
  std::vector<BoundaryParticle> mine;
  solid.for_each_owned([&](std::size_t row) {
    const auto found = std::lower_bound(particle_ids_.begin(), particle_ids_.end(), solid.id[row]);
    if (found != particle_ids_.end() && *found == solid.id[row])
      mine.push_back({found - particle_ids_.begin(), static_cast<std::int64_t>(row), solid.position.at(row)});
  });
  std::vector<double> x(particle_ids_.size()), y(particle_ids_.size());
  for (const BoundaryParticle& p : communicator_.all_gather(std::span<const BoundaryParticle>(mine))) {
    x[static_cast<std::size_t>(p.index)] = p.position.x;
    y[static_cast<std::size_t>(p.index)] = p.position.y;
  }
  if (!vertices_are_particles_) {
    std::vector<double> at_x, at_y;
    for (const ContactVertex& vertex : vertices_) {
      at_x.push_back(mean_over(vertex, x));
      at_y.push_back(mean_over(vertex, y));
    }
    x = std::move(at_x);
    y = std::move(at_y);
  }

  // Until the next redistribution liquid and boundary each come nearer by half a skin at most.
  const double reach = parameters_.contact_distance + range.skin;
  ContactSolver search;
  const std::size_t owned = fluid.owned_count();
  search.rebuild({fluid.position.x.data(), owned}, {fluid.position.y.data(), owned}, x, y, segments_, reach);
  std::vector<std::int64_t> fluid_ids, wanted_here;
  fluid_rows_.assign(search.active_particles().begin(), search.active_particles().end());
  for (std::size_t k = 0; k < fluid_rows_.size(); ++k) {
    fluid_ids.push_back(fluid.id[static_cast<std::size_t>(fluid_rows_[k])]);
    for (const std::int32_t segment : search.candidates(k)) wanted_here.push_back(segment);
  }
  if (is_wetting_) {
    search.rebuild({fluid.position.x.data(), owned}, {fluid.position.y.data(), owned}, x, y, segments_,
                   boundary_reach(range));
    for (std::size_t k = 0; k < search.active_particles().size(); ++k)
      for (const std::int32_t segment : search.candidates(k)) wanted_here.push_back(segment);
  }
  std::sort(wanted_here.begin(), wanted_here.end());
  wanted_here.erase(std::unique(wanted_here.begin(), wanted_here.end()), wanted_here.end());
  std::vector<char> is_wanted(segments_.size(), 0);
  for (const std::int64_t segment : communicator_.all_gather(std::span<const std::int64_t>(wanted_here)))
    is_wanted[static_cast<std::size_t>(segment)] = 1;
  SurfacePart part = part_of_surface(segments_, is_wanted);

  std::vector<std::int64_t> solid_ids;
  solid_rows_.clear();
  part_.clear();
  for (const std::int32_t k : part.original_vertices) part_.push_back(vertices_[static_cast<std::size_t>(k)]);
  std::vector<std::int64_t> gathered;  // the particles of the part, ascending
  for (const ContactVertex& vertex : part_)
    gathered.insert(gathered.end(), vertex.particle.begin(), vertex.particle.begin() + vertex.count);
  std::sort(gathered.begin(), gathered.end());
  gathered.erase(std::unique(gathered.begin(), gathered.end()), gathered.end());
  for (ContactVertex& vertex : part_)
    for (std::size_t k = 0; k < static_cast<std::size_t>(vertex.count); ++k)
      vertex.particle[k] = place_of(vertex.particle[k], gathered);
  for (const BoundaryParticle& p : mine) {
    if (!std::binary_search(gathered.begin(), gathered.end(), p.index)) continue;
    solid_rows_.push_back(static_cast<std::int32_t>(p.row));
    solid_ids.push_back(solid.id[static_cast<std::size_t>(p.row)]);
  }
  const int owner = rank_with_most(communicator_, static_cast<std::int64_t>(fluid_rows_.size() + solid_rows_.size()));
  move_record(owner);
  fluid_gather_ = InterfaceGather(communicator_, fluid_ids, fluid_rows_, owner, tags::contact_fluid);
  solid_gather_ = InterfaceGather(communicator_, solid_ids, solid_rows_, owner, tags::contact_solid);
  returned_fluid_x_.assign(fluid_rows_.size(), 0.0);
  returned_fluid_y_.assign(fluid_rows_.size(), 0.0);
  returned_solid_x_.assign(solid_rows_.size(), 0.0);
  returned_solid_y_.assign(solid_rows_.size(), 0.0);

  const bool is_owner = owner == communicator_.rank();
  const std::size_t particles = fluid_gather_.ids().size(), vertices = is_owner ? part_.size() : 0;
  for (auto* column : {&fluid_x_, &fluid_y_, &fluid_mass_, &acceleration_x_, &acceleration_y_})
    column->resize(particles);
  for (auto* column : {&vertex_x_, &vertex_y_, &force_x_, &force_y_}) column->resize(vertices);
  if (!vertices_are_particles_) {
    for (auto* column : {&particle_x_, &particle_y_, &share_x_, &share_y_}) column->resize(solid_gather_.ids().size());
    if (parameters_.resists_motion())
      for (auto* column : {&particle_velocity_x_, &particle_velocity_y_}) column->resize(solid_gather_.ids().size());
  }
  if (parameters_.resists_motion()) {
    for (auto* column : {&fluid_velocity_x_, &fluid_velocity_y_}) column->resize(particles);
    for (auto* column : {&vertex_velocity_x_, &vertex_velocity_y_}) column->resize(vertices);
  }
  fluid_gather_.start_gather(
      std::array<const void*, 3>{fluid.position.x.data(), fluid.position.y.data(), fluid.mass.data()});
  fluid_gather_.finish_gather(std::array<void*, 3>{fluid_x_.data(), fluid_y_.data(), fluid_mass_.data()});
  // The particles of the part and gathered ids both ascend with the id, so their places agree.
  assert(!is_owner || solid_gather_.ids().size() == gathered.size());
  if (!is_owner) part_.clear();
  gather_boundary(solid);
  solver_.rebuild(fluid_x_, fluid_y_, vertex_x_, vertex_y_, is_owner ? part.segments : std::vector<Segment>{}, reach);
}

void ContactStep::move_record(int new_owner) {
  if (new_owner == owner_) return;
  from_numbers(to_numbers());
  owner_ = new_owner;
}

std::vector<double> ContactStep::to_numbers() const {
  std::vector<double> numbers;
  if (communicator_.rank() == owner_) {
    numbers = {last_force_.x,      last_force_.y,    last_moment_, staggered_angular_impulse_,
               dissipated_energy_, last_dissipation_};
    const std::vector<double> record = record_.to_numbers();
    numbers.insert(numbers.end(), record.begin(), record.end());
  }
  communicator_.broadcast(numbers, owner_);
  return numbers;
}

void ContactStep::from_numbers(std::span<const double> numbers) {
  constexpr std::size_t own = 6;
  if (numbers.size() < own) throw std::invalid_argument("the stored contact ends too early");
  last_force_ = {numbers[0], numbers[1]};
  last_moment_ = numbers[2];
  staggered_angular_impulse_ = numbers[3];
  dissipated_energy_ = numbers[4];
  last_dissipation_ = numbers[5];
  record_ = ContactRecord::from_numbers(numbers.subspan(own));
}

void ContactStep::start(const FluidParticles& fluid, const SolidParticles& solid) {
  if (segments_.empty()) return;
  if (parameters_.resists_motion()) {
    fluid_gather_.start_gather(std::array<const void*, 4>{fluid.position.x.data(), fluid.position.y.data(),
                                                          fluid.velocity.x.data(), fluid.velocity.y.data()});
    solid_gather_.start_gather(std::array<const void*, 4>{solid.position.x.data(), solid.position.y.data(),
                                                          solid.velocity.x.data(), solid.velocity.y.data()});
    return;
  }
  fluid_gather_.start_gather(std::array<const void*, 2>{fluid.position.x.data(), fluid.position.y.data()});
  solid_gather_.start_gather(std::array<const void*, 2>{solid.position.x.data(), solid.position.y.data()});
}

void ContactStep::gather_boundary(const SolidParticles& solid) {
  solid_gather_.start_gather(std::array<const void*, 2>{solid.position.x.data(), solid.position.y.data()});
  if (vertices_are_particles_) {
    solid_gather_.finish_gather(std::array<void*, 2>{vertex_x_.data(), vertex_y_.data()});
  } else {
    solid_gather_.finish_gather(std::array<void*, 2>{particle_x_.data(), particle_y_.data()});
    find_vertices();
  }
}

void ContactStep::find_vertices() {
  for (std::size_t k = 0; k < part_.size(); ++k) {
    vertex_x_[k] = mean_over(part_[k], particle_x_);
    vertex_y_[k] = mean_over(part_[k], particle_y_);
  }
}

void ContactStep::share_forces() {
  for (auto* column : {&share_x_, &share_y_}) std::fill(column->begin(), column->end(), 0.0);
  for (std::size_t k = 0; k < part_.size(); ++k)
    for (std::size_t n = 0; n < static_cast<std::size_t>(part_[k].count); ++n) {
      const auto particle = static_cast<std::size_t>(part_[k].particle[n]);
      share_x_[particle] += part_[k].weight[n] * force_x_[k];
      share_y_[particle] += part_[k].weight[n] * force_y_[k];
    }
}

void ContactStep::receive() {
  if (segments_.empty()) return;
  for (auto* column : {&force_x_, &force_y_}) std::fill(column->begin(), column->end(), 0.0);
  if (parameters_.resists_motion()) {
    fluid_gather_.finish_gather(
        std::array<void*, 4>{fluid_x_.data(), fluid_y_.data(), fluid_velocity_x_.data(), fluid_velocity_y_.data()});
    if (vertices_are_particles_) {
      solid_gather_.finish_gather(std::array<void*, 4>{vertex_x_.data(), vertex_y_.data(), vertex_velocity_x_.data(),
                                                       vertex_velocity_y_.data()});
      return;
    }
    solid_gather_.finish_gather(std::array<void*, 4>{particle_x_.data(), particle_y_.data(),
                                                     particle_velocity_x_.data(), particle_velocity_y_.data()});
    for (std::size_t k = 0; k < part_.size(); ++k) {
      vertex_velocity_x_[k] = mean_over(part_[k], particle_velocity_x_);
      vertex_velocity_y_[k] = mean_over(part_[k], particle_velocity_y_);
    }
    find_vertices();
    return;
  }
  fluid_gather_.finish_gather(std::array<void*, 2>{fluid_x_.data(), fluid_y_.data()});
  if (vertices_are_particles_) {
    solid_gather_.finish_gather(std::array<void*, 2>{vertex_x_.data(), vertex_y_.data()});
    return;
  }
  solid_gather_.finish_gather(std::array<void*, 2>{particle_x_.data(), particle_y_.data()});
  find_vertices();
}

void ContactStep::work(double time, double step, double kick, const AdhesionSummary& adhesion) {
  if (segments_.empty()) return;
  if (owner_ == communicator_.rank()) {
    for (auto* column : {&acceleration_x_, &acceleration_y_}) std::fill(column->begin(), column->end(), 0.0);
    summary_ = solver_.apply(
        {fluid_x_, fluid_y_, fluid_mass_, acceleration_x_, acceleration_y_, fluid_velocity_x_, fluid_velocity_y_},
        {vertex_x_, vertex_y_, force_x_, force_y_, vertex_velocity_x_, vertex_velocity_y_}, parameters(step));
    if (is_wetting_) {
      summary_.force_on_solid += adhesion.force_on_solid;
      summary_.moment_on_solid += adhesion.moment_on_solid;
    }
    const double previous_step = 2.0 * kick - step;
    impulse_ = record_.impulse() + 0.5 * previous_step * last_force_;
    last_force_ = summary_.force_on_solid;
    angular_impulse_ = staggered_angular_impulse_ + 0.5 * previous_step * last_moment_;
    staggered_angular_impulse_ += kick * summary_.moment_on_solid;
    last_moment_ = summary_.moment_on_solid;
    dissipated_energy_ += 0.5 * previous_step * (last_dissipation_ + summary_.dissipation);
    last_dissipation_ = summary_.dissipation;
    // Where the solid attracts the liquid, they touch as long as the liquid has a base.
    const std::int64_t touching = is_wetting_ ? (adhesion.base_width > 0.0 ? 1 : 0) : summary_.count;
    record_.add(time, kick, touching, summary_.force_on_solid);
  }
  if (!drop_is_rigid_)
    fluid_gather_.start_scatter(std::array<const void*, 2>{acceleration_x_.data(), acceleration_y_.data()});
  if (vertices_are_particles_) {
    solid_gather_.start_scatter(std::array<const void*, 2>{force_x_.data(), force_y_.data()});
    return;
  }
  share_forces();
  solid_gather_.start_scatter(std::array<const void*, 2>{share_x_.data(), share_y_.data()});
}

void ContactStep::finish(FluidParticles& fluid) {
  if (segments_.empty()) return;
  if (drop_is_rigid_)
    share_load();
  else
    accelerate_liquid(fluid);
  solid_gather_.finish_scatter(std::array<void*, 2>{returned_solid_x_.data(), returned_solid_y_.data()});
}

void ContactStep::accelerate_solid(SolidParticles& solid) const {
  for (std::size_t k = 0; k < solid_rows_.size(); ++k) {
    const auto row = static_cast<std::size_t>(solid_rows_[k]);
    solid.acceleration.x[row] += returned_solid_x_[k] / solid.mass[row];
    solid.acceleration.y[row] += returned_solid_y_[k] / solid.mass[row];
  }
}

void ContactStep::kick_solid(SolidParticles& solid, double kick) const {
  for (std::size_t k = 0; k < solid_rows_.size(); ++k) {
    const auto row = static_cast<std::size_t>(solid_rows_[k]);
    const double is_free = 1.0 - solid.is_fixed[row];
    solid.staggered_velocity.x[row] += kick * (returned_solid_x_[k] / solid.mass[row] * is_free);
    solid.staggered_velocity.y[row] += kick * (returned_solid_y_[k] / solid.mass[row] * is_free);
  }
}

void ContactStep::accelerate_liquid(FluidParticles& fluid) {
  fluid_gather_.finish_scatter(std::array<void*, 2>{returned_fluid_x_.data(), returned_fluid_y_.data()});
  for (std::size_t k = 0; k < fluid_rows_.size(); ++k) {
    const auto row = static_cast<std::size_t>(fluid_rows_[k]);
    fluid.acceleration.x[row] += returned_fluid_x_[k];
    fluid.acceleration.y[row] += returned_fluid_y_[k];
  }
}

void ContactStep::share_load() {
  load_numbers_.assign({summary_.force_on_solid.x, summary_.force_on_solid.y, summary_.moment_on_solid});
  communicator_.broadcast(load_numbers_, owner_);
  load_on_solid_ = {{load_numbers_[0], load_numbers_[1]}, load_numbers_[2]};
}

Vector ContactStep::force_on(const SolidIds& solid) const {
  Vector force;
  for (std::size_t k = 0; k < part_.size(); ++k) {
    const std::int64_t id = solid_gather_.ids()[static_cast<std::size_t>(part_[k].particle[0])];
    if (id >= solid.begin && id < solid.end) force += {force_x_[k], force_y_[k]};
  }
  return force;
}

std::int64_t ContactStep::deepest_particle() const {
  return summary_.deepest < 0 ? -1 : fluid_gather_.ids()[static_cast<std::size_t>(summary_.deepest)];
}

}  // namespace sphdrop
