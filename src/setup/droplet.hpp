#pragma once
// Drops, centred at the origin (method: Sec. 4.1; the arrangement of the particles is a choice of this program).

#include <algorithm>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "particles/vector.hpp"
#include "setup/particle_lines.hpp"
#include "setup/share.hpp"
#include "setup/split_mix.hpp"

namespace sphdrop {

/// Particles of a drop. Shapes: [particles]; m, kg per metre of depth.
struct DropParticles {
  std::vector<Vector> positions;
  std::vector<double> masses;
};

/// A drop's particles k = 0, 1, ..., each found when it is asked for: what is kept is a number a line of them, unless
/// they come from a file. Whoever needs something of all of them walks through them and stores nothing.
class Drop {
 public:
  using Arrangement = std::variant<ListedParticles, Rings, LatticeColumns, SquareColumns>;

  /// Without particles.
  Drop() : Drop(ListedParticles()) {}
  explicit Drop(Arrangement arrangement);

  /// Moves every coordinate by a random amount, uniform in +-`amplitude` (m); the same for the same seed on every
  /// machine.
  void jitter(double amplitude, std::int64_t seed);
  /// Of each particle, beside that of the whole drop, m/s. None unless they were given.
  void set_velocities(std::vector<Vector> velocities) { velocities_ = std::move(velocities); }

  std::int64_t count() const { return line_begins_.back(); }
  const std::vector<Vector>& velocities() const { return velocities_; }

  /// Calls f(k, position, mass) for all particles, or those in `range`, in ascending order.
  template <class F>
  void for_each(F&& f) const {
    for_each({0, count()}, f);
  }
  template <class F>
  void for_each(IdRange range, F&& f) const {
    walk(
        range, [](const auto&) { return true; },
        [&](std::int64_t k, Vector position, double mass) {
          f(k, position, mass);
          return true;
        });
  }
  /// Likewise for those in `box` and perhaps others.
  template <class F>
  void for_each_about(const Box& box, F&& f) const {
    const Box wide = box.grown_by(jitter_bound());
    walk(
        {0, count()}, [&](const auto& line) { return wide.meets(line.box()); },
        [&](std::int64_t k, Vector position, double mass) {
          f(k, position, mass);
          return true;
        });
  }
  /// Whether is_so(position) holds for all in `box`, where it holds for all others; asks no more than it must.
  template <class F>
  bool all_about(const Box& box, F&& is_so) const {
    const Box wide = box.grown_by(jitter_bound());
    return walk(
        {0, count()}, [&](const auto& line) { return wide.meets(line.box()); },
        [&](std::int64_t, Vector position, double) { return !box.contains(position) || is_so(position); });
  }

  /// The smallest that holds all particles.
  Box bounds() const;
  /// False where no particle is within `distance` (m) of the place.
  bool is_near(Vector place, double distance) const;
  DropParticles all() const;

 private:
  /// Calls f(k, position, mass), which says whether to go on, for those in `range` of the lines that are wanted.
  template <class Wanted, class F>
  bool walk(IdRange range, Wanted&& is_wanted, F&& f) const {
    return std::visit(
        [&](const auto& lines) {
          const auto begin = std::upper_bound(line_begins_.begin(), line_begins_.end(), range.first);
          auto l = static_cast<std::size_t>(begin - line_begins_.begin()) - 1;
          for (; l + 1 < line_begins_.size() && line_begins_[l] < range.last; ++l) {
            const auto line = lines.line(l);
            if (line_begins_[l] == line_begins_[l + 1] || !is_wanted(line)) continue;
            const std::int64_t last = std::min(range.last, line_begins_[l + 1]);
            for (std::int64_t k = std::max(range.first, line_begins_[l]); k < last; ++k) {
              const std::int64_t j = k - line_begins_[l];
              if (!f(k, jittered(k, line.place(j)), line.mass(j))) return false;
            }
          }
          return true;
        },
        arrangement_);
  }

  Vector jittered(std::int64_t k, Vector place) const {
    if (jitter_amplitude_ == 0.0) return place;
    // Two numbers a particle, whoever had those before.
    SplitMix64 random(seed_);
    random.skip(2 * static_cast<std::uint64_t>(k));
    place.x += jitter_amplitude_ * random.next_symmetric();
    place.y += jitter_amplitude_ * random.next_symmetric();
    return place;
  }
  /// How far from its line a particle may be in x or y, rounding included.
  double jitter_bound() const { return jitter_amplitude_ + rounding_; }

  Arrangement arrangement_;
  std::vector<std::int64_t> line_begins_;  // by line, and the number of particles at the end
  std::vector<Vector> velocities_;
  double jitter_amplitude_ = 0, rounding_ = 0;
  std::uint64_t seed_ = 0;
};

/// A round drop of `radius` R (m) as concentric rings, ring k at radius (k + 1/2) d', d' = R / round(R/d), with
/// round(2 pi (k + 1/2)) particles that carry the density times the area of their annulus: exactly rho pi R^2 in all.
/// Ring by ring from the centre. `spacing` d in m, `density` in kg/m3.
Drop round_drop_of_rings(double radius, double spacing, double density);

/// A round drop of `radius` (m) cut out of a square lattice that is symmetric about its centre, with equal masses that
/// add up to rho pi R^2; column by column.
Drop round_drop_of_lattice(double radius, double spacing, double density);

/// An elliptic drop of the semi-axes `half_width` and `half_height` (m), cut out of the lattice likewise.
Drop elliptic_drop(double half_width, double half_height, double spacing, double density);

/// A square drop of `side` (m): n x n particles, n = round(side/d), at the centres of n x n cells; column by column.
Drop square_drop(double side, double spacing, double density);

/// The velocity that sets a drop oscillating, m/s (Sec. 4.1): the divergence-free field with stream function
/// V0 (x y / r0) exp(-r/r0), i.e. v_x = V0 (x/r0)(1 - y^2/(r0 r)) exp(-r/r0), v_y = -V0 (y/r0)(1 - x^2/(r0 r))
/// exp(-r/r0). `from_centre` in m, `amplitude` V0 in m/s, `decay_radius` r0 in m.
Vector oscillation_velocity(Vector from_centre, double amplitude, double decay_radius);

}  // namespace sphdrop
