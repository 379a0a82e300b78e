// What stops a run, and what is said about it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulation/simulation.hpp"

namespace sphdrop {

namespace {

enum class Body : std::int64_t { liquid, rigid_drop, solid };

Body drop_of(const Case& input) {
  return input.drop.is_rigid() ? Body::rigid_drop : Body::liquid;
}

// A particle that must not be computed on; the lowest id over all ranks is the one that is named.
struct Suspect {
  std::int64_t id = -1;
  double x = 0, y = 0, velocity_x = 0, velocity_y = 0, density = 0;
  Body body = Body::liquid;
};

template <class Set>
void find_suspects(const Set& set, double speed_limit, Body body, std::vector<Suspect>& found) {
  set.for_each_owned([&](std::size_t row) {
    const Vector v = set.staggered_velocity.at(row);
    const Vector p = set.position.at(row);
    const bool sound = squared_length(v) <= speed_limit * speed_limit && std::isfinite(p.x) && std::isfinite(p.y);
    if (!sound) found.push_back({set.id[row], p.x, p.y, v.x, v.y, set.staggered_density[row], body});
  });
}

std::string describe(const Suspect& s) {
  static constexpr const char* names[] = {"liquid", "rigid drop's", "solid"};
  return fmt::format("{} particle {} at ({:.6g}, {:.6g}) m, velocity ({:.6g}, {:.6g}) m/s, density {:.6g} kg/m3",
                     names[static_cast<std::size_t>(s.body)], s.id, s.x, s.y, s.velocity_x, s.velocity_y, s.density);
}

}  // namespace

void Simulation::check_safety(double failure) {
  if (failure > 0) stop_with_diagnosis();
}

void Simulation::stop_with_diagnosis() {
  stop_where_inverted();
  std::vector<Suspect> mine;
  find_suspects(fluid_, case_.safety.speed_limit, drop_of(case_), mine);
  find_suspects(solid_, case_.safety.speed_limit, Body::solid, mine);
  std::vector<Suspect> all = communicator_.all_gather(std::span<const Suspect>(mine));
  if (!all.empty()) {
    const Suspect& first =
        *std::min_element(all.begin(), all.end(), [](const Suspect& a, const Suspect& b) { return a.id < b.id; });
    const bool finite = std::isfinite(first.velocity_x) && std::isfinite(first.velocity_y) && std::isfinite(first.x) &&
                        std::isfinite(first.y);
    throw SafetyError(fmt::format(
        "step {}, t = {:.6g} s: {} ({} particle{} in all): {}. The state is not sound: try a smaller time.step or CFL "
        "number, "
        "or look at the last snapshots for what went wrong{}.",
        step_, time_, finite ? "a particle is faster than safety.speed_limit" : "a value is not a number", all.size(),
        all.size() == 1 ? "" : "s", describe(first),
        finite ? fmt::format("; if such speeds are meant, raise safety.speed_limit, now {:.6g} m/s",
                             case_.safety.speed_limit)
               : std::string()));
  }
  // Otherwise it was the contact's overlap, which its owner knows about.
  std::vector<double> deepest;
  if (communicator_.rank() == contact_.owner())
    deepest = {static_cast<double>(contact_.deepest_particle()), contact_.summary().largest_overlap};
  communicator_.broadcast(deepest, contact_.owner());
  const auto id = static_cast<std::int64_t>(deepest[0]);
  fluid_.for_each_owned([&](std::size_t row) {
    if (fluid_.id[row] == id) {
      const Vector p = fluid_.position.at(row), v = fluid_.staggered_velocity.at(row);
      mine.push_back({id, p.x, p.y, v.x, v.y, fluid_.staggered_density[row], drop_of(case_)});
    }
  });
  all = communicator_.all_gather(std::span<const Suspect>(mine));
  const char* advice =
      case_.contact.stiffness_form == ContactStiffness::time_step
          ? "The contact's spring would throw it out: try a smaller time.step, or contact.overlap_limit "
            "if you know that it is harmless."
          : "The contact's springs are too soft for such an impact: try a larger contact.stiffness, or a "
            "larger fluid.sound_speed if the liquid itself is too soft.";
  throw SafetyError(
      fmt::format("step {}, t = {:.6g} s: overlap of {:.6g} m with the solid, more than contact.overlap_limit = {:.6g} "
                  "of the contact distance: {}. {}",
                  step_, time_, deepest[1], case_.contact.overlap_limit,
                  all.empty() ? fmt::format("particle {}", id) : describe(all[0]), advice));
}

void Simulation::stop_where_inverted() {
  struct Inverted {
    std::int64_t id;
    double determinant, x, y;
  };
  std::vector<Inverted> mine;
  if (inversion_) {
    const auto row = static_cast<std::size_t>(std::lower_bound(solid_.id.begin(), solid_.id.end(), inversion_->id) -
                                              solid_.id.begin());
    const Vector p = solid_.reference_position.at(row);
    mine.push_back({inversion_->id, inversion_->determinant, p.x, p.y});
  }
  const std::vector<Inverted> all = communicator_.all_gather(std::span<const Inverted>(mine));
  if (all.empty()) return;
  const Inverted& first =
      *std::min_element(all.begin(), all.end(), [](const Inverted& a, const Inverted& b) { return a.id < b.id; });
  throw SafetyError(fmt::format(
      "step {}, t = {:.6g} s: the solid is turned inside out at particle {}, from ({:.6g}, {:.6g}) m in the "
      "undeformed body: its area there is {:.4g} of what it was. Try a smaller time.step or CFL number, a "
      "finer resolution.spacing, or solid.material_law = \"neo_hookean\", which withstands compression.",
      step_, time_, first.id, first.x, first.y, first.determinant));
}

void Simulation::check_nothing_is_lost() {
  std::vector<Suspect> mine;
  const auto look = [&](const auto& set, Body body) {
    set.for_each_owned([&](std::size_t row) {
      const Vector p = set.position.at(row), v = set.staggered_velocity.at(row);
      if (!(p.x >= box_low_.x && p.x <= box_high_.x && p.y >= box_low_.y && p.y <= box_high_.y))
        mine.push_back({set.id[row], p.x, p.y, v.x, v.y, set.staggered_density[row], body});
    });
  };
  look(fluid_, drop_of(case_));
  look(solid_, Body::solid);
  const std::vector<Suspect> all = communicator_.all_gather(std::span<const Suspect>(mine));
  if (!all.empty()) {
    const Suspect& first =
        *std::min_element(all.begin(), all.end(), [](const Suspect& a, const Suspect& b) { return a.id < b.id; });
    throw SafetyError(
        fmt::format("step {}, t = {:.6g} s: {} particle{} left the domain, the box of the initial particles and "
                    "safety.domain_margin = "
                    "{:.6g} m about it: {}. Make the margin larger if it may fly so far.",
                    step_, time_, all.size(), all.size() == 1 ? "" : "s", case_.safety.domain_margin, describe(first)));
  }
  const auto count = communicator_.sum(static_cast<std::int64_t>(fluid_.owned_count() + solid_.owned_count()));
  if (count != fluid_total_ + solid_total_)
    throw SafetyError(fmt::format("step {}, t = {:.6g} s: {} particles of {} are left: they were lost between ranks",
                                  step_, time_, count, fluid_total_ + solid_total_));
}

}  // namespace sphdrop
