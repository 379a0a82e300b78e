#include "decomposition/id_order.hpp"

#include <gtest/gtest.h>

namespace sphdrop {
namespace {

TEST(IdOrder, FindsEveryIdAndNoOther) {
  const std::vector<std::int64_t> ids{40, 7, std::int64_t{1} << 40, 0, 12};
  const IdOrder order(ids);
  for (std::size_t k = 0; k < ids.size(); ++k) EXPECT_EQ(order.place_of(ids[k]), static_cast<std::int32_t>(k));
  for (const std::int64_t other : {-1, 1, 11, 13, 41}) EXPECT_EQ(order.place_of(other), -1);
  EXPECT_EQ(order.place_of(std::int64_t{1} << 41), -1);
  EXPECT_EQ((std::vector<std::int32_t>(order.by_id().begin(), order.by_id().end())),
            (std::vector<std::int32_t>{3, 1, 4, 0, 2}));
}

TEST(IdOrder, OfNothingFindsNothing) {
  EXPECT_EQ(IdOrder().place_of(0), -1);
  EXPECT_EQ(IdOrder(std::vector<std::int64_t>{}).place_of(3), -1);
}

}  // namespace
}  // namespace sphdrop
