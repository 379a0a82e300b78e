// What setting up takes: a share's particles and something for each line of them, however many the drop has.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "config/case_file.hpp"
#include "setup/initial_state.hpp"
#include "solid/cells/lattice_cells.hpp"

namespace {

std::size_t allocated = 0;  // bytes, never taken off again

void* counted(std::size_t size) {
  allocated += size;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new[](std::size_t size) {
  return counted(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace sphdrop {
namespace {

class SetUpMemory : public testing::TestWithParam<const char*> {};

// A thousandth of ten million particles, 400 MB: 40 bytes each of the share's.
TEST_P(SetUpMemory, FollowsTheShare) {
  const Case input =
      parse_case_text(std::string("[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n") + GetParam(), "memory.cfg")
          .values;
  const std::size_t before = allocated;
  const InitialState state = build_initial_state(input, {500, 1000});
  const auto taken = static_cast<double>(allocated - before);
  const auto total = static_cast<double>(state.fluid.total);
  ASSERT_GT(total, 5e6);
  EXPECT_LE(std::abs(static_cast<double>(state.fluid.positions.capacity()) - total / 1000), 1);
  EXPECT_LE(std::abs(static_cast<double>(state.fluid.velocities.capacity()) - total / 1000), 1);
  EXPECT_LE(std::abs(static_cast<double>(state.fluid.masses.capacity()) - total / 1000), 1);
  // The solid that some have is of some 10 000 particles.
  EXPECT_LT(taken, 0.025 * 40 * total);
}

INSTANTIATE_TEST_SUITE_P(OfADrop, SetUpMemory,
                         testing::Values("[drop]\ndiameter = 0.089\narrangement = \"rings\"\n",
                                         "[drop]\ndiameter = 0.089\narrangement = \"lattice\"\njitter = 0.1\n",
                                         "[drop]\ndiameter = 0.089\nshape = \"ellipse\"\naspect_ratio = 2\n",
                                         "[drop]\ndiameter = 0.079\nshape = \"square\"\n",
                                         "[drop]\ndiameter = 0.079\nshape = \"square\"\nmaterial = \"rigid\"\n"
                                         "[solid]\nkind = \"rigid_wall\"\nlength = 0.1\n",
                                         "[drop]\ndiameter = 0.089\n[solid]\nkind = \"cantilever\"\nlength = 16e-3\n",
                                         "[[drop]]\ndiameter = 0.07\n[[drop]]\ndiameter = 0.05\ncentre_x = 0.0602\n"));

// Likewise of a beam of five million, whose boundary every process has: 24 bytes each of 41 000 particles, some of them
// several times.
class SetUpMemoryOfABeam : public testing::TestWithParam<const char*> {};

TEST_P(SetUpMemoryOfABeam, FollowsTheShare) {
  const Case input = parse_case_text(
                         "[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n[drop]\nshape = \"none\"\n[solid]\n"
                         "kind = \"cantilever\"\nlength = 0.5\nthickness = 6.25e-3\n" +
                             std::string("formulation = \"") + GetParam() + "\"\n",
                         "memory.cfg")
                         .values;
  const std::size_t before = allocated;
  const InitialState state = build_initial_state(input, {500, 1000});
  const auto taken = static_cast<double>(allocated - before);
  const auto total = static_cast<double>(state.solid.total());
  ASSERT_GT(total, 5e6);
  EXPECT_LE(std::abs(static_cast<double>(state.solid.positions.size()) - total / 1000), 1);
  EXPECT_LT(taken, 0.04 * 49 * total) << taken;
}

INSTANTIATE_TEST_SUITE_P(OfEachFormulation, SetUpMemoryOfABeam,
                         testing::Values("hypoelastic", "total_lagrangian", "cells"));

// Less than a byte for each of five million particles: of the columns eight are kept.
TEST(MemoryOfCells, FollowsTheColumnsThatDiffer) {
  const std::vector<ColumnStretch> columns{{20, -3, std::vector<char>(256, 1)}, {20000, 0, std::vector<char>(250, 0)}};
  const std::size_t before = allocated;
  const LatticeCells cells(columns, false);
  EXPECT_EQ(cells.particle_count(), 20U * 256 + 20000U * 250);
  EXPECT_LT(allocated - before, 1000000U);
  EXPECT_LE(cells.table_size(), 8U * 256);
}

}  // namespace
}  // namespace sphdrop
