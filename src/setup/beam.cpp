#include "setup/beam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "particles/elementary_functions.hpp"
#include "setup/setup_error.hpp"

namespace sphdrop {
namespace {

int nearest_integer(double value) {
  return static_cast<int>(std::floor(value + 0.5));
}

/// A beam half a row too thick bends a tenth too little, so nothing is rounded silently here.
int whole_number_of_spacings(double extent, double spacing, const char* what) {
  const double ratio = extent / spacing;
  const int count = nearest_integer(ratio);
  if (count >= 1 && std::abs(ratio - count) <= 1e-3) return count;
  const int suggested = std::max(1, count);
  throw SetupError(fmt::format(
      "the solid's {0} of {1:g} m is {2:.6g} particle spacings; it must be a whole number of them: for {3} choose a "
      "spacing of {4:.10g} m, or a {0} of {5:.10g} m",
      what, extent, ratio, suggested, extent / suggested, suggested * spacing));
}

/// Indices and places of a beam's particles; columns count from the left end of the left clamp, rows from the beam's
/// lowest one, so that a strip has rows below 0 or from `rows` on.
struct BeamLattice {
  int left_clamp_columns, free_columns, right_clamp_columns, rows, layers;
  double spacing;

  int columns() const { return left_clamp_columns + free_columns + right_clamp_columns; }
  int last_free_column() const { return left_clamp_columns + free_columns - 1; }
  bool is_clamped(int column) const { return column < left_clamp_columns || column > last_free_column(); }
  int lowest_row(int column) const { return is_clamped(column) ? -layers : 0; }
  int highest_row(int column) const { return is_clamped(column) ? rows + layers - 1 : rows - 1; }

