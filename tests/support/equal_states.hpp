#pragma once
// Whether two runs are the same bit for bit, and where they are not.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

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

/// Collective. All ranks together give what one gives alone, dealt out anew on the way or not, and that is the hash
/// recorded once, which any compiler, vector width and machine must give. `run(communicator, overrides)` takes `steps`
/// steps. Returns the state of the run alone on rank 0, which has no particles on the others.
template <class Run>
WholeState expect_equal_on_ranks(const Run& run, int steps, std::uint64_t recorded_hash) {
  const Communicator world(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const WholeState together = run(world, std::vector<std::string>{});
  const WholeState restless = run(world, std::vector<std::string>{"parallel.repartition_interval=37"});
  EXPECT_GT(restless.redistributions, steps / 37);
  if (world.rank() != 0) return {};
  WholeState alone = run(self, std::vector<std::string>{});
  EXPECT_EQ(alone.hash, recorded_hash) << fmt::format("it is now 0x{:016x}", alone.hash);
  expect_equal(alone, together, "together");
  expect_equal(alone, restless, "with forced repartitions");
  return alone;
}

inline WholeState expect_case_equal_on_ranks(const std::string& case_text, int steps, std::uint64_t recorded_hash) {
  const auto run = [&](const Communicator& communicator, const std::vector<std::string>& overrides) {
    return run_steps(communicator, case_text, steps, overrides);
  };
  return expect_equal_on_ranks(run, steps, recorded_hash);
}

}  // namespace sphdrop::test
