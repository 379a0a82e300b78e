#pragma once
// Which particles lie on the liquid's boundary, and which part of it each one holds (Sec 2.5; Dilts 2000).

#include <cmath>
#include <cstddef>
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

  /// The same in parts, for whoever goes through the neighbours anyway: for a new particle; neighbours; and the arcs,
  /// after which further neighbours may follow. One that is added twice counts as one.
  void start() { count_ = 0; }
  /// From the particle to a neighbour (m, not zero), with the square of its distance (m2), below squared_reach().
  void add(Vector separation, double squared_distance, std::int64_t neighbour) {
    make_room_for(1);
    separation_x_[count_] = separation.x;
    separation_y_[count_] = separation.y;
    squared_distances_[count_] = squared_distance;
    neighbours_[count_] = neighbour;
    ++count_;
  }
  /// Of those at (x, y) (m; shapes of x, y and ids: [n]), those whose squared distance from `centre` is at least `low`
  /// and below `high`, which is at most squared_reach(), m2.
  void add_between(double low, double high, Vector centre, std::span<const double> x, std::span<const double> y,
                   std::span<const std::int64_t> ids) {
    make_room_for(ids.size());
    double *separation_x = separation_x_.data() + count_, *separation_y = separation_y_.data() + count_;
    double* squared_distances = squared_distances_.data() + count_;
    std::int64_t* neighbours = neighbours_.data() + count_;
    // Without branches: whether the next one counts cannot be foretold.
    std::size_t count = 0;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const Vector separation = Vector{x[k], y[k]} - centre;
      const double squared = squared_length(separation);
      separation_x[count] = separation.x;
      separation_y[count] = separation.y;
      squared_distances[count] = squared;
      neighbours[count] = ids[k];
      count += (squared >= low ? 1U : 0U) & (squared < high ? 1U : 0U);
    }
    count_ += count;
  }
  std::size_t added_count() const { return count_; }
  void append_arcs(std::int64_t particle, std::vector<Arc>& arcs);
  /// (4h)^2, a little less: circles that only touch cover nothing. m2.
  double squared_reach() const { return largest_squared_distance_; }

 private:
  /// A neighbour, by its place among those added.
  using Place = std::size_t;

  void make_room_for(std::size_t more) {
    if (count_ + more > neighbours_.size()) make_room(count_ + more);
  }
  void make_room(std::size_t wanted);
  void find_covers();
  Vector start_of(Place k) const { return {start_x_[k], start_y_[k]}; }
  Vector end_of(Place k) const { return {end_x_[k], end_y_[k]}; }
  bool is_farther(Place a, Place b) const;
  double least(const std::vector<double>& values) const;
  /// Which of them has that value, the lowest particle of several.
  Place place_of(double value, const std::vector<double>& values) const;
  Place nearest() const;
  /// Whose cover `direction` is in and goes on farthest from there; count_ if none goes on.
  Place farthest_reaching(Vector direction);
  /// Whose cover starts first, counterclockwise from `direction`.
  Place first_to_start(Vector direction);
  /// The farthest of those whose covers end, or start, where that of `k` does.
  Place farthest_with_end_of(Place k) const;
  Place farthest_with_start_of(Place k) const;
  Place farthest_with_direction(Place k, const std::vector<double>& x, const std::vector<double>& y) const;

  double largest_squared_distance_;
  double inverse_diameter_;  ///< 1/(4h)
  double inverse_squared_diameter_;

  // Of the particle at hand, by neighbour; the part of its circle that a neighbour covers runs counterclockwise from
  // start to end, under half a turn. Whole vectors, of which those that count_ leaves open repeat the last neighbour.
  std::size_t count_ = 0;
  std::vector<std::int64_t> neighbours_;
  std::vector<double> separation_x_, separation_y_, squared_distances_;
  std::vector<double> start_x_, start_y_, end_x_, end_y_;
  std::vector<double> values_;  ///< scratch
};

}  // namespace sphdrop
