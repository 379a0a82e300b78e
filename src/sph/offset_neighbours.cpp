#include "sph/offset_neighbours.hpp"

#include <algorithm>
#include <cassert>

#include "particles/pack.hpp"
#include "sph/cell_grid.hpp"

namespace sphdrop {

OffsetNeighbours OffsetNeighbours::build(const ParticleSet& particles, const Column<double>& x, const Column<double>& y,
                                         double reach) {
  std::vector<char> is_owned(particles.size(), 0);
  particles.for_each_owned([&](std::size_t row) { is_owned[row] = 1; });
  return build(particles, is_owned, x, y, reach);
}

OffsetNeighbours OffsetNeighbours::build(const ParticleSet& particles, const std::vector<char>& wanted,
                                         const Column<double>& x, const Column<double>& y, double reach) {
  OffsetNeighbours list;
  const std::size_t size = particles.size();
  if (size == 0) return list;
  assert(std::is_sorted(particles.id.begin(), particles.id.end()));
  const CellGrid grid({x.data(), size}, {y.data(), size}, reach);
  const double squared_reach = reach * reach;
  std::vector<char> is_owned(size, 0);
  particles.for_each_owned([&](std::size_t row) { is_owned[row] = 1; });

  std::vector<std::int32_t> near, found;
  std::vector<char> is_found(2 * size,
                             0);  // by offset + size: rows of a lattice have nearly all their offsets in common
  for (std::size_t first = 0; first < size; first += block_size) {
    Block block;
    block.first_row = static_cast<std::int32_t>(first);
    block.first_offset = static_cast<std::int32_t>(list.offsets.size());
    found.clear();
    bool any_wanted = false;
    for (std::size_t i = first; i < std::min(first + block_size, size); ++i) {
      if (!wanted[i]) continue;
      any_wanted = true;
      if (!is_owned[i]) block.needs_ghosts = true;
      const std::size_t count = grid.find_within({x[i], y[i]}, squared_reach, x.data(), y.data(), near);
      for (std::size_t k = 0; k < count; ++k) {
        const auto row = static_cast<std::size_t>(near[k]);
        if (row == i) continue;
        ++list.pairs;
        if (!is_owned[row]) block.needs_ghosts = true;
        char& known = is_found[size + row - i];
        if (known == 0) found.push_back(near[k] - static_cast<std::int32_t>(i));
        known = 1;
      }
    }
    if (!any_wanted) continue;
    for (const std::int32_t offset : found)
      is_found[static_cast<std::size_t>(static_cast<std::int64_t>(size) + offset)] = 0;
    std::sort(found.begin(), found.end());
    block.offsets = static_cast<std::int32_t>(found.size());
    list.offsets.insert(list.offsets.end(), found.begin(), found.end());
    list.blocks.push_back(block);
  }
  list.sharing = PairSharing::plan(list);
  return list;
}

}  // namespace sphdrop