  std::int64_t total() const { return first_index(columns()); }
  std::int64_t first_index(int column) const {
    const std::int64_t free_columns_before = std::clamp(column - left_clamp_columns, 0, free_columns);
    return static_cast<std::int64_t>(column) * (rows + 2 * layers) - free_columns_before * 2 * layers;
  }
  std::int32_t index(int column, int row) const {
    return static_cast<std::int32_t>(first_index(column)) + row - lowest_row(column);
  }
  Vector position(int column, int row) const {
    return {(column - left_clamp_columns + 0.5) * spacing, (row + 0.5) * spacing};
  }
  Vector position_of(std::int64_t index) const {
    int column = 0;
    for (int last = columns() - 1; column < last;) {
      const int middle = column + (last - column + 1) / 2;
      if (first_index(middle) <= index)
        column = middle;
      else
        last = middle - 1;
    }
    return position(column, static_cast<int>(index - first_index(column)) + lowest_row(column));
  }
};

bool is_held(const BeamLattice& lattice, Clamp clamp, int column, int row) {
  return row < 0 || row >= lattice.rows || (clamp == Clamp::ideal && lattice.is_clamped(column));
}

/// Clamp, free part and the other clamp.
std::vector<ColumnStretch> columns_of(const BeamLattice& lattice, Clamp clamp) {
  std::vector<ColumnStretch> stretches;
  int first = 0;
  for (const int count : {lattice.left_clamp_columns, lattice.free_columns, lattice.right_clamp_columns}) {
    if (count == 0) continue;
    ColumnStretch& stretch = stretches.emplace_back(ColumnStretch{count, lattice.lowest_row(first), {}});
    for (int row = lattice.lowest_row(first); row <= lattice.highest_row(first); ++row)
      stretch.is_held.push_back(is_held(lattice, clamp, first, row) ? 1 : 0);
    first += count;
  }
  return stretches;
}

void append_particles(const BeamLattice& lattice, double mass, Clamp clamp, IdRange wanted, InitialSolid& solid) {
  const auto count = static_cast<std::size_t>(wanted.count());
  solid.positions.reserve(count);
  solid.is_fixed.reserve(count);
  for (int column = 0; column < lattice.columns(); ++column) {
    const std::int64_t first = lattice.first_index(column);
    const IdRange mine = IdRange{first, lattice.first_index(column + 1)}.common_with(wanted);
    for (std::int64_t k = mine.first; k < mine.last; ++k) {
      const int row = static_cast<int>(k - first) + lattice.lowest_row(column);
      solid.positions.push_back(lattice.position(column, row));
      solid.is_fixed.push_back(is_held(lattice, clamp, column, row) ? 1 : 0);
    }
  }
  solid.velocities.resize(count);
  solid.masses.assign(count, mass);
  solid.mobile_count = static_cast<std::size_t>(lattice.rows) *
                       static_cast<std::size_t>(clamp == Clamp::ideal ? lattice.free_columns : lattice.columns());
  solid.before = wanted.first;
  solid.after = lattice.total() - wanted.last;
  for (const int column : {0, lattice.left_clamp_columns, lattice.columns() - 1})
    for (const int row : {lattice.lowest_row(column), lattice.highest_row(column)})
      solid.bounds.include(lattice.position(column, row));
}

/// The upper boundary from left to right: the highest row of each column, and down and up the strips' faces between.
std::vector<std::int32_t> upper_boundary(const BeamLattice& lattice) {
  std::vector<std::int32_t> line;
  const int top_row = lattice.rows - 1;
  for (int column = 0; column < lattice.columns(); ++column) {
    const bool ends_left_strip = column == lattice.left_clamp_columns - 1;
    const bool begins_right_strip = column == lattice.last_free_column() + 1;
    if (begins_right_strip)
      for (int row = top_row; row < lattice.highest_row(column); ++row) line.push_back(lattice.index(column, row));
    line.push_back(lattice.index(column, lattice.highest_row(column)));
    if (ends_left_strip)
      for (int row = lattice.highest_row(column) - 1; row >= top_row; --row) line.push_back(lattice.index(column, row));
  }
  return line;
}

/// The lower boundary from right to left.
std::vector<std::int32_t> lower_boundary(const BeamLattice& lattice) {
  std::vector<std::int32_t> line;
  for (int column = lattice.columns() - 1; column >= 0; --column) {
    const bool ends_right_strip = column == lattice.last_free_column() + 1;
    const bool begins_left_strip = column == lattice.left_clamp_columns - 1;
    if (begins_left_strip)
      for (int row = 0; row > lattice.lowest_row(column); --row) line.push_back(lattice.index(column, row));
    line.push_back(lattice.index(column, lattice.lowest_row(column)));
    if (ends_right_strip)
      for (int row = lattice.lowest_row(column) + 1; row <= 0; ++row) line.push_back(lattice.index(column, row));
  }
  return line;
}

/// Both sides and, between them, down the free end.
std::vector<std::int32_t> cantilever_boundary(const BeamLattice& lattice) {
  std::vector<std::int32_t> line = upper_boundary(lattice);
  const int tip = lattice.last_free_column();
  for (int row = lattice.rows - 2; row >= 1; --row) line.push_back(lattice.index(tip, row));
  const std::vector<std::int32_t> underside = lower_boundary(lattice);
  line.insert(line.end(), underside.begin(), underside.end());
  return line;
}

std::vector<std::int32_t> columns_of_rows(const BeamLattice& lattice, int first_column, int last_column) {
  std::vector<std::int32_t> particles;
  for (int column = first_column; column <= last_column; ++column)
    for (int row = 0; row < lattice.rows; ++row) particles.push_back(lattice.index(column, row));
  return particles;
}

void set_bending_velocity(const BeamLattice& lattice, double tip_velocity, InitialSolid& solid) {
  for (int column = lattice.left_clamp_columns; column <= lattice.last_free_column(); ++column) {
    const IdRange mine =
        IdRange{lattice.index(column, 0), lattice.index(column, 0) + lattice.rows}.common_with(solid.indices());
    if (mine.count() == 0) continue;
    const double fraction = (column - lattice.left_clamp_columns + 0.5) / lattice.free_columns;
    const double velocity = tip_velocity * first_cantilever_mode(fraction);
    for (std::int64_t k = mine.first; k < mine.last; ++k)
      solid.velocities[static_cast<std::size_t>(k - solid.before)] = {0.0, velocity};
  }
}

/// Of the polylines' particles.
std::vector<std::vector<Vector>> places_of(const std::vector<std::vector<std::int32_t>>& polylines,
                                           const BeamLattice& lattice) {
  std::vector<std::vector<Vector>> places;
  for (const auto& polyline : polylines) {
    std::vector<Vector>& along = places.emplace_back();
    for (const std::int32_t k : polyline) along.push_back(lattice.position_of(k));
  }
  return places;
}

}  // namespace

double first_cantilever_mode(double fraction) {
  constexpr double b = 1.8751040687119611;  // the first root of cosh b cos b = -1
  const auto shape = [](double z, double s) {
    const SineCosine circular = sine_cosine(z);
    return hyperbolic_cosine(z) - circular.cosine - s * (hyperbolic_sine(z) - circular.sine);
  };
  const SineCosine end = sine_cosine(b);
  const double s = (hyperbolic_cosine(b) + end.cosine) / (hyperbolic_sine(b) + end.sine);
  return shape(b * fraction, s) / shape(b, s);
}

InitialSolid build_beam(const Case::Solid& solid, double spacing, Share share) {
  const bool is_cantilever = solid.kind == SolidKind::cantilever;
  if (!is_cantilever && solid.initial_tip_velocity != 0.0)
    throw SetupError("an initial tip velocity needs a cantilever: set it to 0 for a beam that is fixed at both ends");
  const int clamp_columns = nearest_integer(solid.clamp_length / spacing);
  if (clamp_columns < 1 || solid.clamp_layers < 1)
    throw SetupError(fmt::format(
        "nothing would hold the beam: its clamp has {} columns of {} fixed rows; make the clamp at least one spacing "
        "({:g} m) long, better 0.25 mm, and 3 layers thick",
        std::max(0, clamp_columns), solid.clamp_layers, spacing));
  const BeamLattice lattice{clamp_columns,
                            whole_number_of_spacings(solid.length, spacing, "length"),
                            is_cantilever ? 0 : clamp_columns,
                            whole_number_of_spacings(solid.thickness, spacing, "thickness"),
                            solid.clamp == Clamp::ideal ? 0 : static_cast<int>(solid.clamp_layers),
                            spacing};
  if (lattice.rows < 2)
    throw SetupError(
        fmt::format("a beam needs at least 2 rows of particles across its thickness of {:g} m, 4 or more to "
                    "bend well: choose a spacing of {:.10g} m or less",
                    solid.thickness, solid.thickness / 4));

  InitialSolid initial;
  append_particles(lattice, solid.density * spacing * spacing, solid.clamp, share.of(lattice.total()), initial);
  initial.columns = columns_of(lattice, solid.clamp);
  initial.top = lattice.rows * spacing;
  initial.middle_probe = columns_of_rows(lattice, lattice.left_clamp_columns + (lattice.free_columns - 1) / 2,
                                         lattice.left_clamp_columns + lattice.free_columns / 2);
  if (is_cantilever) {
    initial.contact_polylines = {cantilever_boundary(lattice)};
    initial.deflection_probe = columns_of_rows(lattice, lattice.last_free_column(), lattice.last_free_column());
    if (solid.initial_tip_velocity != 0.0) set_bending_velocity(lattice, solid.initial_tip_velocity, initial);
  } else {
    initial.contact_polylines = {upper_boundary(lattice), lower_boundary(lattice)};
    initial.deflection_probe = initial.middle_probe;
  }
  initial.polyline_places = places_of(initial.contact_polylines, lattice);
  return initial;
}

InitialSolid build_rigid_wall(const Case::Solid& solid, double spacing) {
  if (solid.initial_tip_velocity != 0.0)
    throw SetupError("an initial tip velocity needs a cantilever: set it to 0 for a rigid wall");
  const int count = nearest_integer(solid.length / spacing);
  if (count < 2)
    throw SetupError(
        fmt::format("the wall's width of {:g} m is less than two particle spacings of {:g} m", solid.length, spacing));
  InitialSolid wall;
  wall.contact_polylines.emplace_back();
  for (int k = 0; k < count; ++k) {
    wall.positions.push_back({(k + 0.5 - 0.5 * count) * spacing, -0.5 * spacing});
    wall.velocities.push_back({});
    wall.masses.push_back(solid.density * spacing * spacing);
    wall.is_fixed.push_back(1);
    wall.contact_polylines.front().push_back(k);
  }
  return wall;
}

}  // namespace sphdrop
