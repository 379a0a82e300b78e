#pragma once
// Nodes that follow one another on a curve, side by side in the lanes of vectors.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "particles/pack.hpp"
#include "particles/vector.hpp"
#include "surface_tension/surface_curve.hpp"

namespace sphdrop {

/// x and y of one node, or of a vector of them.
template <class Real>
struct Components {
  Real x, y;

  friend Components operator-(const Components& a, const Components& b) { return {a.x - b.x, a.y - b.y}; }
};

/// Of the nodes k, k + 1, ...
inline Components<Pack> load_lanes(std::span<const Vector> vectors, std::size_t k) {
  const double* const numbers = &vectors[k].x;
#if defined(__AVX512F__)
  using Line = double __attribute__((vector_size(64)));
  const auto first = std::bit_cast<Line>(load(numbers)), second = std::bit_cast<Line>(load(numbers + pack_size));
  return {std::bit_cast<Pack>(Line(__builtin_shufflevector(first, second, 0, 2, 4, 6, 8, 10, 12, 14))),
          std::bit_cast<Pack>(Line(__builtin_shufflevector(first, second, 1, 3, 5, 7, 9, 11, 13, 15)))};
#else
  return {Pack([&](auto lane) { return numbers[2 * static_cast<std::size_t>(lane)]; }),
          Pack([&](auto lane) { return numbers[2 * static_cast<std::size_t>(lane) + 1]; })};
#endif
}

inline void store_lanes(const Components<Pack>& lanes, std::span<Vector> vectors, std::size_t k) {
#if defined(__AVX512F__)
  double* const numbers = &vectors[k].x;
  using Line = double __attribute__((vector_size(64)));
  const auto x = std::bit_cast<Line>(lanes.x), y = std::bit_cast<Line>(lanes.y);
  store(std::bit_cast<Pack>(Line(__builtin_shufflevector(x, y, 0, 8, 1, 9, 2, 10, 3, 11))), numbers);
  store(std::bit_cast<Pack>(Line(__builtin_shufflevector(x, y, 4, 12, 5, 13, 6, 14, 7, 15))), numbers + pack_size);
#else
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(pack_size); ++lane)
    vectors[k + lane] = {lanes.x[lane], lanes.y[lane]};
#endif
}

/// Of those that are numbered.
[[gnu::always_inline]] inline Components<Pack> collect_lanes(std::span<const Vector> vectors,
                                                             const std::int32_t* numbers) {
#if defined(__AVX512F__)
  // Both numbers of a vector at a time: the one port that can shuffle has little to do then.
  using Two = double __attribute__((vector_size(16)));
  using Four = double __attribute__((vector_size(32)));
  using Line = double __attribute__((vector_size(64)));
  const auto two = [&](int lane) -> Two {
    Two pair;
    std::memcpy(&pair, &vectors[static_cast<std::size_t>(numbers[lane])], sizeof pair);
    return pair;
  };
  const auto four = [&](int lane) -> Four { return __builtin_shufflevector(two(lane), two(lane + 1), 0, 1, 2, 3); };
  const Line first = __builtin_shufflevector(four(0), four(2), 0, 1, 2, 3, 4, 5, 6, 7);
  const Line second = __builtin_shufflevector(four(4), four(6), 0, 1, 2, 3, 4, 5, 6, 7);
  return {std::bit_cast<Pack>(Line(__builtin_shufflevector(first, second, 0, 2, 4, 6, 8, 10, 12, 14))),
          std::bit_cast<Pack>(Line(__builtin_shufflevector(first, second, 1, 3, 5, 7, 9, 11, 13, 15)))};
#else
  return {Pack([&](auto lane) { return vectors[static_cast<std::size_t>(numbers[lane])].x; }),
          Pack([&](auto lane) { return vectors[static_cast<std::size_t>(numbers[lane])].y; })};
#endif
}

inline Components<double> components(Vector a) {
  return {a.x, a.y};
}

/// Goes along a curve: many(k) for as many nodes from k on as a vector has lanes, which have their neighbours before
/// and after them in the array, or, where it returns false and where there are fewer, one(k).
template <class Many, class One>
void for_each_node(const SurfaceCurves::Range& curve, Many many, One one) {
  constexpr auto lanes = static_cast<std::size_t>(pack_size);
  std::size_t k = curve.first;
  one(k++);
  for (; k + lanes < curve.last; k += lanes)
    if (!many(k))
      for (std::size_t lane = 0; lane < lanes; ++lane) one(k + lane);
  for (; k < curve.last; ++k) one(k);
}

}  // namespace sphdrop
