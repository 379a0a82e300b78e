#pragma once
// Points sorted into square cells, to find those near a place.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "particles/vector.hpp"

namespace sphdrop {

/// A snapshot of points in cells at least `reach` wide, so that all points within `reach` of a place lie in the nine
/// cells about it.
class CellGrid {
 public:
  /// x, y: shape [n], m.
  CellGrid(std::span<const double> x, std::span<const double> y, double reach) {
    if (x.empty()) return;
    const auto [x_low, x_high] = std::minmax_element(x.begin(), x.end());
    const auto [y_low, y_high] = std::minmax_element(y.begin(), y.end());
    origin_ = {*x_low, *y_low};
    const double width = *x_high - *x_low, height = *y_high - *y_low;
    // A few strays far away must not cost memory: cells grow until there are at most a few a point.
    const double most_cells = 4.0 * static_cast<double>(x.size()) + 1024.0;
    double size = reach;
    while ((std::floor(width / size) + 1.0) * (std::floor(height / size) + 1.0) > most_cells) size *= 1.5;
    inverse_size_ = 1.0 / size;
    columns_ = static_cast<std::int64_t>(width * inverse_size_) + 1;
    rows_ = static_cast<std::int64_t>(height * inverse_size_) + 1;
    start_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    std::vector<std::int32_t> cell(x.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
      cell[k] = static_cast<std::int32_t>(cell_of({x[k], y[k]}));
      ++start_[static_cast<std::size_t>(cell[k]) + 1];
    }
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    points_.resize(x.size());
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < x.size(); ++k)
      points_[static_cast<std::size_t>(next[static_cast<std::size_t>(cell[k])]++)] = static_cast<std::int32_t>(k);
  }

  /// The points in the order of their cells: row after row, and along each row.
  std::span<const std::int32_t> points() const { return points_; }
  /// A part of points().
  struct Run {
    std::size_t first, last;
  };
  std::size_t row_count() const { return points_.empty() ? 0 : static_cast<std::size_t>(rows_); }
  Run row(std::size_t index) const {
    const std::size_t first_cell = index * static_cast<std::size_t>(columns_);
    return {static_cast<std::size_t>(start_[first_cell]),
            static_cast<std::size_t>(start_[first_cell + static_cast<std::size_t>(columns_)])};
  }
  /// Calls f(run) for every row of cells that meets the rectangle from `low` to `high`, with the run of the points in
  /// those of its cells that do: together a superset of the points in the rectangle.
  template <class F>
  void for_each_run(Vector low, Vector high, F&& f) const {
    if (points_.empty()) return;
    // Compared as doubles: a place may be too far away for an integer.
    const auto cell = [&](double place, double origin, std::int64_t cells) {
      return static_cast<std::int64_t>(
          std::clamp(std::floor((place - origin) * inverse_size_), -1.0, static_cast<double>(cells)));
    };
    const std::int64_t first_column = std::max<std::int64_t>(cell(low.x, origin_.x, columns_), 0);
    const std::int64_t last_column = std::min(cell(high.x, origin_.x, columns_), columns_ - 1);
    if (first_column > last_column) return;
    const std::int64_t last_row = std::min(cell(high.y, origin_.y, rows_), rows_ - 1);
    for (std::int64_t r = std::max<std::int64_t>(cell(low.y, origin_.y, rows_), 0); r <= last_row; ++r)
      f(Run{static_cast<std::size_t>(start_[static_cast<std::size_t>(r * columns_ + first_column)]),
            static_cast<std::size_t>(start_[static_cast<std::size_t>(r * columns_ + last_column) + 1])});
  }

  /// Calls f(index) for every point in the nine cells about `place`: a superset of those within reach.
  template <class F>
  void for_each_near(Vector place, F&& f) const {
    for_each_run_near(place, [&](std::span<const std::int32_t> run) {
      for (const std::int32_t k : run) f(k);
    });
  }

  /// Writes the indices of the points nearer to `place` than the root of `squared_reach` (m2, at most the grid's reach)
  /// to the beginning of `found`, which is made longer where it is too short; returns how many. x, y: those of the
  /// grid.
  std::size_t find_within(Vector place, double squared_reach, const double* x, const double* y,
                          std::vector<std::int32_t>& found) const {
    std::size_t count = 0;
    for_each_run_near(place, [&](std::span<const std::int32_t> run) {
      if (found.size() < count + run.size()) found.resize(count + run.size());
      // Without a branch: a third of the candidates are near, in no order that a processor could guess.
      for (const std::int32_t k : run) {
        const Vector separation = Vector{x[k], y[k]} - place;
        found[count] = k;
        count += squared_length(separation) < squared_reach ? 1 : 0;
      }
    });
    return count;
  }

 private:
  /// Calls f(indices) for the points of each row of the nine cells about `place`.
  template <class F>
  void for_each_run_near(Vector place, F&& f) const {
    if (points_.empty()) return;
    const double cx = std::floor((place.x - origin_.x) * inverse_size_);
    const double cy = std::floor((place.y - origin_.y) * inverse_size_);
    // Compared as doubles: a place may be too far away for an integer.
    if (!(cx >= -1.0 && cy >= -1.0 && cx <= static_cast<double>(columns_) && cy <= static_cast<double>(rows_))) return;
    const auto column = static_cast<std::int64_t>(cx), row = static_cast<std::int64_t>(cy);
    const std::int64_t first = std::max<std::int64_t>(column - 1, 0), last = std::min(column + 1, columns_ - 1);
    if (first > last) return;
    for (std::int64_t r = std::max<std::int64_t>(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
      const std::int32_t begin = start_[static_cast<std::size_t>(r * columns_ + first)];
      const std::int32_t end = start_[static_cast<std::size_t>(r * columns_ + last) + 1];
      f(std::span(points_).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)));
    }
  }

  std::int64_t cell_of(Vector p) const {
    const auto column = std::min(static_cast<std::int64_t>((p.x - origin_.x) * inverse_size_), columns_ - 1);
    const auto row = std::min(static_cast<std::int64_t>((p.y - origin_.y) * inverse_size_), rows_ - 1);
    return row * columns_ + column;
  }

  Vector origin_;
  double inverse_size_ = 1.0;
  std::int64_t columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> start_;   // by cell, row after row
  std::vector<std::int32_t> points_;  // sorted by cell
};

}  // namespace sphdrop
