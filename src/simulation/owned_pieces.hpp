#pragma once
// Columns of a set of particles as files take them.

#include <cstddef>
#include <cstdint>

#include "io/pieces.hpp"
#include "particles/particle_set.hpp"

namespace sphdrop {

/// Appends the owned rows of a column of `particles`, ascending, where they lie: to be used before the particles move.
template <class T>
void add_owned(Pieces<T>& pieces, const ParticleSet& particles, const Column<T>& column) {
  for (const RowRange& range : particles.owned)
    pieces.add({column.data() + range.begin, static_cast<std::size_t>(range.end - range.begin)});
}
/// The same of a quantity's component: zeros where it is left out.
inline void add_owned(Pieces<double>& pieces, const ParticleSet& particles, const Field& field, int component) {
  if (field.is_left_out())
    pieces.add_constant(0.0, particles.owned_count());
  else
    add_owned(pieces, particles, field.columns[static_cast<std::size_t>(component)]);
}

}  // namespace sphdrop
