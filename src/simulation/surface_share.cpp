#include "simulation/surface_share.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "decomposition/id_order.hpp"
#include "surface_tension/near_particles.hpp"

namespace sphdrop {

namespace {

/// By node: the own row that it goes with, -1 if it is another rank's.
std::vector<std::int32_t> rows_of_nodes(const FluidParticles& fluid, const SurfaceCurves& curves,
                                        std::span<const std::int32_t> rows) {
  std::vector<std::int64_t> ids;
  ids.reserve(rows.size());
  for (const std::int32_t row : rows) ids.push_back(fluid.id[static_cast<std::size_t>(row)]);
  const IdOrder order(std::move(ids));
  std::vector<std::int32_t> row_of_node;
  row_of_node.reserve(curves.nodes.size());
  for (const SurfaceCurves::Node& node : curves.nodes) {
    const std::int32_t place = order.place_of(node.particle);
    row_of_node.push_back(place < 0 ? -1 : rows[static_cast<std::size_t>(place)]);
  }
  return row_of_node;
}

std::vector<char> wanted_points(const FluidParticles& fluid, const SurfaceCurves& curves,
                                std::span<const Vector> points, std::span<const std::int32_t> rows,
                                std::span<const std::int32_t> row_of_node, double action) {
  std::vector<Vector> places;
  for (const std::int32_t row : rows) places.push_back(fluid.detection_position.at(static_cast<std::size_t>(row)));
  std::vector<double> x, y;
  for (const Vector point : points) {
    x.push_back(point.x);
    y.push_back(point.y);
  }
  std::vector<char> is_wanted(points.size(), 0);
  if (!places.empty())
    for (const std::int32_t k : particles_near(places, x, y, action)) is_wanted[static_cast<std::size_t>(k)] = 1;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    for (std::size_t k = curve.first; k < curve.last; ++k)
      if (row_of_node[k] >= 0) is_wanted[curve.previous(k)] = is_wanted[k] = is_wanted[curve.next(k)] = 1;
  }
  return is_wanted;
}

/// Collects for each row the ranks it goes to.
class Sends {
 public:
  explicit Sends(std::span<const std::int32_t> rows) : rows_(rows), ranks_(rows.size()) {}

  std::vector<int>& of(std::int32_t row) {
    return ranks_[static_cast<std::size_t>(std::lower_bound(rows_.begin(), rows_.end(), row) - rows_.begin())];
  }
  std::vector<RankRows> by_rank() {
    std::map<int, RankRows> collected;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      std::vector<int>& ranks = ranks_[k];
      std::sort(ranks.begin(), ranks.end());
      ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
      for (const int rank : ranks) {
        collected[rank].rank = rank;
        collected[rank].rows.push_back(rows_[k]);
      }
    }
    std::vector<RankRows> sends;
    sends.reserve(collected.size());
    for (auto& [rank, rows] : collected) sends.push_back(std::move(rows));
    return sends;
  }

 private:
  std::span<const std::int32_t> rows_;  // ascending
  std::vector<std::vector<int>> ranks_;
};

/// A node that is wanted for its neighbours' sake: beside it on the curve is the point of a rank's own node, which acts
/// on that.
void send_nodes_along_curves(const FluidParticles& fluid, const Distribution& distribution, const SurfaceCurves& curves,
                             std::span<const Vector> points, std::span<const std::int32_t> row_of_node,
                             const SurfaceRange& range, Sends& sends) {
  constexpr int steps = steps_of_a_force + 1;
  const auto since_detection = [&](std::int32_t row) {
    const auto at = static_cast<std::size_t>(row);
    return fluid.list_position.at(at) - fluid.detection_position.at(at);
  };
  std::vector<int> ranks;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    for (std::size_t s = curve.first; s < curve.last; ++s) {
      // Own nodes about it, itself among them; whose it is, if it is not an own one, is told by how such a one has
      // moved.
      std::array<std::int32_t, 2 * steps + 1> own;
      std::size_t count = 0;
      std::size_t k = s;
      for (int step = 0; step < steps; ++step) k = curve.previous(k);
      for (int step = -steps; step <= steps; ++step, k = curve.next(k))
        if (row_of_node[k] >= 0) own[count++] = row_of_node[k];
      if (count == 0) continue;
      const std::int32_t nearest = row_of_node[s] >= 0 ? row_of_node[s] : own[count / 2];
      ranks.clear();
      distribution.other_ranks_within(points[s] + since_detection(nearest), range.action + 2.0 * range.looseness,
                                      ranks);
      if (ranks.empty()) continue;
      for (std::size_t n = 0; n < count; ++n)
        sends.of(own[n]).insert(sends.of(own[n]).end(), ranks.begin(), ranks.end());
    }
  }
}

}  // namespace

SurfaceShare share_of_surface(const Communicator& communicator, const FluidParticles& fluid,
                              const Distribution& distribution, const SurfaceCurves& curves,
                              std::span<const Vector> points, const SurfaceRange& range, int whole_at) {
  SurfaceShare share;
  const std::size_t owned = fluid.owned_count();
  share.rows = particles_near(points, {fluid.detection_position.x.data(), owned},
                              {fluid.detection_position.y.data(), owned}, range.action);
  if (communicator.size() == 1) {
    share.is_wanted.assign(curves.nodes.size(), 1);
    return share;
  }
  const std::vector<std::int32_t> row_of_node = rows_of_nodes(fluid, curves, share.rows);
  if (whole_at == communicator.rank())
    share.is_wanted.assign(curves.nodes.size(), 1);
  else
    share.is_wanted = wanted_points(fluid, curves, points, share.rows, row_of_node, range.action);

  // Who owns what is known of the places that particles had when they were distributed.
  Sends sends(share.rows);
  for (const std::int32_t row : share.rows) {
    // A particle that shares a point with it is as far from that.
    const Vector place = fluid.list_position.at(static_cast<std::size_t>(row));
    distribution.other_ranks_within(place, 2.0 * range.action + range.looseness, sends.of(row));
  }
  if (whole_at >= 0 && whole_at != communicator.rank())
    for (const std::int32_t row : row_of_node)
      if (row >= 0) sends.of(row).push_back(whole_at);
  send_nodes_along_curves(fluid, distribution, curves, points, row_of_node, range, sends);
  share.sends = sends.by_rank();
  return share;
}

}  // namespace sphdrop
