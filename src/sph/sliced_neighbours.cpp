#include "sph/sliced_neighbours.hpp"

#include <algorithm>
#include <array>

#include "particles/pack.hpp"
#include "sph/cell_grid.hpp"

namespace sphdrop {

namespace {

/// Room for `needed` entries; where it is short, for as many as the list will have if it goes on as it is, `done` of it
/// being made. Doubling would hold nearly twice the list for a moment, which is the largest thing there is.
void make_room(std::vector<std::int32_t>& entries, std::size_t needed, double done) {
  if (needed <= entries.capacity()) return;
  entries.reserve(std::max(needed, static_cast<std::size_t>(1.05 * static_cast<double>(needed) / done)));
}

}  // namespace

SlicedNeighbours SlicedNeighbours::build(const ParticleSet& particles, const Column<double>& x, const Column<double>& y,
                                         RowRange rows, double reach) {
  SlicedNeighbours list;
  if (rows.begin >= rows.end) return list;
  const std::size_t size = particles.size();
  const CellGrid grid({x.data(), size}, {y.data(), size}, reach);
  const double squared_reach = reach * reach;
  const auto padding_row = static_cast<std::int32_t>(size);

  struct Neighbour {
    std::int64_t id;
    std::int32_t row;
  };
  std::array<std::vector<Neighbour>, block_size> found;
  std::vector<std::int32_t> near;
  for (std::int32_t first = rows.begin; first < rows.end; first += block_size) {
    Slice slice;
    slice.first_row = first;
    slice.rows = std::min<std::int32_t>(block_size, rows.end - first);
    slice.first_entry = static_cast<std::int32_t>(list.neighbours.size() / block_size);
    for (std::int32_t lane = 0; lane < slice.rows; ++lane) {
      auto& mine = found[static_cast<std::size_t>(lane)];
      mine.clear();
      const auto i = static_cast<std::size_t>(first) + static_cast<std::size_t>(lane);
      const std::size_t count = grid.find_within({x[i], y[i]}, squared_reach, x.data(), y.data(), near);
      for (std::size_t k = 0; k < count; ++k)
        if (near[k] != first + lane) mine.push_back({particles.id[static_cast<std::size_t>(near[k])], near[k]});
      std::sort(mine.begin(), mine.end(), [](const Neighbour& a, const Neighbour& b) { return a.id < b.id; });
      slice.entries = std::max(slice.entries, static_cast<std::int32_t>(mine.size()));
      list.pairs += static_cast<std::int64_t>(mine.size());
    }
    make_room(list.neighbours, list.neighbours.size() + static_cast<std::size_t>(slice.entries) * block_size,
              static_cast<double>(slice.first_row + slice.rows - rows.begin) / (rows.end - rows.begin));
    list.neighbours.resize(list.neighbours.size() + static_cast<std::size_t>(slice.entries) * block_size, padding_row);
    for (std::int32_t lane = 0; lane < slice.rows; ++lane) {
      const auto& mine = found[static_cast<std::size_t>(lane)];
      for (std::size_t k = 0; k < mine.size(); ++k)
        list.neighbours[(static_cast<std::size_t>(slice.first_entry) + k) * block_size +
                        static_cast<std::size_t>(lane)] = mine[k].row;
    }
    list.slices.push_back(slice);
  }
  return list;
}

}  // namespace sphdrop
