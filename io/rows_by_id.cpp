#include "io/rows_by_id.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

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

std::string check_owned(std::int64_t first_id, std::int64_t total, std::span<const std::int64_t> ids) {
  if (ids.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    return fmt::format("{} rows on one rank are more than 2^31 - 1; use more ranks", ids.size());
  }
  if (first_id < 0 || total < 0) return fmt::format("there are no {} rows from id {} on", total, first_id);
  for (const std::int64_t id : ids) {
    if (id < first_id || id - first_id >= total) {
      return fmt::format("the row id {} is not within {} ... {}", id, first_id, first_id + total - 1);
    }
  }
  return {};
}

}  // namespace

RowBlock RowBlock::of_rank(std::int64_t total, int rank, int ranks) {
  // The first total % ranks blocks are longer by one.
  const auto boundary = [&](std::int64_t r) { return r * (total / ranks) + std::min(r, total % ranks); };
  return {boundary(rank), boundary(rank + 1)};
}

RowsById::RowsById(const Communicator& communicator, std::int64_t first_id, std::int64_t total,
                   std::span<const std::int64_t> ids)
    : first_id_(first_id), block_(RowBlock::of_rank(total, communicator.rank(), communicator.size())) {
  throw_if_any_failed<CollectiveError>(communicator, check_owned(first_id, total, ids));
  const std::int64_t given = communicator.sum(std::int64_t{std::ssize(ids)});
  if (given != total) {
    throw CollectiveError(fmt::format("the ranks hold {} rows together, but {} were announced", given, total));
  }

  std::vector<RankRows> sends(static_cast<std::size_t>(communicator.size()));
  for (std::size_t row = 0; row < ids.size(); ++row) {
    sends[static_cast<std::size_t>(rank_of(ids[row] - first_id, total, communicator.size()))].rows.push_back(
        static_cast<std::int32_t>(row));
  }
  for (std::size_t rank = 0; rank < sends.size(); ++rank) sends[rank].rank = static_cast<int>(rank);
  std::erase_if(sends, [](const RankRows& rows) { return rows.rows.empty(); });
  plan_ = ExchangePlan::from_sends(communicator, std::move(sends), 0, message_tag);

  std::vector<std::int64_t> received(plan_.received_row_count());
  const std::array<const void*, 1> source = {ids.data()};
  const std::array<void*, 1> target = {received.data()};
  plan_.start(source);
  plan_.finish(target);
  std::vector<std::int32_t> row_in_block(received.size());
  throw_if_any_failed<CollectiveError>(communicator, check_received(row_in_block, received));
  plan_.renumber_received_rows(row_in_block);
}

std::string RowsById::check_received(std::vector<std::int32_t>& row_in_block,
                                     const std::vector<std::int64_t>& received) const {
  // As many rows as ids exist overall: a missing id means that another comes twice, so looking for duplicates suffices.
  std::vector<bool> seen(static_cast<std::size_t>(block_.size()), false);
  for (std::size_t k = 0; k < received.size(); ++k) {
    const std::int64_t row = received[k] - first_id_ - block_.first;
    if (seen[static_cast<std::size_t>(row)]) return fmt::format("the row id {} is held twice", received[k]);
    seen[static_cast<std::size_t>(row)] = true;
    row_in_block[k] = static_cast<std::int32_t>(row);
  }
  return {};
}

void RowsById::redistribute(std::span<const void* const> sources, std::span<void* const> targets) {
  plan_.start(sources);
  plan_.finish(targets);
}

}  // namespace sphdrop
