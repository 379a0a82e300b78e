#include "decomposition/cell_index.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

namespace sphdrop {
namespace {

TEST(CellAt, RoundsDownOnBothSidesOfTheOrigin) {
  EXPECT_EQ(cell_at(0.0, 0.999), (Cell{0, 0}));
  EXPECT_EQ(cell_at(-1e-300, 1.0), (Cell{-1, 1}));
  EXPECT_EQ(cell_at(-1.0, -1.5), (Cell{-1, -2}));
}

TEST(CellAt, RefusesWhatHasNoCell) {
  EXPECT_TRUE(is_in_a_cell(-1e8, 1e8));
  EXPECT_FALSE(is_in_a_cell(std::nan(""), 0));
  EXPECT_FALSE(is_in_a_cell(0, -std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(is_in_a_cell(0, 1e9));
}

TEST(CellIndex, NumbersCellsInTheOrderOfInsertionLikeAMap) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> coordinate(-60, 60);
  CellIndex index;
  EXPECT_EQ(index.find({0, 0}), CellIndex::absent);
  for (int round = 0; round < 2; ++round) {
    std::map<Cell, std::int32_t> reference;
    for (int k = 0; k < 5000; ++k) {
      const Cell cell{coordinate(random), coordinate(random)};
      const auto [entry, is_new] = reference.try_emplace(cell, static_cast<std::int32_t>(reference.size()));
      ASSERT_EQ(index.insert(cell), entry->second);
    }
    ASSERT_EQ(index.size(), reference.size());
    for (std::int32_t column = -62; column <= 62; ++column)
      for (std::int32_t row = -62; row <= 62; ++row) {
        const auto entry = reference.find({column, row});
        ASSERT_EQ(index.find({column, row}), entry == reference.end() ? CellIndex::absent : entry->second);
      }
    index.clear();
    EXPECT_EQ(index.size(), 0U);
  }
}

}  // namespace
}  // namespace sphdrop
