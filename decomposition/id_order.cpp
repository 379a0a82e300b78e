#include "decomposition/id_order.hpp"

#include <algorithm>
#include <utility>

namespace sphdrop {

IdOrder::IdOrder(std::vector<std::int64_t> ids) : ids_(std::move(ids)) {
  // Ids and places together, as the ids alone would be looked up by every comparison.
  std::vector<std::pair<std::int64_t, std::int32_t>> places;
  places.reserve(ids_.size());
  for (const std::int64_t id : ids_) places.emplace_back(id, static_cast<std::int32_t>(places.size()));
  std::sort(places.begin(), places.end());
  by_id_.reserve(places.size());
  for (const auto& [id, place] : places) by_id_.push_back(place);
}

std::int32_t IdOrder::place_of(std::int64_t id) const {
  const auto id_at = [&](std::int32_t place) { return ids_[static_cast<std::size_t>(place)]; };
  const auto found = std::lower_bound(by_id_.begin(), by_id_.end(), id,
                                      [&](std::int32_t place, std::int64_t wanted) { return id_at(place) < wanted; });
  return found != by_id_.end() && id_at(*found) == id ? *found : -1;
}

}  // namespace sphdrop
