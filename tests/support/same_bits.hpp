#pragma once
// Equality of doubles to the last bit: unlike ==, it tells -0 from 0 and finds a NaN equal to itself.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

namespace sphdrop::test {

inline ::testing::AssertionResult same_bits(double a, double b) {
  if (std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << std::hexfloat << a << " and " << b << " differ";
}

}  // namespace sphdrop::test
