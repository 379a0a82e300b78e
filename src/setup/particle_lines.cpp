#include "setup/particle_lines.hpp"

#include <algorithm>
#include <utility>

namespace sphdrop {

namespace {

// In fractions of a turn. Successive rings are turned by an irrational part of a turn, so that they never line up.
constexpr double golden_angle = 0.3819660112501051;

}  // namespace

Rings::Line::Line(int ring, double ring_spacing, double density)
    : count_(static_cast<int>(std::floor(std::numbers::pi * (2 * ring + 1) + 0.5))),
      radius_((ring + 0.5) * ring_spacing),
      first_turn_(ring * golden_angle) {
  const double annulus_area = std::numbers::pi * (2 * ring + 1) * (ring_spacing * ring_spacing);
  mass_ = density * annulus_area / count_;
}

Rings::Rings(double radius, double spacing, double density)
    : ring_count_(std::max(1, static_cast<int>(std::floor(radius / spacing + 0.5)))),
      radius_(radius),
      ring_spacing_(radius / ring_count_),
      density_(density) {}

template <class Contains>
LatticeColumns::LatticeColumns(Vector half_axes, double spacing, double mass, Contains&& contains)
    : half_axes_(half_axes), spacing_(spacing) {
  const int half_columns = static_cast<int>(half_axes.x / spacing) + 1;
  const int half_rows = static_cast<int>(half_axes.y / spacing) + 1;
  for (int column = -half_columns; column < half_columns; ++column) {
    // Rounding keeps order, so that of a column's rows the inner ones are in the shape and the outer ones are not.
    int inside = 0, outside = half_rows;
    while (inside < outside) {
      const int row = inside + (outside - inside) / 2;
      if (contains(Vector{(column + 0.5) * spacing, (row + 0.5) * spacing}))
        inside = row + 1;
      else
        outside = row;
    }
    half_counts_.push_back(inside);
    count_ += 2 * static_cast<std::int64_t>(inside);
  }
  mass_ = mass / static_cast<double>(count_);
}

LatticeColumns LatticeColumns::disc(double radius, double spacing, double mass) {
  return {{radius, radius}, spacing, mass, [&](Vector p) { return squared_length(p) <= radius * radius; }};
}

LatticeColumns LatticeColumns::ellipse(double half_width, double half_height, double spacing, double mass) {
  return {{half_width, half_height}, spacing, mass, [&](Vector p) {
            return squared_length(Vector{p.x / half_width, p.y / half_height}) <= 1.0;
          }};
}

bool LatticeColumns::is_near(Vector place, double distance) const {
  // A disc of that radius is within the ellipse made as much smaller, so that this is too wide rather than too narrow.
  const double growth = 1.0 + distance / std::min(half_axes_.x, half_axes_.y);
  return length(Vector{place.x / half_axes_.x, place.y / half_axes_.y}) <= growth;
}

SquareColumns::SquareColumns(double side, double spacing, double density)
    : count_(std::max(1, static_cast<int>(std::floor(side / spacing + 0.5)))),
      half_side_(0.5 * side),
      cell_(side / count_),
      mass_(density * cell_ * cell_) {}

bool SquareColumns::is_near(Vector place, double distance) const {
  return std::max(std::abs(place.x), std::abs(place.y)) <= half_side_ + distance;
}

ListedParticles::ListedParticles(std::vector<Vector> positions, std::vector<double> masses)
    : positions_(std::move(positions)), masses_(std::move(masses)) {
  for (const Vector& p : positions_) box_.include(p);
}

}  // namespace sphdrop
