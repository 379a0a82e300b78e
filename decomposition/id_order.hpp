#pragma once
// Rows in ascending order of their global ids, and found by them.

#include <cstdint>
#include <span>
#include <vector>

namespace sphdrop {

/// Ids that lie in any order, each of them once.
class IdOrder {
 public:
  IdOrder() = default;
  explicit IdOrder(std::vector<std::int64_t> ids);

  /// As they lie.
  std::span<const std::int64_t> ids() const { return ids_; }
  /// Their places in ascending order.
  std::span<const std::int32_t> by_id() const { return by_id_; }
  /// The place of `id`, -1 if it is not there.
  std::int32_t place_of(std::int64_t id) const;

 private:
  std::vector<std::int64_t> ids_;
  std::vector<std::int32_t> by_id_;
};

}  // namespace sphdrop
