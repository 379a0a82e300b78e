#include "decomposition/quantised_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace sphdrop {
namespace {

std::vector<double> terms() {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(-9.0, 3.0), sign(-1.0, 1.0);
  std::vector<double> result;
  for (int k = 0; k < 1003; ++k) result.push_back(sign(random) * std::pow(10.0, exponent(random)));
  return result;
}

double sum_of(const std::vector<double>& values, double quantum, std::size_t parts) {
  QuantisedSum all(quantum);
  for (std::size_t part = 0; part < parts; ++part) {
    QuantisedSum sum(quantum);
    const std::size_t first = values.size() * part / parts, last = values.size() * (part + 1) / parts;
    sum.add(std::span(values).subspan(first, last - first));
    all.add(sum);
  }
  return all.value();
}

TEST(QuantisedSum, KnowsNeitherOrderNorParts) {
  std::vector<double> values = terms();
  const double quantum = 1e-12;
  const double expected = sum_of(values, quantum, 1);
  double plain = 0;
  for (const double value : values) plain += value;
  std::mt19937_64 random(7);
  bool plain_differs = false;
  for (int k = 0; k < 20; ++k) {
    std::shuffle(values.begin(), values.end(), random);
    for (const std::size_t parts : {1U, 2U, 7U, 500U}) EXPECT_EQ(sum_of(values, quantum, parts), expected);
    QuantisedSum one_by_one(quantum);
    double again = 0;
    for (const double value : values) {
      one_by_one.add(value);
      again += value;
    }
    EXPECT_EQ(one_by_one.value(), expected);
    plain_differs = plain_differs || again != plain;
  }
  EXPECT_TRUE(plain_differs);  // or this test could not fail
  EXPECT_NEAR(expected, plain, 1003 * quantum);
}

TEST(QuantisedSum, IsAWholeNumberOfQuanta) {
  QuantisedSum sum(0.3);
  EXPECT_EQ(sum.quantum(), 0.25);
  for (const double term : {1.0, 0.3, -0.1, 0.126, -7.5}) sum.add(term);
  EXPECT_EQ(sum.value(), 1.0 + 0.25 + 0.0 + 0.25 - 7.5);
  EXPECT_EQ(sum.quanta(), -24);
  EXPECT_EQ(static_cast<double>(sum.quanta()) * sum.quantum(), sum.value());
}

TEST(QuantisedSum, HoldsWhatItSays) {
  QuantisedSum sum(1.0);
  sum.add(0x1p51 - 1.0);
  sum.add(-3.0);
  EXPECT_EQ(sum.quanta(), (std::int64_t{1} << 51) - 4);
}

}  // namespace
}  // namespace sphdrop
