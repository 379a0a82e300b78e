#include "setup/droplet.hpp"

#include <cmath>
#include <numbers>

#include "particles/elementary_functions.hpp"

namespace sphdrop {
namespace {

// A drop smaller than a cell is one particle.
Drop lattice_drop(LatticeColumns columns, double mass) {
  if (columns.count() == 0) return Drop(ListedParticles({Vector{}}, {mass}));
  return Drop(std::move(columns));
}

}  // namespace

Drop::Drop(Arrangement arrangement) : arrangement_(std::move(arrangement)), line_begins_{0} {
  std::visit(
      [&](const auto& lines) {
        double farthest = 0;
        for (std::size_t l = 0; l < lines.line_count(); ++l) {
          const auto line = lines.line(l);
          line_begins_.push_back(line_begins_.back() + line.count());
          if (line.count() == 0) continue;
          const Box box = line.box();
          farthest = std::max({farthest, std::abs(box.low.x), std::abs(box.low.y), box.high.x, box.high.y});
        }
        rounding_ = 1e-12 * farthest;
      },
      arrangement_);
}

void Drop::jitter(double amplitude, std::int64_t seed) {
  jitter_amplitude_ = amplitude;
  seed_ = static_cast<std::uint64_t>(seed);
}

Box Drop::bounds() const {
  Box bounds;
  std::visit(
      [&](const auto& lines) {
        // From the end: of rings the outermost come first, and the others cannot add to them.
        for (std::size_t l = lines.line_count(); l-- > 0;) {
          const IdRange line{line_begins_[l], line_begins_[l + 1]};
          if (line.count() == 0 || bounds.contains(lines.line(l).box().grown_by(jitter_bound()))) continue;
          for_each(line, [&](std::int64_t, Vector position, double) { bounds.include(position); });
        }
      },
      arrangement_);
  return bounds;
}

bool Drop::is_near(Vector place, double distance) const {
  // Both coordinates may be off by the bound.
  const double reach = distance + 1.5 * jitter_bound();
  return std::visit([&](const auto& lines) { return lines.is_near(place, reach); }, arrangement_);
}

DropParticles Drop::all() const {
  DropParticles all;
  all.positions.reserve(static_cast<std::size_t>(count()));
  all.masses.reserve(static_cast<std::size_t>(count()));
  for_each([&](std::int64_t, Vector position, double mass) {
    all.positions.push_back(position);
    all.masses.push_back(mass);
  });
  return all;
}

Drop round_drop_of_rings(double radius, double spacing, double density) {
  return Drop(Rings(radius, spacing, density));
}

Drop round_drop_of_lattice(double radius, double spacing, double density) {
  const double mass = density * std::numbers::pi * radius * radius;
  return lattice_drop(LatticeColumns::disc(radius, spacing, mass), mass);
}

Drop elliptic_drop(double half_width, double half_height, double spacing, double density) {
  const double mass = density * std::numbers::pi * half_width * half_height;
  return lattice_drop(LatticeColumns::ellipse(half_width, half_height, spacing, mass), mass);
}

Drop square_drop(double side, double spacing, double density) {
  return Drop(SquareColumns(side, spacing, density));
}

Vector oscillation_velocity(Vector from_centre, double amplitude, double decay_radius) {
  const double r = length(from_centre);
  if (r == 0.0) return {};  // the field's limit: it grows like x/r0
  const double x = from_centre.x;
  const double y = from_centre.y;
  const double r0 = decay_radius;
  const double factor = amplitude / r0 * exponential(-r / r0);
  return {factor * x * (1.0 - y * y / (r0 * r)), -factor * y * (1.0 - x * x / (r0 * r))};
}

}  // namespace sphdrop
