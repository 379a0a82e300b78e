#pragma once
// Which particles lie on the liquid's boundary, and which part of it each one holds (Sec 2.5; Dilts 2000).

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "particles/vector.hpp"

namespace sphdrop {

/// A piece of the circle of radius 2h about a boundary particle that no other particle's circle covers. Particles by
/// global id. An isolated particle, whose whole circle is uncovered, has previous = next = particle and start = end.
struct Arc {
  std::int64_t particle;  ///< whose circle it is
  std::int64_t previous;  ///< whose circle covers up to start
  std::int64_t next;      ///< whose circle covers from end on
  Vector start, end;      ///< unit directions from the particle to the two ends, counterclockwise from start to end
};

/// Finds the uncovered arcs of one particle at a time. A neighbour at distance r covers the directions within
/// acos(r / 2R) of its own, R = 2h, so every neighbour nearer than 2R = 4h counts, not only those within the kernel.
/// The ends of these arcs are found by algebra and compared by cross products: the same bits everywhere.
class ArcFinder {
 public:
  /// radius: R = 2h, m.
  explicit ArcFinder(double radius);

  /// Appends the uncovered arcs of `particle` at `centre` (m), if it has any, in counterclockwise order. The neighbours
  /// are all particles within 4h, in any order; farther ones and the particle itself may be among them and are ignored.
  /// Of particles at exactly the same place only the one with the lowest id can have arcs.
  void find(std::int64_t particle, Vector centre, std::span<const std::int64_t> neighbour_ids,
            std::span<const Vector> neighbour_positions, std::vector<Arc>& arcs);

  /// A cheap test: true if there are near ones among `neighbour_positions` in all directions, so that they cover the
  /// whole circle; then the particle has no arcs, whatever other neighbours it has. The kernel's own neighbours are
  /// enough to sort out nearly all interior particles. False says nothing.
  bool is_covered_by(Vector centre, std::span<const Vector> neighbour_positions) const;

  /// The same in parts, for whoever goes through the neighbours anyway: the bit of the octant of directions that holds
  /// a neighbour, 0 if it is not nearer than near_reach(), and whether the bits of all neighbours cover the circle.
  unsigned octant_of_near(Vector separation) const {
    const double squared_distance = squared_length(separation);
    const bool is_near = squared_distance < near_squared_distance_ && squared_distance > 0.0;
    const bool left = separation.x < 0.0;
    const bool below = separation.y < 0.0;
    const bool steep = std::abs(separation.y) > std::abs(separation.x);
    const unsigned octant = 4U * below + 2U * (left != below) + 1U * ((left != below) != steep);  // counterclockwise
    return static_cast<unsigned>(is_near) << octant;
  }
  /// A near neighbour covers more than an octant and a half to either side. Where no two octants in a row are empty,
  /// such neighbours are at most three octants apart and leave no gap.
  static bool covers_circle(unsigned octants) {
    const unsigned twice_round = octants | octants << 8U;
    return ((twice_round | twice_round >> 1U) & 0xFFU) == 0xFFU;
  }
  /// m
  double near_reach() const { return std::sqrt(near_squared_distance_); }

 private:
  /// The part of the particle's circle that one neighbour covers: counterclockwise from start to end, under half a
  /// turn.
  struct Cover {
    Vector start, end;
    double squared_distance;
    std::int64_t neighbour;
  };

  Cover cover_by(Vector separation, double squared_distance, std::int64_t neighbour) const;
  /// Of equally far ones the one of the lower neighbour, as of equally near ones.
  static bool is_nearer(const Cover& a, const Cover& b);
  static bool is_farther(const Cover& a, const Cover& b);
  /// The cover that `direction` is in and that goes on farthest from there; null where none goes on.
  const Cover* farthest_reaching(Vector direction) const;
  /// The cover that starts first, counterclockwise from `direction`.
  const Cover& first_to_start(Vector direction) const;
  /// The farthest neighbour's of the covers that end, or start, where this one does.
  const Cover& outermost_ending_with(const Cover& end) const;
  const Cover& outermost_starting_with(const Cover& start) const;
  void append_uncovered(std::int64_t particle, std::vector<Arc>& arcs) const;

  double largest_squared_distance_;  ///< (4h)^2, a little less: circles that only touch cover nothing
  double near_squared_distance_;     ///< nearer ones cover at least 67.5 degrees to either side: r < 2R cos 67.5
  double inverse_diameter_;          ///< 1/(4h)
  double inverse_squared_diameter_;
  std::vector<Cover> covers_;  ///< scratch: of the particle at hand
};

}  // namespace sphdrop
