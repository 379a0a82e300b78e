#include "io/rows_by_id.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "io/collective_error.hpp"

namespace sphdrop {
namespace {

constexpr int message_tag = 7301;

/// The rank whose block holds `row`.
int rank_of(std::int64_t row, std::int64_t total, int ranks) {
  const std::int64_t size = total / ranks;
  const std::int64_t in_longer_blocks = (total % ranks) * (size + 1);
  return static_cast<int>(row < in_longer_blocks ? row / (size + 1) : total % ranks + (row - in_longer_blocks) / size);
}

std::string check_owned(std::int64_t first_id, std::int64_t total, const Pieces<std::int64_t>& ids) {
  if (ids.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    return fmt::format("{} rows on one rank are more than 2^31 - 1; use more ranks", ids.size());
  }
  if (first_id < 0 || total < 0) return fmt::format("there are no {} rows from id {} on", total, first_id);
  std::string problem;
  ids.for_each([&](std::size_t, std::int64_t id) {
    if (problem.empty() && (id < first_id || id - first_id >= total))
      problem = fmt::format("the row id {} is not within {} ... {}", id, first_id, first_id + total - 1);
  });
  return problem;
}

std::int64_t quotient_rounded_up(std::int64_t number, std::int64_t divisor) {
  return (number + divisor - 1) / divisor;
}

}  // namespace

RowBlock RowBlock::of_rank(std::int64_t total, int rank, int ranks) {
  // The first total % ranks blocks are longer by one.
  const auto boundary = [&](std::int64_t r) { return r * (total / ranks) + std::min(r, total % ranks); };
  return {boundary(rank), boundary(rank + 1)};
}

RowsById::RowsById(const Communicator& communicator, std::int64_t first_id, std::int64_t total,
                   const Pieces<std::int64_t>& ids, std::int64_t part_rows)
    : communicator_(communicator), ids_(ids), first_id_(first_id), total_(total), part_rows_(part_rows) {
  throw_if_any_failed<CollectiveError>(communicator, check_owned(first_id, total, ids));
  const auto given = communicator.sum(static_cast<std::int64_t>(ids.size()));
  if (given != total) {
    throw CollectiveError(fmt::format("the ranks hold {} rows together, but {} were announced", given, total));
  }
  const int ranks = communicator.size();
  block_ = RowBlock::of_rank(total, communicator.rank(), ranks);
  const std::int64_t longest = RowBlock::of_rank(total, 0, ranks).size();
  part_rows_ = std::max(part_rows, quotient_rounded_up(longest, most_parts));
  part_count_ = static_cast<int>(std::max(std::int64_t{1}, quotient_rounded_up(longest, part_rows_)));
  // Once for all parts, as divisions take their time.
  part_of_row_.resize(ids.size());
  RowBlock at;  // most ids are of the same rank as those before
  ids.for_each([&](std::size_t row, std::int64_t id) {
    const std::int64_t place = id - first_id;
    if (place < at.first || place >= at.end) at = RowBlock::of_rank(total, rank_of(place, total, ranks), ranks);
    part_of_row_[row] = static_cast<std::uint8_t>((place - at.first) / part_rows_);
  });
  turn_to(0);
}

RowBlock RowsById::part(int which) const {
  const std::int64_t first = std::min(block_.first + which * part_rows_, block_.end);
  return {first, std::min(first + part_rows_, block_.end)};
}

void RowsById::turn_to(int which) {
  if (which == part_) return;
  part_ = which;
  std::vector<RankRows> sends(static_cast<std::size_t>(communicator_.size()));
  const auto in_part = static_cast<std::uint8_t>(which);
  ids_.for_each([&](std::size_t row, std::int64_t id) {
    if (part_of_row_[row] == in_part)
      sends[static_cast<std::size_t>(rank_of(id - first_id_, total_, communicator_.size()))].rows.push_back(
          static_cast<std::int32_t>(row));
  });
  // What is sent is copied rank by rank, and counted from there.
  rows_to_send_.clear();
  for (std::size_t rank = 0; rank < sends.size(); ++rank) {
    std::vector<std::int32_t>& rows = sends[rank].rows;
    const auto first = static_cast<std::int32_t>(rows_to_send_.size());
    rows_to_send_.insert(rows_to_send_.end(), rows.begin(), rows.end());
    std::iota(rows.begin(), rows.end(), first);
    sends[rank].rank = static_cast<int>(rank);
  }
  values_to_send_.resize(rows_to_send_.size());
  std::erase_if(sends, [](const RankRows& rows) { return rows.rows.empty(); });
  plan_ = {};  // before there is another: both together would be twice the memory
  plan_ = ExchangePlan::from_sends(communicator_, std::move(sends), 0, message_tag);

  std::vector<std::int64_t> received(plan_.received_row_count());
  ids_.copy(rows_to_send_, std::as_writable_bytes(std::span(values_to_send_)).data());
  exchange(std::as_writable_bytes(std::span(received)).data());
  std::vector<std::int32_t> row_in_part(received.size());
  throw_if_any_failed<CollectiveError>(communicator_, check_received(row_in_part, received));
  plan_.renumber_received_rows(row_in_part);
}

std::string RowsById::check_received(std::vector<std::int32_t>& row_in_part,
                                     std::span<const std::int64_t> received) const {
  // As many rows as ids exist overall: a missing id means that another comes twice, so looking for duplicates suffices.
  const RowBlock rows = part(part_);
  std::vector<bool> seen(static_cast<std::size_t>(rows.size()), false);
  for (std::size_t k = 0; k < received.size(); ++k) {
    const std::int64_t row = received[k] - first_id_ - rows.first;
    if (seen[static_cast<std::size_t>(row)]) return fmt::format("the row id {} is held twice", received[k]);
    seen[static_cast<std::size_t>(row)] = true;
    row_in_part[k] = static_cast<std::int32_t>(row);
  }
  return {};
}

void RowsById::exchange(std::byte* target) {
  plan_.start(std::array<const void*, 1>{values_to_send_.data()});
  plan_.finish(std::array<void*, 1>{target});
}

}  // namespace sphdrop
