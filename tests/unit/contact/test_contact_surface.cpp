#include <gtest/gtest.h>

#include "contact/contact_surface.hpp"

namespace sphdrop {
namespace {

TEST(SegmentsOfPolylines, LinksNeighboursWithinAPolylineOnly) {
  const std::vector<std::vector<std::int32_t>> polylines{{4, 7, 5}, {9}, {}, {0, 1}};
  const auto segments = segments_of_polylines(polylines);
  const std::vector<Segment> expected{{4, 7, -1, 1}, {7, 5, 0, -1}, {0, 1, -1, -1}};
  EXPECT_EQ(segments, expected);
}

TEST(SegmentsOfPolylines, ClosesAPolylineThatEndsWhereItBegan) {
  const std::vector<std::vector<std::int32_t>> polylines{{8, 9}, {0, 1, 2, 0}};
  const auto segments = segments_of_polylines(polylines);
  const std::vector<Segment> expected{{8, 9, -1, -1}, {0, 1, 3, 2}, {1, 2, 1, 3}, {2, 0, 2, 1}};
  EXPECT_EQ(segments, expected);
}

TEST(PartOfSurface, AddsOneSegmentOnEitherSide) {
  const std::vector<std::vector<std::int32_t>> polylines{{20, 18, 16, 14, 12, 10, 8}};
  const auto whole = segments_of_polylines(polylines);
  const std::vector<char> wanted{0, 0, 0, 1, 0, 0};
  const SurfacePart part = part_of_surface(whole, wanted);
  EXPECT_EQ(part.original_segments, (std::vector<std::int32_t>{2, 3, 4}));
  EXPECT_EQ(part.original_vertices, (std::vector<std::int32_t>{10, 12, 14, 16}));
  const std::vector<Segment> expected{{3, 2, -1, 1}, {2, 1, 0, 2}, {1, 0, 1, -1}};
  EXPECT_EQ(part.segments, expected);
}

TEST(PartOfSurface, KeepsFreeEndsAndGaps) {
  const std::vector<std::vector<std::int32_t>> polylines{{0, 1, 2, 3, 4, 5, 6, 7}};
  const auto whole = segments_of_polylines(polylines);
  const std::vector<char> wanted{1, 0, 0, 0, 0, 0, 1};
  const SurfacePart part = part_of_surface(whole, wanted);
  EXPECT_EQ(part.original_segments, (std::vector<std::int32_t>{0, 1, 5, 6}));
  EXPECT_EQ(part.original_vertices, (std::vector<std::int32_t>{0, 1, 2, 5, 6, 7}));
  const std::vector<Segment> expected{{0, 1, -1, 1}, {1, 2, 0, -1}, {3, 4, -1, 3}, {4, 5, 2, -1}};
  EXPECT_EQ(part.segments, expected);
}

TEST(PartOfSurface, OfNothingIsNothing) {
  const auto whole = segments_of_polylines(std::vector<std::vector<std::int32_t>>{{0, 1, 2}});
  const SurfacePart part = part_of_surface(whole, std::vector<char>{0, 0});
  EXPECT_TRUE(part.segments.empty());
  EXPECT_TRUE(part.original_vertices.empty());
}

}  // namespace
}  // namespace sphdrop
