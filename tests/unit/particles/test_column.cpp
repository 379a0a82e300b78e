#include <gtest/gtest.h>

#include <cstdint>

#include "particles/column.hpp"

namespace sphdrop {
namespace {

void expect_padding(const Column<double>& column, double value) {
  const double* first = column.data();
  const double* end = column.data() + column.size();
  for (std::size_t k = 0; k < column_padding; ++k) {
    EXPECT_EQ(end[k], value) << k;
    EXPECT_EQ(first[-1 - static_cast<std::ptrdiff_t>(k)], value) << k;
  }
}

TEST(Column, IsPaddedOnBothSidesFromTheStart) {
  const Column<double> column(7.5);
  EXPECT_EQ(column.size(), 0u);
  expect_padding(column, 7.5);
}

TEST(Column, ResizingKeepsRowsAndZeroesNewOnes) {
  Column<double> column(7.5);
  column.resize(5);
  for (std::size_t row = 0; row < 5; ++row) {
    EXPECT_EQ(column[row], 0.0);
    column[row] = 10.0 + static_cast<double>(row);
  }
  column.resize(40);
  EXPECT_EQ(column.size(), 40u);
  for (std::size_t row = 0; row < 5; ++row) EXPECT_EQ(column[row], 10.0 + static_cast<double>(row));
  for (std::size_t row = 5; row < 40; ++row) EXPECT_EQ(column[row], 0.0) << row;
  expect_padding(column, 7.5);
}

TEST(Column, RowsThatLeaveBecomePaddingAndComeBackAsZeros) {
  Column<double> column(7.5);
  column.resize(40);
  for (double& value : column) value = 3.0;
  column.resize(2);
  EXPECT_EQ(column[1], 3.0);
  expect_padding(column, 7.5);
  column.resize(9);
  EXPECT_EQ(column[1], 3.0);
  for (std::size_t row = 2; row < 9; ++row) EXPECT_EQ(column[row], 0.0) << row;
  expect_padding(column, 7.5);
}

TEST(Column, SwapExchangesRowsAndPadding) {
  Column<double> a(1.0), b(2.0);
  a.resize(3);
  a[2] = 30.0;
  b.resize(1);
  a.swap(b);
  EXPECT_EQ(a.size(), 1u);
  EXPECT_EQ(b.size(), 3u);
  EXPECT_EQ(b[2], 30.0);
  expect_padding(a, 2.0);
  expect_padding(b, 1.0);
  b.resize(4);
  expect_padding(b, 1.0);
}

TEST(Column, FirstRowLiesOnACacheLine) {
  for (const std::size_t rows : {1u, 7u, 1000u}) {
    Column<double> column;
    column.resize(rows);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(column.data()) % 64, 0u);
  }
}

TEST(Column, IteratesOverItsRowsOnly) {
  Column<std::int64_t> column(-1);
  column.resize(3);
  std::int64_t count = 0;
  for (std::int64_t& value : column) value = ++count;
  EXPECT_EQ(count, 3);
  EXPECT_EQ(column[2], 3);
}

}  // namespace
}  // namespace sphdrop
