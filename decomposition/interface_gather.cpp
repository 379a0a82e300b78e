#include "decomposition/interface_gather.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <numeric>

#include "decomposition/copy_rows.hpp"
#include "decomposition/id_order.hpp"

namespace sphdrop {

int rank_with_most(const Communicator& communicator, std::int64_t held) {
  const std::array<std::int64_t, 1> mine{held};
  const std::vector<std::int64_t> all = communicator.all_gather(std::span<const std::int64_t>(mine));
  return static_cast<int>(std::max_element(all.begin(), all.end()) - all.begin());
}

namespace {

std::vector<std::int32_t> rows_with(std::span<const RankRows> peers, int rank) {
  const auto found = std::find_if(peers.begin(), peers.end(), [&](const RankRows& peer) { return peer.rank == rank; });
  return found == peers.end() ? std::vector<std::int32_t>{} : found->rows;
}

std::vector<RankRows> without(std::span<const RankRows> peers, int rank) {
  std::vector<RankRows> others;
  for (const RankRows& peer : peers)
    if (peer.rank != rank) others.push_back(peer);
  return others;
}

void copy_rows_to_places(void* to, std::span<const std::int32_t> places, const void* from,
                         std::span<const std::int32_t> rows) {
  auto* target = static_cast<std::byte*>(to);
  const auto* source = static_cast<const std::byte*>(from);
  for (std::size_t k = 0; k < rows.size(); ++k)
    std::memcpy(target + static_cast<std::size_t>(places[k]) * word_bytes,
                source + static_cast<std::size_t>(rows[k]) * word_bytes, word_bytes);
}

}  // namespace

InterfaceGather::InterfaceGather(const Communicator& communicator, std::span<const std::int64_t> ids,
                                 std::span<const std::int32_t> rows, int owner, int tag)
    : owner_(owner) {
  std::vector<RankRows> sends;
  if (!rows.empty()) sends.push_back({owner, {rows.begin(), rows.end()}});
  ExchangePlan all = ExchangePlan::from_sends(communicator, std::move(sends), 0, tag);

  // The plan stores rows in the order of the ranks they come from, as gather() does.
  ids_ = communicator.gather(ids, owner);
  const IdOrder arrived(ids_);
  std::vector<std::int32_t> sorted_place(ids_.size());
  for (std::size_t place = 0; place < ids_.size(); ++place)
    sorted_place[static_cast<std::size_t>(arrived.by_id()[place])] = static_cast<std::int32_t>(place);
  std::sort(ids_.begin(), ids_.end());
  all.renumber_received_rows(sorted_place);
  own_rows_ = rows_with(all.sends(), communicator.rank());
  own_places_ = rows_with(all.receives(), communicator.rank());
  gather_ = ExchangePlan(communicator, without(all.sends(), communicator.rank()),
                         without(all.receives(), communicator.rank()), tag);
  scatter_ = gather_.reversed(tag + 1);
  scatter_.number_received_rows();
}

void InterfaceGather::start(ExchangePlan& plan, std::span<const void* const> columns) {
  own_columns_.assign(columns.begin(), columns.end());
  plan.start(columns);
}

void InterfaceGather::finish_gather(std::span<void* const> gathered) {
  gather_.finish(gathered);
  for (std::size_t c = 0; c < gathered.size(); ++c)
    copy_rows_to_places(gathered[c], own_places_, own_columns_[c], own_rows_);
}

void InterfaceGather::finish_scatter(std::span<void* const> columns) {
  scatter_.finish(columns);
  // The owner's rows are all its own: nothing else has come.
  for (std::size_t c = 0; c < columns.size(); ++c) copy_rows(columns[c], own_columns_[c], own_places_);
}

}  // namespace sphdrop
