#include "decomposition/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace sphdrop {
namespace {

std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

double exact_sum(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

/// Shewchuk's expansion sum with the last rounding set right for ties, as in Python's math.fsum: correctly rounded
/// unless an intermediate sum overflows, and quite another algorithm.
double expansion_sum(const std::vector<double>& terms) {
  std::vector<double> partials;
  for (double x : terms) {
    std::size_t kept = 0;
    for (double y : partials) {
      if (std::abs(x) < std::abs(y)) std::swap(x, y);
      const double high = x + y;
      const double low = y - (high - x);
      if (low != 0) partials[kept++] = low;
      x = high;
    }
    partials.resize(kept);
    partials.push_back(x);
  }
  double high = 0;
  double low = 0;
  std::size_t n = partials.size();
  if (n > 0) high = partials[--n];
  while (n > 0) {
    const double x = high;
    const double y = partials[--n];
    high = x + y;
    low = y - (high - x);
    if (low != 0) break;
  }
  if (n > 0 && ((low < 0 && partials[n - 1] < 0) || (low > 0 && partials[n - 1] > 0))) {
    const double y = low * 2;
    const double x = high + y;
    if (y == x - high) high = x;
  }
  return high;
}

TEST(ExactSum, OfNothingOrZerosIsPlusZero) {
  EXPECT_EQ(bits(ExactSum().value()), 0U);
  EXPECT_EQ(bits(exact_sum({-0.0, -0.0})), 0U);
  EXPECT_EQ(bits(exact_sum({1e300, -1e300})), 0U);
}

TEST(ExactSum, OfOneTermIsThatTerm) {
  std::mt19937_64 random(2);
  std::vector<double> terms{DBL_MAX, DBL_MIN, DBL_TRUE_MIN, std::nextafter(DBL_MIN, 0), 1.0, 0.1};
  while (terms.size() < 20000) {
    const double term = std::bit_cast<double>(random());
    if (std::isfinite(term)) terms.push_back(term);
  }
  for (const double term : terms) {
    ASSERT_EQ(bits(exact_sum({term})), bits(term)) << term;
    ASSERT_EQ(bits(exact_sum({-term})), bits(-term)) << term;
  }
}

TEST(ExactSum, RoundsToNearestAndTiesToEven) {
  const double half = 0x1p-53;  // of the last place of 1
  const double least = DBL_TRUE_MIN;
  const double after_one = 1 + DBL_EPSILON;
  EXPECT_EQ(exact_sum({1, half}), 1);
  EXPECT_EQ(exact_sum({1, half, least}), after_one);
  EXPECT_EQ(exact_sum({1, half, -least}), 1);
  EXPECT_EQ(exact_sum({after_one, half}), 1 + 2 * DBL_EPSILON);
  EXPECT_EQ(exact_sum({after_one, half, -least}), after_one);
  EXPECT_EQ(exact_sum({-1, -half}), -1);
  EXPECT_EQ(exact_sum({-1, -half, -least}), -after_one);
  // All ones and a half: the carry runs through to the next binade.
  EXPECT_EQ(exact_sum({2 - DBL_EPSILON, half}), 2);
}

TEST(ExactSum, PassesOverflowOnTheWayAndReportsItAtTheEnd) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double half_last_place = 0x1p970;
  EXPECT_EQ(exact_sum({DBL_MAX, DBL_MAX, -DBL_MAX}), DBL_MAX);
  EXPECT_EQ(exact_sum({-DBL_MAX, -DBL_MAX, DBL_MAX}), -DBL_MAX);
  EXPECT_EQ(exact_sum({DBL_MAX, DBL_MAX}), infinity);
  EXPECT_EQ(exact_sum({-DBL_MAX, -DBL_MAX}), -infinity);
  EXPECT_EQ(exact_sum({DBL_MAX, half_last_place}), infinity);
  EXPECT_EQ(exact_sum({DBL_MAX, half_last_place, -DBL_TRUE_MIN}), DBL_MAX);
  EXPECT_EQ(exact_sum(std::vector<double>(1000, DBL_MAX)), infinity);
}

TEST(ExactSum, OfATermThatIsNotFiniteIsNaN) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(exact_sum({1, std::nan(""), 2})));
  EXPECT_TRUE(std::isnan(exact_sum({infinity})));
  ExactSum sum;
  ExactSum other;
  other.add(-infinity);
  sum.add(other);
  EXPECT_TRUE(std::isnan(sum.value()));
}

/// Terms of any sign with exponents drawn from [least, most] (of 2); some come back negated, so that much cancels.
std::vector<double> hard_terms(std::mt19937_64& random, int least, int most) {
  std::vector<double> terms(1 + random() % 40);
  for (double& term : terms) {
    const auto mantissa = static_cast<double>(random() >> 11);
    const int exponent = least + static_cast<int>(random() % static_cast<std::uint64_t>(most - least + 1));
    term = std::ldexp(random() % 4 == 0 ? 1.0 : mantissa * 0x1p-53, exponent) * (random() % 2 == 0 ? 1 : -1);
  }
  const std::size_t count = terms.size();
  for (std::size_t k = 0; k < count; ++k)
    if (random() % 2 == 0) terms.push_back(-terms[k]);
  return terms;
}

TEST(ExactSum, EqualsTheExpansionSumInAnyOrderAndSplit) {
  std::mt19937_64 random(3);
  const struct {
    int least, most;
  } ranges[] = {{-1074, 1000}, {-1074, -1020}, {-60, 0}, {-120, 60}, {900, 1010}, {-3, 3}, {-1074, -1000}};
  for (const auto range : ranges) {
    for (int k = 0; k < 3000; ++k) {
      std::vector<double> terms = hard_terms(random, range.least, range.most);
      const double expected = expansion_sum(terms) + 0.0;
      ASSERT_EQ(exact_sum(terms), expected) << range.least << " " << range.most;
      std::shuffle(terms.begin(), terms.end(), random);
      ExactSum parts[3];
      for (const double term : terms) parts[random() % 3].add(term);
      parts[0].add(parts[1]);
      parts[0].add(parts[2]);
      ASSERT_EQ(bits(parts[0].value()), bits(exact_sum(terms)));
    }
  }
}

TEST(ExactSum, CarriesBeforeALimbOverflows) {
  const double ones = 2 - DBL_EPSILON;  // a full mantissa fills limbs fastest
  for (const double sign : {1.0, -1.0}) {
    ExactSum sum;
    sum.add(sign * ones);
    for (int doublings = 1; doublings <= 80; ++doublings) {
      sum.add(sum);
      ASSERT_EQ(sum.value(), sign * std::ldexp(ones, doublings));
      // Single terms at every height of the limbs, so that both ways of adding meet the limit.
      for (int k = 0; k < 100; ++k) sum.add(sign * ones);
      ExactSum difference = sum;
      difference.add(-sign * std::ldexp(ones, doublings));
      ASSERT_EQ(difference.value(), expansion_sum(std::vector<double>(100, sign * ones)));
      for (int k = 0; k < 100; ++k) sum.add(-sign * ones);
    }
  }
}

TEST(ExactSum, KeepsAMillionTermsExactly) {
  ExactSum sum;
  for (int k = 1; k <= 1000000; ++k) {
    sum.add(0x1p-1000 * k);
    sum.add(0x1p900);
  }
  for (int k = 1; k <= 1000000; ++k) sum.add(-0x1p900);
  EXPECT_EQ(sum.value(), 0x1p-1000 * 500000500000.0);
}

}  // namespace
}  // namespace sphdrop
