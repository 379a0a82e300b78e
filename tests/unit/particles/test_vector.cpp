#include <gtest/gtest.h>

#include "particles/vector.hpp"

namespace sphdrop {
namespace {

TEST(Vector, HasTheAlgebraOfThePlane) {
  constexpr Vector a{3, -4}, b{0.5, 2};
  EXPECT_EQ(a + b, (Vector{3.5, -2}));
  EXPECT_EQ(a - b, (Vector{2.5, -6}));
  EXPECT_EQ(2.0 * a, (Vector{6, -8}));
  EXPECT_EQ(a * 2.0, (Vector{6, -8}));
  EXPECT_EQ(a / 2.0, (Vector{1.5, -2}));
  Vector c = a;
  c += b;
  EXPECT_EQ(c, a + b);
  c -= b;
  EXPECT_EQ(c, a);
  EXPECT_EQ(Vector{}, (Vector{0, 0}));
}

TEST(Vector, HasProductsAndLengths) {
  constexpr Vector a{3, -4}, b{0.5, 2};
  EXPECT_EQ(dot(a, b), -6.5);
  EXPECT_EQ(cross(a, b), 8.0);
  EXPECT_EQ(cross(b, a), -8.0);
  EXPECT_EQ(squared_length(a), 25.0);
  EXPECT_EQ(length(a), 5.0);
  EXPECT_EQ(unit(a), (Vector{0.6, -0.8}));
}

TEST(Vector, NormalsPointToTheSideTheyName) {
  constexpr Vector along_x{2, 0};
  EXPECT_EQ(left_normal(along_x), (Vector{0, 2}));
  EXPECT_EQ(right_normal(along_x), (Vector{0, -2}));
  constexpr Vector a{3, -4};
  EXPECT_GT(cross(a, left_normal(a)), 0);
  EXPECT_LT(cross(a, right_normal(a)), 0);
  EXPECT_EQ(dot(a, left_normal(a)), 0);
  EXPECT_EQ(dot(a, right_normal(a)), 0);
}

TEST(Vector, HasPartsWithoutAComponent) {
  const Vector found = without_component({3, -4}, {0, 2});
  EXPECT_EQ(found, (Vector{3, 0}));
  EXPECT_NEAR(dot(without_component({3, -4}, {0.5, 2}), {0.5, 2}), 0.0, 1e-15);
  EXPECT_EQ(without_component({3, -4}, {}), (Vector{3, -4}));
}

}  // namespace
}  // namespace sphdrop
