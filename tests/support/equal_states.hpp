#pragma once
// Whether two runs are the same bit for bit, and where they are not.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "tests/support/whole_state.hpp"

namespace sphdrop::test {

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline void expect_equal(const WholeState& alone, const WholeState& together, const char* what) {
  EXPECT_EQ(alone.hash, together.hash) << what;
  ASSERT_EQ(alone.particles.size(), together.particles.size()) << what;
  for (std::size_t k = 0; k < alone.particles.size(); ++k)
    ASSERT_EQ(alone.particles[k], together.particles[k]) << what << ": particle " << alone.particles[k].id;
  ASSERT_EQ(alone.observations.size(), together.observations.size());
  for (std::size_t k = 0; k < alone.observations.size(); ++k)
    for (const ObservedQuantity& q : observed_quantities())
      EXPECT_TRUE(same_bits(alone.observations[k].*q.value, together.observations[k].*q.value))
          << what << ": " << q.name << " at observation " << k << ": " << alone.observations[k].*q.value << " and "
          << together.observations[k].*q.value;
}

}  // namespace sphdrop::test
