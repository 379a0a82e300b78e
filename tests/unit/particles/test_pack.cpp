#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "particles/pack.hpp"

namespace sphdrop {
namespace {

TEST(Pack, DividesABlock) {
  EXPECT_EQ(block_size % pack_size, 0);
}

TEST(Pack, LoadsAndStoresConsecutiveValuesAtAnyAlignment) {
  std::vector<double> source(40), target(40, -1.0);
  for (std::size_t k = 0; k < source.size(); ++k) source[k] = static_cast<double>(k * k);
  for (std::size_t first = 0; first < 9; ++first) {
    store(load(source.data() + first), target.data() + first);
    for (std::size_t lane = 0; lane < pack_size; ++lane) EXPECT_EQ(target[first + lane], source[first + lane]);
    EXPECT_EQ(target[first + pack_size], -1.0);
  }
}

TEST(LoadRecords, PicksEveryComponentOfEveryLanesRow) {
  constexpr std::int32_t rows = 100;
  std::vector<double> records(std::size_t{rows} * 8);
  for (std::size_t k = 0; k < records.size(); ++k) records[k] = static_cast<double>(k) + 0.5;
  // Ascending, descending, scattered, repeated.
  for (const std::int32_t stride : {1, 99, 37, 0}) {
    std::array<std::int32_t, block_size> lane_rows{};
    for (std::int32_t lane = 0; lane < block_size; ++lane)
      lane_rows[static_cast<std::size_t>(lane)] = (11 + lane * stride) % rows;
    const std::array<Pack, 8> loaded = load_records(records.data(), lane_rows.data());
    for (std::size_t component = 0; component < 8; ++component)
      for (std::size_t lane = 0; lane < pack_size; ++lane)
        EXPECT_EQ(loaded[component][lane], records[8 * static_cast<std::size_t>(lane_rows[lane]) + component])
            << "component " << component << ", lane " << lane;
  }
}

}  // namespace
}  // namespace sphdrop
