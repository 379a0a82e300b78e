#pragma once
// The SIMD vector of doubles that the sweeps are written on, and the transposed load of records.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>

namespace sphdrop {

/// As wide as the machine's vectors. A lane always holds one particle and does the same operations in the same order as
/// a scalar would, so the width does not change a bit of the result.
using Pack = std::experimental::native_simd<double>;
inline constexpr int pack_size = static_cast<int>(Pack::size());

/// Particles treated together: a multiple of every pack size.
inline constexpr int block_size = 8;

inline Pack load(const double* p) {
  return Pack(p, std::experimental::element_aligned);
}
inline void store(const Pack& value, double* p) {
  value.copy_to(p, std::experimental::element_aligned);
}

/// Loads one record of eight doubles (a cache line) per lane and returns component c of all lanes in result[c].
[[gnu::always_inline]] inline std::array<Pack, 8> load_records(const double* records, const std::int32_t* lane_rows) {
#if defined(__AVX512F__)
  // Three rounds of shuffles transpose eight cache lines; element-wise loads would take 64.
  using Line = double __attribute__((vector_size(64)));
  using LineInMemory = double __attribute__((vector_size(64), aligned(8), may_alias));
  const auto line = [&](int lane) -> Line {
    return *reinterpret_cast<const LineInMemory*>(records + std::ptrdiff_t{8} * lane_rows[lane]);
  };
  const Line r0 = line(0), r1 = line(1), r2 = line(2), r3 = line(3), r4 = line(4), r5 = line(5), r6 = line(6),
             r7 = line(7);
  const auto even = [](Line a, Line b) -> Line { return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14); };
  const auto odd = [](Line a, Line b) -> Line { return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15); };
  const auto first_pairs = [](Line a, Line b) -> Line {
    return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
  };
  const auto last_pairs = [](Line a, Line b) -> Line {
    return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
  };
  const auto low = [](Line a, Line b) {
    return std::bit_cast<Pack>(Line(__builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11)));
  };
  const auto high = [](Line a, Line b) {
    return std::bit_cast<Pack>(Line(__builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15)));
  };
  const Line e01 = even(r0, r1), e23 = even(r2, r3), e45 = even(r4, r5), e67 = even(r6, r7);
  const Line o01 = odd(r0, r1), o23 = odd(r2, r3), o45 = odd(r4, r5), o67 = odd(r6, r7);
  const Line c0 = first_pairs(e01, e23), c2 = last_pairs(e01, e23), d0 = first_pairs(e45, e67),
             d2 = last_pairs(e45, e67);
  const Line c1 = first_pairs(o01, o23), c3 = last_pairs(o01, o23), d1 = first_pairs(o45, o67),
             d3 = last_pairs(o45, o67);
  return {low(c0, d0), low(c1, d1), low(c2, d2), low(c3, d3), high(c0, d0), high(c1, d1), high(c2, d2), high(c3, d3)};
#else
  std::array<Pack, 8> result;
  for (int c = 0; c < 8; ++c)
    result[static_cast<std::size_t>(c)] =
        Pack([&](auto lane) { return records[8 * static_cast<std::ptrdiff_t>(lane_rows[lane]) + c]; });
  return result;
#endif
}

}  // namespace sphdrop
