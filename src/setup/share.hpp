#pragma once
// Which of the particles are wanted, where not all are.

#include <algorithm>
#include <cstdint>

namespace sphdrop {

/// Consecutive numbers, `last` not among them.
struct IdRange {
  std::int64_t first = 0, last = 0;

  std::int64_t count() const { return last - first; }
  bool contains(IdRange other) const { return other.first >= first && other.last <= last; }
  IdRange common_with(IdRange other) const {
    const std::int64_t begin = std::max(first, other.first);
    return {begin, std::max(begin, std::min(last, other.last))};
  }
};

/// One of `count` shares of equal size, to within a particle: together they are the whole, in order.
struct Share {
  std::int64_t index = 0, count = 1;

  IdRange of(std::int64_t total) const { return {total * index / count, total * (index + 1) / count}; }
};

}  // namespace sphdrop
