#pragma once
// A drop where the run begins with it.

#include <cstdint>
#include <vector>

#include "config/case.hpp"
#include "particles/vector.hpp"
#include "rigid_body/mass_properties.hpp"
#include "setup/box.hpp"
#include "setup/droplet.hpp"
#include "setup/initial_particles.hpp"
#include "setup/share.hpp"

namespace sphdrop {

/// Its particles have the ids from `first_id` on. Like Drop it stores none.
class PlacedDrop {
 public:
  /// `input`: with this drop alone; `centre` in m. Throws SetupError for an oscillating drop without a radius.
  PlacedDrop(const Case& input, Drop drop, Vector centre, std::int64_t first_id);

  IdRange ids() const { return {first_id_, first_id_ + drop_.count()}; }
  Vector centre() const { return centre_; }

  /// Calls f(id, position, mass) for all particles in ascending order.
  template <class F>
  void for_each(F&& f) const {
    drop_.for_each(
        [&](std::int64_t k, Vector from_centre, double mass) { f(first_id_ + k, place(k, from_centre), mass); });
  }
  /// Likewise for those in `box`.
  template <class F>
  void for_each_in(const Box& box, F&& f) const {
    // Moving rounds, so that a particle just outside may come to lie inside.
    const Box about_centre = box.moved_by(-centre_).grown_by(margin_);
    drop_.for_each_about(about_centre, [&](std::int64_t k, Vector from_centre, double mass) {
      const Vector here = place(k, from_centre);
      if (box.contains(here)) f(first_id_ + k, here, mass);
    });
  }

  /// The smallest that holds all particles.
  const Box& bounds() const { return bounds_; }
  /// False where no particle is within `distance` (m) of the place.
  bool is_near(Vector place, double distance) const { return drop_.is_near(place - centre_, distance + margin_); }

  /// Adds the particles with ids in `wanted`.
  void append_to(InitialFluid& fluid, IdRange wanted) const;

 private:
  Vector place(std::int64_t k, Vector from_centre) const {
    const auto row = static_cast<std::size_t>(k);
    return unmoved_ != nullptr ? Vector{unmoved_->x[row], unmoved_->y[row]} : centre_ + from_centre;
  }
  Vector velocity(std::int64_t k, Vector from_centre) const;
  Box find_bounds() const;

  Case input_;
  Drop drop_;
  Vector centre_;
  std::int64_t first_id_;
  const GivenParticles* unmoved_;  // particles that stay where their file has them, or null
  Vector mass_centre_;             // of a rigid drop, from its centre
  Box bounds_;
  double margin_;  // m, more than rounding moves a particle
};

/// The velocity that the case gives to the drop's liquid at a place from its centre (m), m/s.
Vector drop_velocity(const Case& input, Vector from_centre);

/// Of all drops' particles together, as one body.
MassProperties mass_properties(const std::vector<PlacedDrop>& drops);

}  // namespace sphdrop
