#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "solid/cells/lattice_cells.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/unit/solid/lattice_body.hpp"

namespace sphdrop {
namespace {

using test::lattice_body;
using test::LatticeBody;
constexpr double d = 2.5e-5;

LatticeCells cells_of(const std::vector<std::string>& drawing, bool held_at_edge = false) {
  const LatticeBody body = lattice_body(drawing, d);
  return LatticeCells(body.positions, body.is_held, d, held_at_edge);
}

struct Moments {
  double area = 0, first_x = 0, first_y = 0, second_x = 0, second_y = 0;
};

/// Of all cells together about the place of particle 0, in spacings.
Moments moments(const LatticeCells& cells, const std::vector<Vector>& positions) {
  Moments sum;
  for (std::size_t k = 0; k < cells.particle_count(); ++k) {
    const CellShape<double>* s = cells.shape(static_cast<std::int32_t>(k));
    if (s == nullptr) continue;
    const double x = (positions[k].x - positions[0].x) / d + 0.5 + s->centroid_x;
    const double y = (positions[k].y - positions[0].y) / d + 0.5 + s->centroid_y;
    sum.area += s->area;
    sum.first_x += s->area * x;
    sum.first_y += s->area * y;
    sum.second_x += s->moment_x + s->area * x * x;
    sum.second_y += s->moment_y + s->area * y * y;
  }
  return sum;
}

TEST(LatticeCells, FillARectangleWithAllItsMoments) {
  const LatticeBody body = lattice_body({"######", "######", "######", "######"}, d);
  const LatticeCells cells(body.positions, body.is_held, d, false);
  EXPECT_EQ(cells.cell_count(), 5 * 3);
  const Moments m = moments(cells, body.positions);
  EXPECT_DOUBLE_EQ(m.area, 24.0);
  EXPECT_NEAR(m.first_x / m.area, 2.5, 1e-14);
  EXPECT_NEAR(m.first_y / m.area, 1.5, 1e-14);
  EXPECT_NEAR(m.second_x - m.first_x * m.first_x / m.area, 4.0 * 6 * 6 * 6 / 12, 1e-12);
  EXPECT_NEAR(m.second_y - m.first_y * m.first_y / m.area, 6.0 * 4 * 4 * 4 / 12, 1e-12);
  // Inside, at a side, at an end and in a corner; all else is one of these turned round.
  const CellShape<double>& corner = *cells.shape(0);
  EXPECT_DOUBLE_EQ(corner.area, 2.25);
  EXPECT_DOUBLE_EQ(corner.centroid_x, -0.25);
  EXPECT_DOUBLE_EQ(corner.moment_x, 1.5 * 1.5 * 1.5 * 1.5 / 12);
  EXPECT_EQ(cells.shapes().size(), 9U);
}

TEST(LatticeCells, FillANotchedBodyExactly) {
  const LatticeBody body = lattice_body(test::notched, d);
  ASSERT_EQ(body.positions.size(), static_cast<std::size_t>(test::notched_count));
  const LatticeCells cells(body.positions, body.is_held, d, false);
  const Moments m = moments(cells, body.positions);
  EXPECT_NEAR(m.area, test::notched_count, 1e-12);
  // Quadrants go to cells beside them where they stand, so the first moments are exact too.
  double x = 0, y = 0;
  for (const Vector& p : body.positions) {
    x += (p.x - body.positions[0].x) / d;
    y += (p.y - body.positions[0].y) / d;
  }
  EXPECT_NEAR(m.first_x, x, 1e-11);
  EXPECT_NEAR(m.first_y, y, 1e-11);
}

// The quadrant in a re-entrant corner lies beside two cells and belongs to both.
TEST(LatticeCells, ShareTheQuadrantInAReentrantCorner) {
  const LatticeCells cells = cells_of({"##..", "##..", "####", "####"});
  // Columns of 4, 4, 2, 2 particles; south-west corners of the cells: 0, 1, 2 in the first column.
  EXPECT_DOUBLE_EQ(cells.shape(0)->area, 1.5 * 1.5);
  EXPECT_DOUBLE_EQ(cells.shape(1)->area, 0.5 * 1.0 + 1.0 + 0.25 + 0.125);
  EXPECT_EQ(cells.shape(3), nullptr);
  EXPECT_EQ(cells.cell_count(), 5);
}

TEST(LatticeCells, KnowTheirNeighbours) {
  const LatticeCells cells = cells_of({"..##", "####", "####"});
  EXPECT_EQ(cells.east_of(0), 2);
  EXPECT_EQ(cells.east_of(3), 5);
  EXPECT_EQ(cells.west_of(6), -1);
  EXPECT_EQ(cells.east_of(6), 9);
  EXPECT_EQ(cells.west_of(9), 6);
}

TEST(LatticeCells, LeaveOutWhatIsHeldAltogether) {
  const std::vector<std::string> beam{"HHH....", "HHH....", "HH#####", "HH#####", "HHH....", "HHH...."};
  const LatticeCells cells = cells_of(beam);
  // The held blocks above and below are left out; those that touch the beam are not.
  EXPECT_EQ(cells.shape(0), nullptr);
  EXPECT_NE(cells.shape(7), nullptr);
}

// Ideally clamped, the elastic body ends midway between held and free particles: what is left is the free part.
TEST(LatticeCells, EndAtTheEdgeOfAnIdealClamp) {
  const std::vector<std::string> drawing{"HH#####HH", "HH#####HH", "HH#####HH"};
  const LatticeBody body = lattice_body(drawing, d);
  const LatticeCells cells(body.positions, body.is_held, d, true);
  double area = 0, inertia = 0;
  for (std::size_t k = 0; k < cells.particle_count(); ++k)
    if (const CellShape<double>* s = cells.shape(static_cast<std::int32_t>(k))) {
      area += s->area;
      const double y = body.positions[k].y / d + 0.5 + s->centroid_y - 1.0;
      inertia += s->moment_y + s->area * y * y;
    }
  EXPECT_NEAR(area, 15.0, 1e-13);
  EXPECT_NEAR(inertia, 5.0 * 27 / 12, 1e-13);
  const CellShape<double>& left = *cells.shape(3);  // from the second column to the third, below
  EXPECT_DOUBLE_EQ(left.inverse_width_x, 2.0);
  EXPECT_DOUBLE_EQ(left.inverse_width_y, 1.0);
  EXPECT_DOUBLE_EQ(left.area, 0.75);
  EXPECT_DOUBLE_EQ(left.centroid_x, 0.0);  // in the middle of the half that is left
  EXPECT_DOUBLE_EQ(left.moment_x, 1.5 * 0.125 / 12);
}

LatticeBody body_of(const std::vector<ColumnStretch>& columns) {
  LatticeBody body;
  double x = 0;
  for (const ColumnStretch& stretch : columns)
    for (std::int64_t column = 0; column < stretch.columns; ++column, ++x)
      for (std::int64_t row = 0; row < stretch.rows(); ++row) {
        body.positions.push_back(d * Vector{x, static_cast<double>(stretch.lowest_row + row)});
        body.is_held.push_back(stretch.is_held[static_cast<std::size_t>(row)]);
      }
  return body;
}

void expect_same_shape(const CellShape<double>* one, const CellShape<double>* other) {
  ASSERT_EQ(one == nullptr, other == nullptr);
  if (one == nullptr) return;
  EXPECT_TRUE(test::same_bits(one->area, other->area));
  EXPECT_TRUE(test::same_bits(one->centroid_x, other->centroid_x));
  EXPECT_TRUE(test::same_bits(one->centroid_y, other->centroid_y));
  EXPECT_TRUE(test::same_bits(one->moment_x, other->moment_x));
  EXPECT_TRUE(test::same_bits(one->moment_y, other->moment_y));
  EXPECT_TRUE(test::same_bits(one->inverse_width_x, other->inverse_width_x));
  EXPECT_TRUE(test::same_bits(one->inverse_width_y, other->inverse_width_y));
}

/// Every particle's by `columns` as if all were looked at.
void expect_cells_of_all(const std::vector<ColumnStretch>& columns, bool held_at_edge) {
  const LatticeBody body = body_of(columns);
  const LatticeCells expected(body.positions, body.is_held, d, held_at_edge), cells(columns, held_at_edge);
  ASSERT_EQ(cells.particle_count(), expected.particle_count());
  EXPECT_EQ(cells.cell_count(), expected.cell_count());
  ASSERT_EQ(cells.shapes().size(), expected.shapes().size());
  for (std::size_t s = 0; s < cells.shapes().size(); ++s) expect_same_shape(&cells.shapes()[s], &expected.shapes()[s]);
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(cells.particle_count()); ++k) {
    SCOPED_TRACE(k);
    EXPECT_EQ(cells.east_of(k), expected.east_of(k));
    EXPECT_EQ(cells.west_of(k), expected.west_of(k));
    expect_same_shape(cells.shape(k), expected.shape(k));
  }
}

// Any three of these stretches side by side meet in all kinds of corners; of 1 to 9 columns nothing to much is left
// out.
TEST(LatticeCells, OfStretchesAreThoseOfAllTheirColumns) {
  const std::vector<ColumnStretch> kinds{{0, 0, {0, 0, 0, 0}},
                                         {0, -2, {1, 1, 0, 0, 0, 0, 1, 1}},
                                         {0, 0, {1, 1, 1, 1}},
                                         {0, -1, {0, 0, 0, 1}},
                                         {0, 1, {0, 0, 0, 0, 0, 0}}};
  for (const bool held_at_edge : {false, true})
    for (const ColumnStretch& left : kinds)
      for (const ColumnStretch& middle : kinds)
        for (const ColumnStretch& right : kinds)
          for (const auto& [a, b, c] : {std::array{2, 9, 3}, {4, 2, 5}, {5, 4, 6}, {6, 2, 4}, {7, 5, 2}, {3, 3, 8}}) {
            std::vector<ColumnStretch> columns{left, middle, right};
            columns[0].columns = a;
            columns[1].columns = b;
            columns[2].columns = c;
            SCOPED_TRACE(std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c));
            expect_cells_of_all(columns, held_at_edge);
            if (HasFailure()) return;
          }
}

