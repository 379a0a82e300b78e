#pragma once
// Some of the own rows, with copies of other ranks' rows behind them.

#include <cstdint>
#include <span>
#include <vector>

#include "decomposition/exchange_plan.hpp"
#include "decomposition/id_order.hpp"

namespace sphdrop {

/// Rows brought together on every rank that has a use for them, which is another set on each: first the own ones, then
/// those of other ranks as they arrive. What is computed of them must not depend on who owns which: it goes through
/// them in ascending global id.
class CollectedRows {
 public:
  CollectedRows() = default;

  /// Collective. `ids`: of all rows of this rank, by row; `own`: those collected here; `sends`: what other ranks are to
  /// have, by ascending rank. A row comes to a rank at most once.
  CollectedRows(const Communicator& communicator, std::span<const std::int64_t> ids, std::vector<std::int32_t> own,
                std::vector<RankRows> sends, int tag);

  /// The own ones.
  std::span<const std::int32_t> own_rows() const { return own_rows_; }
  std::size_t size() const { return order_.ids().size(); }
  /// Of all that are collected.
  const IdOrder& order() const { return order_; }

  /// Collects columns that are addressed by row in arrays that are addressed by place. The own rows are copied as it
  /// finishes, and must stay as they are until then.
  void start(std::span<const void* const> columns);
  void finish(std::span<void* const> collected);
  /// Of two columns: their numbers of a place side by side, shape [size()][2].
  void finish_pairs(double* collected);

  /// The messages to and from other ranks.
  const ExchangePlan& plan() const { return plan_; }

 private:
  std::vector<std::int32_t> own_rows_;
  ExchangePlan plan_;
  IdOrder order_;
  std::vector<const void*> columns_;    ///< of what is under way
  std::vector<double> first_, second_;  ///< scratch: what has arrived of pairs
};

}  // namespace sphdrop
