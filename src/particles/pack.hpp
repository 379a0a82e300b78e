#pragma once
// The SIMD vector of doubles that the sweeps are written on, and the transposed load of records.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>
#if defined(__AVX512F__)
#include <immintrin.h>
#endif

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
  // Eight cache lines are transposed in three rounds; element-wise loads would take 64. The first round, of halves of
  // lines, is done by loading, which leaves the one port that can shuffle to the other two.
  using Line = double __attribute__((vector_size(64)));
  const auto halves = [&](int lane, int half) -> Line {
    const double* low = records + std::ptrdiff_t{8} * lane_rows[lane] + std::ptrdiff_t{4} * half;
    const double* high = records + std::ptrdiff_t{8} * lane_rows[lane + 4] + std::ptrdiff_t{4} * half;
    return static_cast<Line>(
        _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(low)), _mm256_loadu_pd(high), 1));
  };
  const auto even = [](Line a, Line b) -> Line { return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14); };
  const auto odd = [](Line a, Line b) -> Line { return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15); };
  const auto first_pairs = [](Line a, Line b) {
    return std::bit_cast<Pack>(Line(__builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13)));
  };
  const auto last_pairs = [](Line a, Line b) {
    return std::bit_cast<Pack>(Line(__builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15)));
  };
  const Line a0 = halves(0, 0), a1 = halves(1, 0), a2 = halves(2, 0), a3 = halves(3, 0);
  const Line b0 = halves(0, 1), b1 = halves(1, 1), b2 = halves(2, 1), b3 = halves(3, 1);
  const Line e01 = even(a0, a1), e23 = even(a2, a3), o01 = odd(a0, a1), o23 = odd(a2, a3);
  const Line f01 = even(b0, b1), f23 = even(b2, b3), p01 = odd(b0, b1), p23 = odd(b2, b3);
  return {first_pairs(e01, e23), first_pairs(o01, o23), last_pairs(e01, e23), last_pairs(o01, o23),
          first_pairs(f01, f23), first_pairs(p01, p23), last_pairs(f01, f23), last_pairs(p01, p23)};
#else
  std::array<Pack, 8> result;
  for (int c = 0; c < 8; ++c)
    result[static_cast<std::size_t>(c)] =
        Pack([&](auto lane) { return records[8 * static_cast<std::ptrdiff_t>(lane_rows[lane]) + c]; });
  return result;
#endif
}

}  // namespace sphdrop
