#pragma once
// Rows in the order of their global ids, in equal blocks over the ranks, whoever owned them.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "decomposition/communicator.hpp"
#include "decomposition/exchange_plan.hpp"

namespace sphdrop {

/// The rows of one rank when `total` of them are dealt out in contiguous blocks of (nearly) equal size.
struct RowBlock {
  std::int64_t first = 0;
  std::int64_t end = 0;
  std::int64_t size() const { return end - first; }
  static RowBlock of_rank(std::int64_t total, int rank, int ranks);
};

/// Moves columns from the ranks that own the rows to the ranks whose block they belong to.
class RowsById {
 public:
  /// Collective. `ids`: of the rows this rank owns, in any order; over all ranks they must be first_id ... first_id +
  /// total - 1, once each. Throws CollectiveError on all ranks if they are not.
  RowsById(const Communicator& communicator, std::int64_t first_id, std::int64_t total,
           std::span<const std::int64_t> ids);

  /// Of this rank; row k is that of the id first_id + k.
  const RowBlock& block() const { return block_; }

  /// Collective. Columns of 8-byte elements; sources hold one for each id given to the constructor, in that order,
  /// targets one for each row of block().
  void redistribute(std::span<const void* const> sources, std::span<void* const> targets);

 private:
  /// What is wrong with this rank's share of the ids; empty if nothing is.
  std::string check_received(std::vector<std::int32_t>& row_in_block, const std::vector<std::int64_t>& received) const;

  std::int64_t first_id_;
  RowBlock block_;
  ExchangePlan plan_;
};

}  // namespace sphdrop
