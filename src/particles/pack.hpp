#pragma once
// The SIMD vector of doubles that the sweeps are written on, and the transposed load of records.

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <experimental/simd>

namespace sphdrop {

/// As wide as the machine's vectors. A lane always holds one particle and does the same operations in the same order as a
/// scalar would, so the width does not change a bit of the result.
using Pack = std::experimental::native_simd<double>;
inline constexpr int pack_size = static_cast<int>(Pack::size());

/// Particles treated together: a multiple of every pack size.
inline constexpr int block_size = 8;

inline Pack load(const double* p) { return Pack(p, std::experimental::element_aligned); }
inline void store(const Pack& value, double* p) { value.copy_to(p, std::experimental::element_aligned); }

/// Loads one record of eight doubles (a cache line) per lane and returns component c of all lanes in result[c].
[[gnu::always_inline]] inline std::array<Pack, 8> load_records(const double* records, const std::int32_t* lane_rows) {
#if defined(__AVX512F__)
  using Vector8 = double __attribute__((vector_size(64)));
  Vector8 r[8];
  for (int lane = 0; lane < 8; ++lane) std::memcpy(&r[lane], records + 8 * std::int64_t{lane_rows[lane]}, sizeof r[lane]);
  Vector8 a[8], b[8];
  for (int k = 0; k < 8; k += 2) {
    a[k] = __builtin_shufflevector(r[k], r[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    a[k + 1] = __builtin_shufflevector(r[k], r[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int k = 0; k < 8; k += 4)
    for (int odd = 0; odd < 2; ++odd) {
      b[k + odd] = __builtin_shufflevector(a[k + odd], a[k + 2 + odd], 0, 1, 8, 9, 4, 5, 12, 13);
      b[k + 2 + odd] = __builtin_shufflevector(a[k + odd], a[k + 2 + odd], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  std::array<Pack, 8> result;
  for (int k = 0; k < 4; ++k) {
    result[static_cast<std::size_t>(k)] =
        std::bit_cast<Pack>(Vector8(__builtin_shufflevector(b[k], b[k + 4], 0, 1, 2, 3, 8, 9, 10, 11)));
    result[static_cast<std::size_t>(k + 4)] =
        std::bit_cast<Pack>(Vector8(__builtin_shufflevector(b[k], b[k + 4], 4, 5, 6, 7, 12, 13, 14, 15)));
  }
  return result;
#else
  std::array<Pack, 8> result;
  for (int c = 0; c < 8; ++c)
    result[static_cast<std::size_t>(c)] = Pack([&](auto lane) { return records[8 * std::int64_t{lane_rows[lane]} + c]; });
  return result;
#endif
}

}  // namespace sphdrop
