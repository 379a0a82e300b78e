#include "setup/nearest_neighbour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sphdrop {
namespace {

/// A balanced tree without nodes: the middle of each part of `order_` divides it, by x and y in turn.
class PointTree {
 public:
  explicit PointTree(std::span<const Vector> points) : points_(points), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    divide(0, order_.size(), true);
  }

  /// The nearest other point and its squared distance.
  std::pair<std::int32_t, double> nearest_to(std::int32_t point) const {
    Search search{point, points_[static_cast<std::size_t>(point)]};
    visit(search, 0, order_.size(), true);
    return {search.best, search.squared};
  }

 private:
  struct Search {
    std::int32_t point;
    Vector place;
    std::int32_t best = -1;
    double squared = std::numeric_limits<double>::infinity();
  };

  double coordinate(std::int32_t point, bool is_x) const {
    const Vector& place = points_[static_cast<std::size_t>(point)];
    return is_x ? place.x : place.y;
  }

  void divide(std::size_t begin, std::size_t end, bool is_x) {
    if (end - begin < 2) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::int32_t a, std::int32_t b) {
      const double x = coordinate(a, is_x), y = coordinate(b, is_x);
      return x != y ? x < y : a < b;
    });
    divide(begin, middle, !is_x);
    divide(middle + 1, end, !is_x);
  }

  void visit(Search& search, std::size_t begin, std::size_t end, bool is_x) const {
    if (begin >= end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const std::int32_t here = order_[middle];
    const double squared = squared_length(points_[static_cast<std::size_t>(here)] - search.place);
    if (here != search.point && squared < search.squared) {
      search.squared = squared;
      search.best = here;
    }
    const double across = (is_x ? search.place.x : search.place.y) - coordinate(here, is_x);
    const bool is_below = across < 0;
    visit(search, is_below ? begin : middle + 1, is_below ? middle : end, !is_x);
    if (across * across < search.squared) visit(search, is_below ? middle + 1 : begin, is_below ? end : middle, !is_x);
  }

  std::span<const Vector> points_;
  std::vector<std::int32_t> order_;
};

}  // namespace

NearestNeighbours nearest_neighbours(std::span<const Vector> points) {
  const PointTree tree(points);
  NearestNeighbours found;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto [index, squared] = tree.nearest_to(static_cast<std::int32_t>(k));
    found.index.push_back(index);
    found.distance.push_back(std::sqrt(squared));
  }
  return found;
}

double median_distance(const NearestNeighbours& neighbours) {
  std::vector<double> distances = neighbours.distance;
  if (distances.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

}  // namespace sphdrop
