#pragma once

#include <cstdint>

namespace sphdrop {

/// Steele, Lea & Flood's SplitMix64: the same numbers everywhere, which the standard's distributions do not promise.
class SplitMix64 {
 public:
  explicit constexpr SplitMix64(std::uint64_t seed) : state_(seed) {}

  /// As if next() had been called `count` times.
  constexpr void skip(std::uint64_t count) { state_ += count * increment; }

  constexpr std::uint64_t next() {
    std::uint64_t z = (state_ += increment);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// Uniform in [-1, 1), a multiple of 2^-52.
  constexpr double next_symmetric() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1.0; }

 private:
  static constexpr std::uint64_t increment = 0x9e3779b97f4a7c15u;

  std::uint64_t state_;
};

}  // namespace sphdrop
