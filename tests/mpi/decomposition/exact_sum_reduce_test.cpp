#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cfloat>
#include <cmath>
#include <random>

#include "decomposition/exact_sum.hpp"

namespace sphdrop {
namespace {

TEST(ExactSumReduce, GivesTheBitsOfOneRankWhoeverHoldsTheTerms) {
  const Communicator communicator(MPI_COMM_WORLD);
  std::mt19937_64 random(6);  // the same terms everywhere
  for (int round = 0; round < 100; ++round) {
    std::array<ExactSum, 3> shared;
    std::array<ExactSum, 3> alone;
    for (int k = 0; k < 300; ++k) {
      const std::size_t which = random() % 3;
      const double size = std::ldexp(1.0, static_cast<int>(random() % 2000) - 1070);
      const double term = (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5) * size;
      const auto holder = static_cast<int>(random() % static_cast<unsigned>(communicator.size()));
      alone[which].add(term);
      if (holder == communicator.rank()) shared[which].add(term);
    }
    ExactSum::reduce(shared, communicator);
    for (std::size_t which = 0; which < 3; ++which) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(shared[which].value()),
                std::bit_cast<std::uint64_t>(alone[which].value()));
      // What has been reduced can be added to, as any other sum.
      shared[which].add(-alone[which].value());
      alone[which].add(-alone[which].value());
      ASSERT_EQ(shared[which].value(), alone[which].value());
    }
  }
}

TEST(ExactSumReduce, TakesSumsFullOfCarries) {
  const Communicator communicator(MPI_COMM_WORLD);
  const double ones = 2 - DBL_EPSILON;
  std::array<ExactSum, 1> sums;
  sums[0].add(-ones);
  // One doubling less than what makes the sum carry by itself. Uncarried, 32 ranks of these would overflow.
  for (int k = 0; k < 27; ++k) sums[0].add(sums[0]);
  ExactSum expected;
  for (int rank = 0; rank < communicator.size(); ++rank) expected.add(-std::ldexp(ones, 27));
  ExactSum::reduce(sums, communicator);
  EXPECT_EQ(sums[0].value(), expected.value());
}

TEST(ExactSumReduce, OneNaNAnywhereIsSeenEverywhere) {
  const Communicator communicator(MPI_COMM_WORLD);
  for (int culprit = 0; culprit < communicator.size(); ++culprit) {
    std::array<ExactSum, 2> sums;
    sums[0].add(1);
    sums[1].add(communicator.rank() == culprit ? std::nan("") : 1);
    ExactSum::reduce(sums, communicator);
    EXPECT_EQ(sums[0].value(), communicator.size());
    EXPECT_TRUE(std::isnan(sums[1].value()));
  }
}

}  // namespace
}  // namespace sphdrop
