#include "setup/placed_drop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rigid_body/rigid_body.hpp"
#include "setup/setup_error.hpp"

namespace sphdrop {

PlacedDrop::PlacedDrop(const Case& input, Drop drop, Vector centre, std::int64_t first_id)
    : input_(input),
      drop_(std::move(drop)),
      centre_(centre),
      first_id_(first_id),
      // To the file's centre and back again they would be rounded.
      unmoved_(input.drop.placement == DropPlacement::file ? input_.drop.given.particles.get() : nullptr) {
  if (input.drop.oscillation_velocity != 0.0 && !(input.drop.oscillation_radius > 0.0))
    throw SetupError("an oscillating drop needs an oscillation radius greater than 0");
  if (input.drop.is_rigid())
    mass_centre_ = mass_properties([&](auto&& add) {
                     drop_.for_each([&](std::int64_t, Vector position, double mass) { add(position, mass); });
                   }).centre;
  bounds_ = find_bounds();
  margin_ = 1e-12 * (length(centre) + std::max({std::abs(bounds_.low.x), std::abs(bounds_.low.y),
                                                std::abs(bounds_.high.x), std::abs(bounds_.high.y)}));
}

Box PlacedDrop::find_bounds() const {
  if (unmoved_ == nullptr) return drop_.bounds().moved_by(centre_);
  Box bounds;
  for_each([&](std::int64_t, Vector position, double) { bounds.include(position); });
  return bounds;
}

Vector PlacedDrop::velocity(std::int64_t k, Vector from_centre) const {
  Vector velocity = input_.drop.relaxation_time > 0.0 ? Vector{} : drop_velocity(input_, from_centre);
  if (input_.drop.is_rigid()) velocity = rigid_velocity(velocity, input_.drop.initial_spin, from_centre - mass_centre_);
  if (!drop_.velocities().empty()) velocity += drop_.velocities()[static_cast<std::size_t>(k)];
  return velocity;
}

void PlacedDrop::append_to(InitialFluid& fluid, IdRange wanted) const {
  const IdRange mine = ids().common_with(wanted);
  drop_.for_each({mine.first - first_id_, mine.last - first_id_}, [&](std::int64_t k, Vector from_centre, double mass) {
    fluid.positions.push_back(place(k, from_centre));
    fluid.velocities.push_back(velocity(k, from_centre));
    fluid.masses.push_back(mass);
  });
}

Vector drop_velocity(const Case& input, Vector from_centre) {
  Vector velocity{input.drop.velocity_x, input.drop.velocity_y};
  if (input.drop.oscillation_velocity != 0.0)
    velocity += oscillation_velocity(from_centre, input.drop.oscillation_velocity, input.drop.oscillation_radius);
  return velocity;
}

MassProperties mass_properties(const std::vector<PlacedDrop>& drops) {
  return mass_properties([&](auto&& add) {
    for (const PlacedDrop& drop : drops)
      drop.for_each([&](std::int64_t, Vector position, double mass) { add(position, mass); });
  });
}

}  // namespace sphdrop
