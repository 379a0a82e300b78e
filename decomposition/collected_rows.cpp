#include "decomposition/collected_rows.hpp"

#include <array>
#include <utility>

#include "decomposition/copy_rows.hpp"

namespace sphdrop {

CollectedRows::CollectedRows(const Communicator& communicator, std::span<const std::int64_t> ids,
                             std::vector<std::int32_t> own, std::vector<RankRows> sends, int tag)
    : own_rows_(std::move(own)),
      plan_(
          ExchangePlan::from_sends(communicator, std::move(sends), static_cast<std::int32_t>(own_rows_.size()), tag)) {
  std::vector<std::int64_t> collected(own_rows_.size() + plan_.received_row_count());
  start(std::array<const void*, 1>{ids.data()});
  finish(std::array<void*, 1>{collected.data()});
  order_ = IdOrder(std::move(collected));
}

void CollectedRows::start(std::span<const void* const> columns) {
  columns_.assign(columns.begin(), columns.end());
  plan_.start(columns);
}

void CollectedRows::finish(std::span<void* const> collected) {
  plan_.finish(collected);
  for (std::size_t c = 0; c < collected.size(); ++c) copy_rows(collected[c], columns_[c], own_rows_);
}

void CollectedRows::finish_pairs(double* collected) {
  const std::size_t own = own_rows_.size();
  first_.resize(size());
  second_.resize(size());
  plan_.finish(std::array<void*, 2>{first_.data(), second_.data()});
  const auto* first = static_cast<const double*>(columns_[0]);
  const auto* second = static_cast<const double*>(columns_[1]);
  for (std::size_t k = 0; k < own; ++k) {
    collected[2 * k] = first[own_rows_[k]];
    collected[2 * k + 1] = second[own_rows_[k]];
  }
  for (std::size_t k = own; k < size(); ++k) {
    collected[2 * k] = first_[k];
    collected[2 * k + 1] = second_[k];
  }
}

}  // namespace sphdrop
