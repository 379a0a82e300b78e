#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "particles/fluid_particles.hpp"
#include "particles/solid_particles.hpp"

namespace sphdrop {
namespace {

class ThreeFields : public ParticleSet {
 public:
  ScalarField first{*this, "first", "m", Role::state | Role::ghosted, "a scalar", 4.0};
  VectorField second{*this, "second", "s", Role::derived, "a vector"};
  TensorField third{*this, "third", "Pa", Role::written | Role::state, "a tensor"};
};

TEST(Role, CombinesAndIsAskedFor) {
  constexpr Role roles = Role::state | Role::written;
  EXPECT_TRUE(has(roles, Role::state));
  EXPECT_TRUE(has(roles, Role::written));
  EXPECT_FALSE(has(roles, Role::ghosted));
  EXPECT_FALSE(has(roles, Role::constant));
  EXPECT_FALSE(has(Role::derived, Role::state));
}

TEST(ParticleSet, RegistersFieldsInTheOrderOfDeclaration) {
  ThreeFields set;
  ASSERT_EQ(set.fields().size(), 3u);
  EXPECT_EQ(set.fields()[0], &set.first);
  EXPECT_EQ(set.fields()[1]->name, "second");
  EXPECT_EQ(set.fields()[2]->components, 3);
}

TEST(ParticleSet, ResizesAllColumnsAndKeepsTheirRows) {
  ThreeFields set;
  set.resize(2);
  set.id[1] = 77;
  set.first[1] = 5.0;
  set.second.set(1, {1.0, 2.0});
  set.third.xx[1] = 3.0;
  set.third.yy[1] = 4.0;
  set.third.xy[1] = 6.0;
  set.resize(50);
  EXPECT_EQ(set.size(), 50u);
  for (const Field* field : set.fields())
    for (int c = 0; c < field->components; ++c) EXPECT_EQ(field->columns[static_cast<std::size_t>(c)].size(), 50u);
  EXPECT_EQ(set.id[1], 77);
  EXPECT_EQ(set.first[1], 5.0);
  EXPECT_EQ(set.second.at(1), (Vector{1.0, 2.0}));
  EXPECT_EQ(set.third.columns[0][1], 3.0);
  EXPECT_EQ(set.third.columns[1][1], 4.0);
  EXPECT_EQ(set.third.columns[2][1], 6.0);
  EXPECT_EQ(set.first[49], 0.0);
  EXPECT_EQ(set.first.data()[50], 4.0);  // padding keeps its own value
}

TEST(ParticleSet, FindsColumnsByRole) {
  ThreeFields set;
  const std::vector<Column<double>*> state{&set.first.columns[0], &set.third.xx, &set.third.yy, &set.third.xy};
  EXPECT_EQ(set.columns_with(Role::state), state);
  EXPECT_EQ(set.columns_with(Role::ghosted), (std::vector<Column<double>*>{&set.first.columns[0]}));
  EXPECT_TRUE(set.columns_with(Role::constant).empty());
}

TEST(ParticleSet, WhatIsLeftOutHasNoRowsAndIsNotFound) {
  ThreeFields set;
  set.third.leave_out();
  set.resize(5);
  EXPECT_EQ(set.third.xx.size(), 0u);
  EXPECT_EQ(set.first.columns[0].size(), 5u);
  EXPECT_EQ(set.columns_with(Role::state), (std::vector<Column<double>*>{&set.first.columns[0]}));
}

TEST(ParticleSet, VisitsAndCountsOwnedRows) {
  ThreeFields set;
  set.resize(10);
  set.owned = {{1, 3}, {5, 6}, {8, 10}};
  std::vector<std::size_t> rows;
  set.for_each_owned([&](std::size_t row) { rows.push_back(row); });
  EXPECT_EQ(rows, (std::vector<std::size_t>{1, 2, 5, 8, 9}));
  EXPECT_EQ(set.owned_count(), 5u);
}

template <class Set>
class QuantityTable : public ::testing::Test {};
using Sets = ::testing::Types<FluidParticles, SolidParticles>;
TYPED_TEST_SUITE(QuantityTable, Sets);

TYPED_TEST(QuantityTable, NamesEveryQuantityOnceWithUnitAndDescription) {
  TypeParam set;
  std::set<std::string> names;
  for (const Field* field : set.fields()) {
    EXPECT_TRUE(names.insert(std::string(field->name)).second) << field->name;
    EXPECT_FALSE(field->unit.empty()) << field->name;
    EXPECT_FALSE(field->description.empty()) << field->name;
  }
}

// What the next step starts from: a leap-frog step needs them all, and nothing else survives a checkpoint.
TYPED_TEST(QuantityTable, CarriesWhatALeapFrogStepStartsFrom) {
  TypeParam set;
  const std::vector<Column<double>*> state = set.columns_with(Role::state);
  const auto is_state = [&](const Column<double>& column) {
    return std::find(state.begin(), state.end(), &column) != state.end();
  };
  EXPECT_TRUE(is_state(set.mass.columns[0]));
  EXPECT_TRUE(is_state(set.position.x) && is_state(set.position.y));
  EXPECT_TRUE(is_state(set.staggered_velocity.x) && is_state(set.staggered_velocity.y));
  EXPECT_TRUE(is_state(set.staggered_density.columns[0]));
  EXPECT_TRUE(is_state(set.acceleration.x) && is_state(set.acceleration.y));
  EXPECT_TRUE(is_state(set.density_rate.columns[0]));
  EXPECT_TRUE(is_state(set.dissipated_energy.columns[0]));
  if constexpr (std::is_same_v<TypeParam, SolidParticles>) {
    for (const Column<double>& column : set.staggered_deviatoric_stress.columns) EXPECT_TRUE(is_state(column));
    for (const Column<double>& column : set.deviatoric_stress_rate.columns) EXPECT_TRUE(is_state(column));
    EXPECT_TRUE(is_state(set.is_fixed.columns[0]));
  }
}

// What a neighbour contributes must be there for ghosts too: sent in every step, or once because it never changes.
TYPED_TEST(QuantityTable, SendsToGhostsWhatTheSweepsRead) {
  TypeParam set;
  const auto reaches_ghosts = [](const Field& field) {
    return has(field.roles, Role::ghosted) || has(field.roles, Role::constant);
  };
  EXPECT_TRUE(reaches_ghosts(set.mass));
  EXPECT_TRUE(reaches_ghosts(set.position));
  EXPECT_TRUE(reaches_ghosts(set.velocity));
  EXPECT_TRUE(reaches_ghosts(set.density));
  if constexpr (std::is_same_v<TypeParam, SolidParticles>) {
    EXPECT_TRUE(reaches_ghosts(set.deviatoric_stress));
  }
}

// Rows past the end are loaded by the last vector: far away, massless, and with a density that can be divided by.
TYPED_TEST(QuantityTable, PadsWithParticlesThatContributeNothing) {
  TypeParam set;
  set.resize(3);
  for (std::size_t row = 3; row < 3 + column_padding; ++row) {
    EXPECT_EQ(set.position.x.data()[row], far_away);
    EXPECT_EQ(set.position.y.data()[row], far_away);
    EXPECT_EQ(set.mass.data()[row], 0.0);
    EXPECT_GT(set.density.data()[row], 0.0);
  }
}

}  // namespace
}  // namespace sphdrop
