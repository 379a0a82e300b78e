#include "decomposition/interface_gather.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace sphdrop {

int rank_with_most(const Communicator& communicator, std::int64_t held) {
  const std::array<std::int64_t, 1> mine{held};
  const std::vector<std::int64_t> all = communicator.all_gather(std::span<const std::int64_t>(mine));
  return static_cast<int>(std::max_element(all.begin(), all.end()) - all.begin());
}

InterfaceGather::InterfaceGather(const Communicator& communicator, std::span<const std::int64_t> ids,
                                 std::span<const std::int32_t> rows, int owner, int tag)
    : owner_(owner) {
  std::vector<RankRows> sends;
  if (!rows.empty()) sends.push_back({owner, {rows.begin(), rows.end()}});
  gather_ = ExchangePlan::from_sends(communicator, std::move(sends), 0, tag);

  // The plan stores rows in the order of the ranks they come from, as gather() does.
  const std::vector<std::int64_t> arrived = communicator.gather(ids, owner);
  std::vector<std::int32_t> order(arrived.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return arrived[static_cast<std::size_t>(a)] < arrived[static_cast<std::size_t>(b)];
  });
  std::vector<std::int32_t> sorted_place(order.size());
  ids_.resize(order.size());
  for (std::size_t place = 0; place < order.size(); ++place) {
    sorted_place[static_cast<std::size_t>(order[place])] = static_cast<std::int32_t>(place);
    ids_[place] = arrived[static_cast<std::size_t>(order[place])];
  }
  gather_.renumber_received_rows(sorted_place);
  scatter_ = gather_.reversed(tag + 1);
  scatter_.number_received_rows();
}

std::int32_t InterfaceGather::index_of(std::int64_t id) const {
  const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
  return found != ids_.end() && *found == id ? static_cast<std::int32_t>(found - ids_.begin()) : -1;
}

}  // namespace sphdrop
