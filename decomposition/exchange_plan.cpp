#include "decomposition/exchange_plan.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <exception>
#include <limits>
#include <list>
#include <stdexcept>
#include <string>
#include <utility>

namespace sphdrop {
namespace {

constexpr std::size_t word_bytes = sizeof(std::uint64_t);

// Whether they follow one another: then a column is moved as a whole. Looked at in full, without branches.
bool are_consecutive(std::span<const std::int32_t> rows) {
  std::int32_t row = rows.empty() ? 0 : rows.front(), differing = 0;
  for (const std::int32_t r : rows) differing |= r ^ row++;
  return differing == 0;
}

// The columns hold doubles or integers: memcpy moves their words without reading one type as the other.
std::uint64_t* pack(std::span<const void* const> columns, std::span<const std::int32_t> rows, std::uint64_t* buffer) {
  if (are_consecutive(rows)) {
    for (const void* column : columns) {
      const auto* bytes = static_cast<const std::byte*>(column);
      if (!rows.empty())
        std::memcpy(buffer, bytes + static_cast<std::size_t>(rows.front()) * word_bytes, rows.size() * word_bytes);
      buffer += rows.size();
    }
    return buffer;
  }
  for (const void* column : columns) {
    const auto* bytes = static_cast<const std::byte*>(column);
    for (const std::int32_t row : rows)
      std::memcpy(buffer++, bytes + static_cast<std::size_t>(row) * word_bytes, word_bytes);
  }
  return buffer;
}

const std::uint64_t* unpack(const std::uint64_t* buffer, std::span<const std::int32_t> rows,
                            std::span<void* const> columns) {
  if (are_consecutive(rows)) {
    for (void* column : columns) {
      auto* bytes = static_cast<std::byte*>(column);
      if (!rows.empty())
        std::memcpy(bytes + static_cast<std::size_t>(rows.front()) * word_bytes, buffer, rows.size() * word_bytes);
      buffer += rows.size();
    }
    return buffer;
  }
  for (void* column : columns) {
    auto* bytes = static_cast<std::byte*>(column);
    for (const std::int32_t row : rows)
      std::memcpy(bytes + static_cast<std::size_t>(row) * word_bytes, buffer++, word_bytes);
  }
  return buffer;
}

void sort_by_rank(std::vector<RankRows>& peers) {
  std::erase_if(peers, [](const RankRows& peer) { return peer.rows.empty(); });
  std::sort(peers.begin(), peers.end(), [](const RankRows& a, const RankRows& b) { return a.rank < b.rank; });
  assert(std::adjacent_find(peers.begin(), peers.end(),
                            [](const RankRows& a, const RankRows& b) { return a.rank == b.rank; }) == peers.end());
}

std::size_t row_count(std::span<const RankRows> peers) {
  std::size_t count = 0;
  for (const RankRows& peer : peers) count += peer.rows.size();
  return count;
}

std::size_t row_count_with(std::span<const RankRows> peers, int rank) {
  for (const RankRows& peer : peers)
    if (peer.rank == rank) return peer.rows.size();
  return 0;
}

int message_length(std::size_t words) {
  if (words > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::length_error("a message of " + std::to_string(words) +
                            " words between two ranks is too long for MPI: use more ranks");
  return static_cast<int>(words);
}

void renumber(std::vector<RankRows>& peers, std::span<const std::int32_t> new_row) {
  for (RankRows& peer : peers)
    for (std::int32_t& row : peer.rows) row = new_row[static_cast<std::size_t>(row)];
}

}  // namespace

ExchangePlan::Transfer::Transfer([[maybe_unused]] const Transfer& other) {
  assert(!other.under_way);
}

ExchangePlan::Transfer::Transfer(Transfer&& other) noexcept
    : send_buffer(std::move(other.send_buffer)),
      receive_buffer(std::move(other.receive_buffer)),
      requests(std::move(other.requests)),
      columns(other.columns),
      under_way(std::exchange(other.under_way, false)) {}

ExchangePlan::Transfer& ExchangePlan::Transfer::operator=(const Transfer& other) {
  *this = Transfer(other);
  return *this;
}

ExchangePlan::Transfer& ExchangePlan::Transfer::operator=(Transfer&& other) noexcept {
  if (this == &other) return *this;
  end();
  send_buffer = std::move(other.send_buffer);
  receive_buffer = std::move(other.receive_buffer);
  requests = std::move(other.requests);
  columns = other.columns;
  under_way = std::exchange(other.under_way, false);
  return *this;
}

ExchangePlan::Transfer::~Transfer() {
  end();
}

void ExchangePlan::Transfer::end() {
  if (!std::exchange(under_way, false) || requests.empty()) return;
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized != 0) return;
  if (std::uncaught_exceptions() == 0) {
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    return;
  }
  // The other ranks may never send: waiting for them would hide the error that ends this one. MPI may still write.
  static std::list<std::vector<std::uint64_t>> abandoned;
  abandoned.push_back(std::move(send_buffer));
  abandoned.push_back(std::move(receive_buffer));
}

ExchangePlan::ExchangePlan(const Communicator& communicator, std::vector<RankRows> sends,
                           std::vector<RankRows> receives, int tag)
    : communicator_(&communicator),
      own_rank_(communicator.rank()),
      tag_(tag),
      sends_(std::move(sends)),
      receives_(std::move(receives)) {
  sort_by_rank(sends_);
  sort_by_rank(receives_);
  assert(row_count_with(sends_, own_rank_) == row_count_with(receives_, own_rank_));
  count_rows();
}

void ExchangePlan::count_rows() {
  row_count_to_send_ = row_count(sends_);
  row_count_to_receive_ = row_count(receives_);
  rows_in_messages_ = row_count_to_send_ - row_count_with(sends_, own_rank_);
  message_count_ = sends_.size() - (row_count_with(sends_, own_rank_) > 0 ? 1 : 0);
}

ExchangePlan ExchangePlan::from_sends(const Communicator& communicator, std::vector<RankRows> sends,
                                      std::int32_t first_received_row, int tag) {
  const auto ranks = static_cast<std::size_t>(communicator.size());
  std::vector<std::int32_t> send_counts(ranks, 0);
  std::vector<std::int32_t> receive_counts(ranks, 0);
  for (const RankRows& peer : sends)
    send_counts[static_cast<std::size_t>(peer.rank)] = static_cast<std::int32_t>(peer.rows.size());
  communicator.note(TrafficKind::all_to_all, ranks * sizeof(std::int32_t));
  MPI_Alltoall(send_counts.data(), 1, MPI_INT32_T, receive_counts.data(), 1, MPI_INT32_T, communicator.handle());

  std::vector<RankRows> receives;
  std::int32_t row = first_received_row;
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    if (receive_counts[rank] == 0) continue;
    RankRows& peer = receives.emplace_back();
    peer.rank = static_cast<int>(rank);
    peer.rows.resize(static_cast<std::size_t>(receive_counts[rank]));
    for (std::int32_t& received : peer.rows) received = row++;
  }
  return ExchangePlan(communicator, std::move(sends), std::move(receives), tag);
}

