#pragma once
// Rows in the order of their global ids, in equal blocks over the ranks, whoever owned them.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "decomposition/communicator.hpp"
#include "decomposition/exchange_plan.hpp"
#include "io/pieces.hpp"

namespace sphdrop {

/// The rows of one rank when `total` of them are dealt out in contiguous blocks of (nearly) equal size.
struct RowBlock {
  std::int64_t first = 0;
  std::int64_t end = 0;
  std::int64_t size() const { return end - first; }
  static RowBlock of_rank(std::int64_t total, int rank, int ranks);
};

/// Moves columns from the ranks that own the rows to the ranks whose block they belong to. A block is dealt with in
/// parts, one after the other, so that what is under way takes little memory beside the columns.
class RowsById {
 public:
  /// Parts are as many as a block has of these rows, but not more than most_parts. Several ranks wait for each other in
  /// every part, which takes longer than to move a few rows.
  static constexpr std::int64_t usual_part_rows(int ranks) { return ranks == 1 ? 1 << 16 : 1 << 18; }
  static constexpr std::int64_t most_parts = 16;

  /// Collective. `ids`: of the rows this rank owns, in any order; over all ranks they must be first_id ... first_id +
  /// total - 1, once each. They stay where they are and must outlive this object. Throws CollectiveError on all ranks
  /// if they are not; of an id that comes twice only when its part's turn has come.
  RowsById(const Communicator& communicator, std::int64_t first_id, std::int64_t total, const Pieces<std::int64_t>& ids)
      : RowsById(communicator, first_id, total, ids, usual_part_rows(communicator.size())) {}
  /// With parts of these rows, at least 1.
  RowsById(const Communicator& communicator, std::int64_t first_id, std::int64_t total, const Pieces<std::int64_t>& ids,
           std::int64_t part_rows);

  /// Of this rank; row k is that of the id first_id + k.
  const RowBlock& block() const { return block_; }
  /// The same on all ranks, at least 1.
  int part_count() const { return part_count_; }
  /// This rank's rows of a part, none at the end of a block that is shorter than others.
  RowBlock part(int which) const;

  /// Collective. `source` holds a value for each id given to the constructor, in that order; `target` gets those of
  /// part(which), 8 bytes each. Quick where all columns of a part are gathered before those of the next.
  template <class T>
  void gather(int which, const Pieces<T>& source, std::byte* target) {
    turn_to(which);
    source.copy(rows_to_send_, std::as_writable_bytes(std::span(values_to_send_)).data());
    exchange(target);
  }

 private:
  void turn_to(int which);
  /// values_to_send_ to target.
  void exchange(std::byte* target);
  /// What is wrong with this rank's share of the ids; empty if nothing is.
  std::string check_received(std::vector<std::int32_t>& row_in_part, std::span<const std::int64_t> received) const;

  const Communicator& communicator_;
  Pieces<std::int64_t> ids_;
  std::int64_t first_id_, total_;
  RowBlock block_;
  std::int64_t part_rows_;
  int part_count_;
  std::vector<std::uint8_t> part_of_row_;
  // Of the part at hand:
  int part_ = -1;
  ExchangePlan plan_;
  std::vector<std::int32_t> rows_to_send_;  ///< rank by rank
  std::vector<std::uint64_t> values_to_send_;
};

}  // namespace sphdrop
