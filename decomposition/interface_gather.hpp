#pragma once
// A few rows of all ranks brought together at one of them, and results sent back.

#include <cstdint>
#include <span>
#include <vector>

#include "decomposition/exchange_plan.hpp"

namespace sphdrop {

/// The rank that holds most of something, the lowest of equals: where an interface is worked on. Collective.
int rank_with_most(const Communicator& communicator, std::int64_t held);

/// Rows that ranks contribute to an interface, gathered at its owner. What is computed there must not depend on who
/// contributed what: it goes through them in ascending global id, which is the order they lie in.
class InterfaceGather {
 public:
  InterfaceGather() = default;

  /// Collective. `ids` and `rows` (shape [n]): the global ids and local rows this rank contributes, in any order.
  /// The tags `tag` and `tag + 1` keep its messages apart from others in flight.
  InterfaceGather(const Communicator& communicator, std::span<const std::int64_t> ids,
                  std::span<const std::int32_t> rows, int owner, int tag);

  int owner() const { return owner_; }
  /// At the owner the gathered ids, ascending; empty elsewhere. One that several ranks contribute is there as often.
  std::span<const std::int64_t> ids() const { return ids_; }

  /// The messages of a gather, and with sends and receives exchanged, of a scatter. The owner's own rows are not among
  /// them: they are copied as the gather or scatter finishes, and must stay as they are until then.
  const ExchangePlan& plan() const { return gather_; }

  /// Sends this rank's rows of the columns to the owner, where finish_gather stores them in ids() order.
  void start_gather(std::span<const void* const> columns) { start(gather_, columns); }
  void finish_gather(std::span<void* const> gathered);
  /// Sends the owner's results (ids() order) back; finish_scatter stores them in the order in which this rank named its
  /// rows: there are few of them.
  void start_scatter(std::span<const void* const> results) { start(scatter_, results); }
  void finish_scatter(std::span<void* const> columns);

 private:
  void start(ExchangePlan& plan, std::span<const void* const> columns);

  int owner_ = 0;
  std::vector<std::int64_t> ids_;
  ExchangePlan gather_, scatter_;
  // At the owner, of the rows it contributes itself: where they are and where they go.
  std::vector<std::int32_t> own_rows_, own_places_;
  std::vector<const void*> own_columns_;  ///< of the gather or scatter under way
};

}  // namespace sphdrop