ExchangePlan ExchangePlan::reversed(int tag) const {
  ExchangePlan plan;
  plan.communicator_ = communicator_;
  plan.own_rank_ = own_rank_;
  plan.tag_ = tag;
  plan.sends_ = receives_;
  plan.receives_ = sends_;
  plan.count_rows();
  return plan;
}

void ExchangePlan::start(std::span<const void* const> source_columns) {
  assert(!transfer_.under_way);
  const std::size_t columns = source_columns.size();
  transfer_.columns = columns;
  transfer_.under_way = true;
  transfer_.requests.clear();
  if (columns == 0) return;
  transfer_.send_buffer.resize(row_count_to_send_ * columns);
  transfer_.receive_buffer.resize((row_count_to_receive_ - row_count_with(receives_, own_rank_)) * columns);

  std::uint64_t* arriving = transfer_.receive_buffer.data();
  for (const RankRows& peer : receives_) {
    if (peer.rank == own_rank_) continue;
    const std::size_t words = peer.rows.size() * columns;
    communicator_->note(TrafficKind::message_received, words * word_bytes);
    MPI_Irecv(arriving, message_length(words), MPI_UINT64_T, peer.rank, tag_, communicator_->handle(),
              &transfer_.requests.emplace_back());
    arriving += words;
  }
  // Own rows are packed like all others: the target columns may be the source columns.
  std::uint64_t* leaving = transfer_.send_buffer.data();
  for (const RankRows& peer : sends_) {
    std::uint64_t* end = pack(source_columns, peer.rows, leaving);
    if (peer.rank != own_rank_) {
      const auto words = static_cast<std::size_t>(end - leaving);
      communicator_->note(TrafficKind::message_sent, words * word_bytes);
      MPI_Isend(leaving, message_length(words), MPI_UINT64_T, peer.rank, tag_, communicator_->handle(),
                &transfer_.requests.emplace_back());
    }
    leaving = end;
  }
}

void ExchangePlan::finish(std::span<void* const> target_columns) {
  assert(transfer_.under_way && target_columns.size() == transfer_.columns);
  if (!transfer_.requests.empty())
    MPI_Waitall(static_cast<int>(transfer_.requests.size()), transfer_.requests.data(), MPI_STATUSES_IGNORE);
  transfer_.under_way = false;

  const std::uint64_t* own = transfer_.send_buffer.data();
  for (const RankRows& peer : sends_) {
    if (peer.rank == own_rank_) break;
    own += peer.rows.size() * transfer_.columns;
  }
  const std::uint64_t* arrived = transfer_.receive_buffer.data();
  for (const RankRows& peer : receives_) {
    if (peer.rank == own_rank_)
      unpack(own, peer.rows, target_columns);
    else
      arrived = unpack(arrived, peer.rows, target_columns);
  }
}

void ExchangePlan::renumber_received_rows(std::span<const std::int32_t> new_row) {
  assert(!transfer_.under_way);
  renumber(receives_, new_row);
}

void ExchangePlan::renumber_sent_rows(std::span<const std::int32_t> new_row) {
  assert(!transfer_.under_way);
  renumber(sends_, new_row);
}

void ExchangePlan::number_received_rows() {
  assert(!transfer_.under_way);
  std::int32_t next = 0;
  for (RankRows& peer : receives_)
    for (std::int32_t& row : peer.rows) row = next++;
}

std::span<const RankRows> ExchangePlan::sends() const {
  return sends_;
}
std::span<const RankRows> ExchangePlan::receives() const {
  return receives_;
}
std::size_t ExchangePlan::received_row_count() const {
  return row_count_to_receive_;
}
std::size_t ExchangePlan::message_count() const {
  return message_count_;
}
std::size_t ExchangePlan::sent_row_count() const {
  return rows_in_messages_;
}

}  // namespace sphdrop
