// Columns in pieces, sorted by id part by part.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/collective_error.hpp"
#include "io/pieces.hpp"
#include "io/rows_by_id.hpp"

namespace sphdrop {
namespace {

TEST(Pieces, AreOneBehindTheOther) {
  const std::vector<double> first = {1, 2, 3}, second = {4, 5};
  Pieces<double> pieces(first);
  pieces.add({});
  pieces.add_constant(7, 2);
  pieces.add_constant(8, 0);
  pieces.add(second);
  EXPECT_EQ(pieces.size(), 7U);
  EXPECT_EQ(pieces.joined(), (std::vector<double>{1, 2, 3, 7, 7, 4, 5}));
  const std::vector<std::int32_t> rows = {0, 2, 3, 6, 1, 4, 5, 0};
  std::vector<double> values(rows.size());
  pieces.copy(rows, std::as_writable_bytes(std::span(values)).data());
  EXPECT_EQ(values, (std::vector<double>{1, 3, 7, 5, 2, 7, 4, 1}));
}

TEST(Pieces, MayBeNone) {
  const Pieces<std::int64_t> pieces(std::span<const std::int64_t>{});
  EXPECT_EQ(pieces.size(), 0U);
  EXPECT_TRUE(pieces.joined().empty());
  pieces.copy({}, nullptr);
}

constexpr std::int64_t first_id = 5, total = 1000;

double value_of(std::int64_t id) {
  return 1.0 / static_cast<double>(id);
}

/// A third of the ids, on three ranks and more, is with the last of them, in no order.
std::vector<std::int64_t> own_ids(const Communicator& world) {
  std::vector<std::int64_t> ids;
  for (std::int64_t k = 0; k < total; ++k) {
    const std::int64_t place = 7 * k % total;
    const std::int64_t owner = place % 3 == 0 ? world.size() - 1 : place / 11 % world.size();
    if (owner == world.rank()) ids.push_back(first_id + place);
  }
  return ids;
}

class RowsByIdParts : public testing::TestWithParam<std::int64_t> {
 protected:
  Communicator world_{MPI_COMM_WORLD};
};

TEST_P(RowsByIdParts, EveryRowOfABlockComesOnceInItsPlace) {
  const std::vector<std::int64_t> ids = own_ids(world_);
  const std::size_t half = ids.size() / 2;
  Pieces<std::int64_t> id_pieces;
  id_pieces.add(std::span(ids).first(half));
  id_pieces.add(std::span(ids).subspan(half));
  std::vector<double> values;
  for (const std::int64_t id : ids) values.push_back(value_of(id));
  // The rows before are of a constant.
  Pieces<double> mixed;
  mixed.add_constant(-1, half);
  mixed.add(std::span(values).subspan(half));

  RowsById by_id(world_, first_id, total, id_pieces, GetParam());
  EXPECT_LE(by_id.part_count(), RowsById::most_parts);
  EXPECT_EQ(world_.max(std::int64_t{by_id.part_count()}), world_.min(std::int64_t{by_id.part_count()}));
  std::int64_t next = by_id.block().first, constants = 0;
  for (int part = 0; part < by_id.part_count(); ++part) {
    const RowBlock rows = by_id.part(part);
    ASSERT_EQ(rows.first, next);
    next = rows.end;
    const auto count = static_cast<std::size_t>(rows.size());
    std::vector<double> got(count), got_mixed(count);
    std::vector<std::int64_t> got_ids(count);
    by_id.gather(part, Pieces<double>(values), std::as_writable_bytes(std::span(got)).data());
    by_id.gather(part, mixed, std::as_writable_bytes(std::span(got_mixed)).data());
    by_id.gather(part, id_pieces, std::as_writable_bytes(std::span(got_ids)).data());
    for (std::size_t k = 0; k < count; ++k) {
      const std::int64_t id = first_id + rows.first + static_cast<std::int64_t>(k);
      ASSERT_EQ(got_ids[k], id);
      ASSERT_EQ(got[k], value_of(id));
      if (got_mixed[k] == -1)
        ++constants;
      else
        ASSERT_EQ(got_mixed[k], value_of(id));
    }
  }
  EXPECT_EQ(next, by_id.block().end);
  EXPECT_EQ(world_.sum(constants), world_.sum(static_cast<std::int64_t>(half)));
}

INSTANTIATE_TEST_SUITE_P(Sizes, RowsByIdParts, testing::Values(1, 20, 64, 333, 1000, RowsById::usual_part_rows(1)));

TEST(RowsById, PartsThatAreAskedForSmallerThanASixteenthAreOfASixteenth) {
  const Communicator world(MPI_COMM_WORLD);
  const std::vector<std::int64_t> ids = own_ids(world);
  const RowsById by_id(world, first_id, total, ids, 1);
  EXPECT_LE(by_id.part_count(), RowsById::most_parts);
  EXPECT_GE(by_id.part_count(), RowsById::most_parts - 1);
}

TEST(RowsById, AnIdTwiceIsFoundInItsPart) {
  const Communicator world(MPI_COMM_WORLD);
  std::vector<std::int64_t> ids = own_ids(world);
  // The last of all comes twice and another one not at all.
  const std::int64_t last = first_id + total - 1, lost = first_id;
  for (std::int64_t& id : ids)
    if (id == lost) id = last;
  RowsById by_id(world, first_id, total, ids, 10);
  std::vector<std::int64_t> rows(static_cast<std::size_t>(by_id.block().size()));
  const auto gather_all = [&] {
    for (int part = 0; part < by_id.part_count(); ++part)
      by_id.gather(part, Pieces<std::int64_t>(ids), std::as_writable_bytes(std::span(rows)).data());
  };
  try {
    gather_all();
    FAIL() << "nothing was thrown";
  } catch (const CollectiveError& error) {
    EXPECT_NE(std::string(error.what()).find("the row id 1004 is held twice"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sphdrop
