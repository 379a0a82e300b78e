#pragma once
// What all sets of particles have in common: ids, rows, and the list of their declared quantities.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "particles/column.hpp"
#include "particles/vector.hpp"

namespace sphdrop {

/// Where a quantity goes; a quantity may have several roles.
enum class Role : unsigned {
  derived = 0,   ///< recomputed from others in every step
  state = 1,     ///< what the next step starts from: travels with the particle, stands in checkpoints
  ghosted = 2,   ///< sent to ghosts in every step
  constant = 4,  ///< never changes: sent to ghosts once, when they are made
  written = 8,   ///< in snapshots
};
constexpr Role operator|(Role a, Role b) {
  return static_cast<Role>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr bool has(Role roles, Role role) {
  return (static_cast<unsigned>(roles) & static_cast<unsigned>(role)) != 0;
}

class ParticleSet;

/// A declared particle quantity of 1 (scalar), 2 (vector) or 3 (symmetric tensor: xx, yy, xy) columns.
class Field {
 public:
  /// Registers itself with `set`, so that declaring a quantity is all it takes to migrate, ghost, store and write it.
  Field(ParticleSet& set, std::string_view name, std::string_view unit, int components, Role roles,
        std::string_view description, double padding_value = 0.0);
  Field(const Field&) = delete;
  Field& operator=(const Field&) = delete;

  /// Gives up the rows: for a quantity that the case at hand has no use for. One that is state is 0 in files.
  void leave_out() {
    is_left_out_ = true;
    for (Column<double>& column : columns) column.resize(0);
  }
  bool is_left_out() const { return is_left_out_; }

  std::string_view name, unit;
  int components;
  Role roles;
  std::string_view description;
  std::array<Column<double>, 3> columns;

 private:
  bool is_left_out_ = false;
};

struct ScalarField : Field {
  ScalarField(ParticleSet& set, std::string_view n, std::string_view u, Role r, std::string_view d,
              double padding = 0.0)
      : Field(set, n, u, 1, r, d, padding) {}
  double* data() { return columns[0].data(); }
  const double* data() const { return columns[0].data(); }
  double& operator[](std::size_t row) { return columns[0][row]; }
  double operator[](std::size_t row) const { return columns[0][row]; }
};

struct VectorField : Field {
  VectorField(ParticleSet& set, std::string_view n, std::string_view u, Role r, std::string_view d,
              double padding = 0.0)
      : Field(set, n, u, 2, r, d, padding) {}
  Column<double>& x = columns[0];
  Column<double>& y = columns[1];
  Vector at(std::size_t row) const { return {columns[0][row], columns[1][row]}; }
  void set(std::size_t row, Vector v) {
    columns[0][row] = v.x;
    columns[1][row] = v.y;
  }
  /// All rows of a field of the same set.
  void take(const VectorField& other) {
    for (std::size_t c = 0; c < 2; ++c) std::copy(other.columns[c].begin(), other.columns[c].end(), columns[c].begin());
  }
};

struct TensorField : Field {
  TensorField(ParticleSet& set, std::string_view n, std::string_view u, Role r, std::string_view d)
      : Field(set, n, u, 3, r, d) {}
  Column<double>& xx = columns[0];
  Column<double>& yy = columns[1];
  Column<double>& xy = columns[2];
};

/// Consecutive rows [begin, end).
struct RowRange {
  std::int32_t begin = 0, end = 0;
};

/// Calls f(rows) for runs of at most 128 rows, one after the other: what works on a few columns of a run at a time then
/// finds them in the cache, however many particles there are. All runs but a range's last are whole packs.
template <class F>
void for_each_run(std::span<const RowRange> rows, F&& f) {
  constexpr std::int32_t most_rows = 128;  // 30 columns of so many fit the first cache
  for (const RowRange& range : rows)
    for (std::int32_t begin = range.begin; begin < range.end; begin += most_rows) {
      const RowRange run{begin, std::min(begin + most_rows, range.end)};
      f(std::span<const RowRange>(&run, 1));
    }
}

/// Where a row that must never interact sits: so far away that kernels vanish, near enough that squares stay finite.
inline constexpr double far_away = 1e6;

/// Particles of one material on one rank: structure of arrays; rows hold owned particles and ghosts.
class ParticleSet {
 public:
  ParticleSet() = default;
  ParticleSet(const ParticleSet&) = delete;
  ParticleSet& operator=(const ParticleSet&) = delete;

  Column<std::int64_t> id;       ///< global, unique over all materials, 0, 1, 2, ...
  std::vector<RowRange> owned;   ///< ascending, disjoint
  std::vector<RowRange> ghosts;  ///< the other rows

  std::size_t size() const { return id.size(); }
  std::size_t owned_count() const {
    std::size_t count = 0;
    for (const RowRange& range : owned) count += static_cast<std::size_t>(range.end - range.begin);
    return count;
  }
  std::span<Field* const> fields() const { return fields_; }

  /// Sets the number of rows of every column that is not left out; new rows hold zeros.
  void resize(std::size_t rows) {
    id.resize(rows);
    for (Field* field : fields_)
      for (int c = 0; c < field->components && !field->is_left_out(); ++c)
        field->columns[static_cast<std::size_t>(c)].resize(rows);
  }

  /// The columns of all fields that have one of the roles and are not left out, in the order of declaration.
  std::vector<Column<double>*> columns_with(Role role) const {
    std::vector<Column<double>*> found;
    for (Field* field : fields_)
      if (has(field->roles, role) && !field->is_left_out())
        for (int c = 0; c < field->components; ++c) found.push_back(&field->columns[static_cast<std::size_t>(c)]);
    return found;
  }

  /// Calls f(row) for every owned row in ascending order.
  template <class F>
  void for_each_owned(F&& f) const {
    for (const RowRange& range : owned)
      for (std::int32_t row = range.begin; row < range.end; ++row) f(static_cast<std::size_t>(row));
  }

 private:
  friend class Field;
  std::vector<Field*> fields_;
};

inline Field::Field(ParticleSet& set, std::string_view n, std::string_view u, int c, Role r, std::string_view d,
                    double padding_value)
    : name(n),
      unit(u),
      components(c),
      roles(r),
      description(d),
      columns{Column<double>(padding_value), Column<double>(padding_value), Column<double>(padding_value)} {
  set.fields_.push_back(this);
}

}  // namespace sphdrop
