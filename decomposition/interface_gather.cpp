#include "decomposition/interface_gather.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <numeric>

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

// Columns hold doubles or integers: memcpy moves their words without reading one type as the other.
constexpr std::size_t word_bytes = 8;

void copy_rows(void* to, const void* from, std::span<const std::int32_t> rows) {
  auto* target = static_cast<std::byte*>(to);
  const auto* source = static_cast<const std::byte*>(from);
  for (const std::int32_t row : rows) {
    std::memcpy(target, source + static_cast<std::size_t>(row) * word_bytes, word_bytes);
    target += word_bytes;
  }
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
                                 std::span<const std::int32_t> rows, int owner, int tag, GatheredOrder order)
    : owner_(owner) {
  std::vector<RankRows> sends;
  if (!rows.empty()) sends.push_back({owner, {rows.begin(), rows.end()}});
  ExchangePlan all = ExchangePlan::from_sends(communicator, std::move(sends), 0, tag);

  // The plan stores rows in the order of the ranks they come from, as gather() does.
  ids_ = communicator.gather(ids, owner);
  struct Arrived {
    std::int64_t id;
    std::int32_t place;
  };
  std::vector<Arrived> arrived;
  arrived.reserve(ids_.size());
  for (const std::int64_t id : ids_) arrived.push_back({id, static_cast<std::int32_t>(arrived.size())});
  std::sort(arrived.begin(), arrived.end(), [](const Arrived& a, const Arrived& b) { return a.id < b.id; });
  by_id_.resize(arrived.size());
  std::transform(arrived.begin(), arrived.end(), by_id_.begin(), [](const Arrived& a) { return a.place; });
  if (order == GatheredOrder::by_id) {
    std::vector<std::int32_t> sorted_place(arrived.size());
    for (std::size_t place = 0; place < arrived.size(); ++place) {
      sorted_place[static_cast<std::size_t>(arrived[place].place)] = static_cast<std::int32_t>(place);
      ids_[place] = arrived[place].id;
    }
    std::iota(by_id_.begin(), by_id_.end(), 0);
    all.renumber_received_rows(sorted_place);
  }
  own_rows_ = rows_with(all.sends(), communicator.rank());
  own_places_ = rows_with(all.receives(), communicator.rank());
  own_places_are_consecutive_ =
      std::adjacent_find(own_places_.begin(), own_places_.end(),
                         [](std::int32_t place, std::int32_t next) { return next != place + 1; }) == own_places_.end();
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
  if (own_rows_.empty()) return;
  const std::size_t first = static_cast<std::size_t>(own_places_.front()) * word_bytes;
  for (std::size_t c = 0; c < gathered.size(); ++c) {
    if (own_places_are_consecutive_)
      copy_rows(static_cast<std::byte*>(gathered[c]) + first, own_columns_[c], own_rows_);
    else
      copy_rows_to_places(gathered[c], own_places_, own_columns_[c], own_rows_);
  }
}

void InterfaceGather::finish_scatter(std::span<void* const> columns) {
  scatter_.finish(columns);
  if (own_places_.empty()) return;
  const std::size_t first = static_cast<std::size_t>(own_places_.front()) * word_bytes;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (own_places_are_consecutive_)
      std::memcpy(columns[c], static_cast<const std::byte*>(own_columns_[c]) + first, own_places_.size() * word_bytes);
    else
      copy_rows(columns[c], own_columns_[c], own_places_);
  }
}

std::int32_t InterfaceGather::index_of(std::int64_t id) const {
  const auto id_at = [&](std::int32_t place) { return ids_[static_cast<std::size_t>(place)]; };
  const auto found = std::lower_bound(by_id_.begin(), by_id_.end(), id,
                                      [&](std::int32_t place, std::int64_t wanted) { return id_at(place) < wanted; });
  return found != by_id_.end() && id_at(*found) == id ? *found : -1;
}

}  // namespace sphdrop