TEST(LatticeCells, OfStretchesAreKeptOnceForAlikeColumns) {
  const std::vector<char> clamp{1, 1, 0, 0, 0, 1, 1}, free{0, 0, 0};
  const std::vector<ColumnStretch> longer{{50, -2, clamp}, {7000, 0, free}, {50, -2, clamp}},
      shorter{{4, -2, clamp}, {4, 0, free}, {4, -2, clamp}};
  EXPECT_EQ(LatticeCells(longer, false).table_size(), LatticeCells(shorter, false).particle_count());
  expect_cells_of_all(longer, false);
  expect_cells_of_all(longer, true);
  expect_cells_of_all({{1, -2, clamp}, {30, 0, free}, {1, -2, clamp}}, false);
}

TEST(LatticeCells, RefuseWhatIsNoLattice) {
  const std::vector<char> free(4, 0);
  const auto make = [&](const std::vector<Vector>& positions) { LatticeCells(positions, free, 1.0, false); };
  EXPECT_NO_THROW(make({{0, 0}, {0, 1}, {1, 0}, {1, 1}}));
  EXPECT_THROW(make({{0, 0}, {0, 1}, {1, 0}, {1, 1.1}}), std::invalid_argument);
  EXPECT_THROW(make({{0, 0}, {1, 0}, {0, 1}, {1, 1}}), std::invalid_argument);  // row by row
  EXPECT_THROW(make({{0, 0}, {0, 1}, {1, 0}, {2, 0}}), std::invalid_argument);  // a single row
}

}  // namespace
}  // namespace sphdrop
