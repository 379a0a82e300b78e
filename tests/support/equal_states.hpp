#pragma once
// Whether two runs are the same bit for bit, and where they are not.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>

#include "tests/support/whole_state.hpp"

namespace sphdrop::test {

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline void expect_equal(const Observation& a, const Observation& b, const std::string& what) {
  for (const ObservedQuantity& q : observed_quantities())
    EXPECT_TRUE(same_bits(a.*q.value, b.*q.value))
        << what << ": " << q.name << ": " << a.*q.value << " and " << b.*q.value;
  ASSERT_EQ(a.solids.size(), b.solids.size()) << what;
  for (std::size_t k = 0; k < a.solids.size(); ++k)
    for (const SolidQuantity& q : solid_quantities())
      EXPECT_TRUE(same_bits(a.solids[k].*q.value, b.solids[k].*q.value))
          << what << ": " << q.name << " of solid " << k + 1;
}

inline void expect_equal(const WholeState& alone, const WholeState& together, const char* what) {
  EXPECT_EQ(alone.hash, together.hash) << what;
  ASSERT_EQ(alone.particles.size(), together.particles.size()) << what;
  for (std::size_t k = 0; k < alone.particles.size(); ++k)
    ASSERT_EQ(alone.particles[k], together.particles[k]) << what << ": particle " << alone.particles[k].id;
  ASSERT_EQ(alone.observations.size(), together.observations.size());
  for (std::size_t k = 0; k < alone.observations.size(); ++k)
    expect_equal(alone.observations[k], together.observations[k], fmt::format("{}: observation {}", what, k));
}

}  // namespace sphdrop::test
