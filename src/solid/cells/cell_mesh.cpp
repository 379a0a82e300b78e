#include "solid/cells/cell_mesh.hpp"

#include <algorithm>
#include <cassert>

namespace sphdrop {

namespace {

// A shorter run without ghosts is not worth its own loop: it waits with its neighbours for the halo.
constexpr std::int32_t shortest_inner_run = 64;

}  // namespace

CellMesh::CellMesh(const ParticleSet& particles, const LatticeCells& lattice, std::int64_t first_id) {
  const auto size = static_cast<std::int32_t>(particles.size());
  for (Column<double>& column : shape_) column.resize(particles.size());
  assert(std::is_sorted(particles.id.begin(), particles.id.end()));
  std::vector<char> is_owned(particles.size(), 0);
  particles.for_each_owned([&](std::size_t row) { is_owned[row] = 1; });
  const auto owned = [&](std::int32_t row) { return is_owned[static_cast<std::size_t>(row)] != 0; };
  const auto id = [&](std::int32_t row) { return particles.id[static_cast<std::size_t>(row)]; };
  const auto row_of = [&](std::int32_t lattice_index) -> std::int32_t {
    if (lattice_index < 0) return -1;
    const std::int64_t wanted = first_id + lattice_index;
    const auto found = std::lower_bound(particles.id.begin(), particles.id.end(), wanted);
    return found != particles.id.end() && *found == wanted ? static_cast<std::int32_t>(found - particles.id.begin())
                                                           : -1;
  };
  const auto is_followed = [&](std::int32_t row) { return row + 1 < size && id(row + 1) == id(row) + 1; };

  const auto is_of_lattice = [&](std::int32_t row) {
    return id(row) >= first_id && id(row) < first_id + static_cast<std::int64_t>(lattice.particle_count());
  };
  for (std::int32_t row = 0; row < size; ++row) {
    const auto k = static_cast<std::int32_t>(id(row) - first_id);
    if (!is_of_lattice(row)) continue;
    const CellShape<double>* shape = lattice.shape(k);
    if (shape == nullptr || !is_followed(row)) continue;
    const std::int32_t east = row_of(lattice.east_of(k));
    if (east < 0 || !is_followed(east)) continue;
    const int mine = owned(row) + owned(row + 1) + owned(east) + owned(east + 1);
    if (mine == 0) continue;
    const std::array<double, 7> numbers{shape->area,     shape->centroid_x,      shape->centroid_y,     shape->moment_x,
                                        shape->moment_y, shape->inverse_width_x, shape->inverse_width_y};
    for (std::size_t c = 0; c < numbers.size(); ++c) shape_[c][static_cast<std::size_t>(row)] = numbers[c];
    const bool needs_ghosts = mine < 4;
    if (!cell_runs_.empty() && cell_runs_.back().east == east - row && cell_runs_.back().needs_ghosts == needs_ghosts)
      cell_runs_.back().end = row + 1;
    else
      cell_runs_.push_back({row, row + 1, east - row, needs_ghosts});
  }
  // Short inner runs join those that wait, and runs that now are alike join each other.
  std::vector<CellRun> joined;
  for (CellRun run : cell_runs_) {
    const bool is_cut = cell_runs_.size() > 1;
    if (is_cut && run.end - run.begin < shortest_inner_run) run.needs_ghosts = true;
    if (!joined.empty() && joined.back().east == run.east && joined.back().needs_ghosts == run.needs_ghosts)
      joined.back().end = run.end;
    else
      joined.push_back(run);
  }
  cell_runs_ = std::move(joined);

  particles.for_each_owned([&](std::size_t r) {
    const auto row = static_cast<std::int32_t>(r);
    if (!is_of_lattice(row)) return;
    const std::int32_t west_row = row_of(lattice.west_of(static_cast<std::int32_t>(id(row) - first_id)));
    const std::int32_t west = west_row < 0 ? 0 : row - west_row;
    if (!particle_runs_.empty() && particle_runs_.back().end == row && particle_runs_.back().west == west)
      particle_runs_.back().end = row + 1;
    else
      particle_runs_.push_back({row, row + 1, west});
  });
}

CellShape<double> CellMesh::shape(std::int32_t row) const {
  const auto r = static_cast<std::size_t>(row);
  return {shape_[0][r], shape_[1][r], shape_[2][r], shape_[3][r], shape_[4][r], shape_[5][r], shape_[6][r]};
}

}  // namespace sphdrop
