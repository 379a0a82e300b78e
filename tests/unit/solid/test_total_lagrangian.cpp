#include <gtest/gtest.h>

#include <cmath>

#include "solid/total_lagrangian/total_lagrangian_sweep.hpp"
#include "tests/support/random_numbers.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/unit/solid/lattice_body.hpp"

namespace sphdrop {
namespace {

using test::lattice_body;
constexpr double d = 2.5e-5, density = 1000.0;
const std::vector<std::string> block(7, std::string(12, '#'));

template <class Law>
AnyTotalLagrangianMaterial material(double viscous_time = 0) {
  TotalLagrangianMaterial<Law> m;
  m.law.moduli = LameModuli(ElasticMaterial{density, 6e6, 0.3});
  m.density = density;
  m.viscous_time = viscous_time;
  return m;
}

/// Particles of which `present` says 1: owned, 2: a ghost, 0: not here.
void fill(SolidParticles& solid, const std::vector<Vector>& rest, const std::vector<int>& present) {
  std::vector<std::size_t> here;
  for (std::size_t k = 0; k < rest.size(); ++k)
    if (present[k] != 0) here.push_back(k);
  solid.resize(here.size());
  for (std::size_t row = 0; row < here.size(); ++row) {
    solid.id[row] = static_cast<std::int64_t>(here[row]);
    solid.mass[row] = density * d * d;
    solid.reference_position.set(row, rest[here[row]]);
    solid.position.set(row, rest[here[row]]);
    solid.velocity.set(row, {});
    auto& ranges = present[here[row]] == 1 ? solid.owned : solid.ghosts;
    const auto r = static_cast<std::int32_t>(row);
    if (!ranges.empty() && ranges.back().end == r)
      ++ranges.back().end;
    else
      ranges.push_back({r, r + 1});
  }
}

template <class F>
void place(SolidParticles& solid, F&& position) {
  for (std::size_t row = 0; row < solid.size(); ++row)
    solid.position.set(row, position(solid.reference_position.at(row)));
}

void evaluate(TotalLagrangianSweep& sweep, SolidParticles& solid) {
  sweep.deform(solid, TotalLagrangianSweep::Blocks::without_ghosts);
  sweep.deform(solid, TotalLagrangianSweep::Blocks::with_ghosts);
  sweep.accelerate(solid);
}

double energy(TotalLagrangianSweep& sweep, SolidParticles& solid) {
  evaluate(sweep, solid);
  double sum = 0;
  solid.for_each_owned([&](std::size_t row) { sum += sweep.energy(solid, static_cast<std::int32_t>(row)); });
  return sum;
}

struct Body {
  explicit Body(const AnyTotalLagrangianMaterial& m) : sweep(m, CubicSpline(1.2 * d)) {
    const auto rest = lattice_body(block, d).positions;
    fill(solid, rest, std::vector<int>(rest.size(), 1));
    sweep.relist(solid);
  }
  SolidParticles solid;
  TotalLagrangianSweep sweep;
};

void disturb(SolidParticles& solid) {
  test::RandomNumbers random(11);
  place(solid, [&](Vector x) { return x + 0.1 * d * random.in_box({-1, -1}, {1, 1}); });
}

template <class Law>
class TotalLagrangian : public testing::Test {};
using Laws = testing::Types<StVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(TotalLagrangian, Laws);

TYPED_TEST(TotalLagrangian, ForcesAreMinusTheGradientOfTheEnergy) {
  Body body(material<TypeParam>());
  disturb(body.solid);
  evaluate(body.sweep, body.solid);
  SolidParticles& s = body.solid;
  double scale = 0;
  for (std::size_t row = 0; row < s.size(); ++row)
    scale = std::max(scale, s.mass[row] * length(s.acceleration.at(row)));
  for (const std::size_t row : {0U, 3U, 40U, 83U}) {
    evaluate(body.sweep, s);
    const double force = s.mass[row] * s.acceleration.x[row];
    const double at = s.position.x[row], step = 1e-3 * d;
    const auto energy_at = [&](double offset) {
      s.position.x[row] = at + offset;
      const double e = energy(body.sweep, s);
      s.position.x[row] = at;
      return e;
    };
    const double slope =
        (8 * (energy_at(step) - energy_at(-step)) - (energy_at(2 * step) - energy_at(-2 * step))) / (12 * step);
    EXPECT_NEAR(force, -slope, 1e-7 * scale) << row;
  }
}

TYPED_TEST(TotalLagrangian, ForcesHaveNoSumAndNoTorque) {
  Body body(material<TypeParam>());
  disturb(body.solid);
  evaluate(body.sweep, body.solid);
  const SolidParticles& s = body.solid;
  Vector sum;
  double torque = 0, scale = 0;
  for (std::size_t row = 0; row < s.size(); ++row) {
    sum += s.acceleration.at(row);
    torque += cross(s.position.at(row), s.acceleration.at(row));
    scale += length(s.acceleration.at(row));
  }
  EXPECT_LT(length(sum), 1e-14 * scale);
  EXPECT_LT(std::abs(torque), 1e-14 * scale * 12 * d);
}

// Linear fields are exact at the free surface too; a rotation by 1 rad is no strain.
TYPED_TEST(TotalLagrangian, ReproducesLinearFieldsAndHeedsNoRotation) {
  Body body(material<TypeParam>());
  const PlaneTensor<double> f{1.1, 0.05, -0.2, 0.93};
  place(body.solid, [&](Vector x) { return Vector{f.xx * x.x + f.xy * x.y, f.yx * x.x + f.yy * x.y}; });
  evaluate(body.sweep, body.solid);
  body.sweep.complete(body.solid);
  TypeParam law;
  law.moduli = LameModuli(ElasticMaterial{density, 6e6, 0.3});
  const CauchyStress exact = cauchy_stress(law, f);
  for (const std::size_t row : {0U, 6U, 40U}) {
    EXPECT_NEAR(body.solid.stress.xy[row], exact.xy, 1e-12 * 6e6);
    EXPECT_NEAR(body.solid.pressure[row], exact.pressure(), 1e-12 * 6e6);
    EXPECT_NEAR(body.solid.density[row], density / determinant(f), 1e-11 * density);
  }
  const double c = std::cos(1.0), s = std::sin(1.0);
  place(body.solid, [&](Vector x) { return Vector{c * x.x - s * x.y, s * x.x + c * x.y}; });
  evaluate(body.sweep, body.solid);
  const double scale = 6e6 / (density * d);
  for (std::size_t row = 0; row < body.solid.size(); ++row)
    EXPECT_LT(length(body.solid.acceleration.at(row)), 1e-12 * scale);
}

TYPED_TEST(TotalLagrangian, DoesNotDependOnWhereTheBodyIsCut) {
  const auto rest = lattice_body(test::notched, d).positions;
  test::RandomNumbers random(12);
  std::vector<Vector> away;
  for (std::size_t k = 0; k < rest.size(); ++k) away.push_back(0.1 * d * random.in_box({-1, -1}, {1, 1}));
  const auto accelerations = [&](const std::vector<int>& present) {
    SolidParticles solid;
    fill(solid, rest, present);
    TotalLagrangianSweep sweep(material<TypeParam>(1e-8), CubicSpline(1.2 * d));
    sweep.relist(solid);
    const auto move = [&](const std::vector<RowRange>& ranges) {
      for (const RowRange& range : ranges)
        for (std::int32_t k = range.begin; k < range.end; ++k) {
          const auto row = static_cast<std::size_t>(k), id = static_cast<std::size_t>(solid.id[row]);
          solid.position.set(row, rest[id] + away[id]);
          solid.velocity.set(row, (1.0 / d) * away[id]);
        }
    };
    move(solid.owned);
    sweep.deform(solid, TotalLagrangianSweep::Blocks::without_ghosts);
    move(solid.ghosts);
    sweep.deform(solid, TotalLagrangianSweep::Blocks::with_ghosts);
    sweep.accelerate(solid);
    std::vector<Vector> result(rest.size(), Vector{NAN, NAN});
    solid.for_each_owned(
        [&](std::size_t row) { result[static_cast<std::size_t>(solid.id[row])] = solid.acceleration.at(row); });
    return result;
  };
  const auto whole = accelerations(std::vector<int>(rest.size(), 1));
  for (int trial = 0; trial < 10; ++trial) {
    const Vector normal = random.in_box({-1, -1}, {1, 1});
    const double offset = random.between(0.2, 0.8) * dot(normal, rest.back());
    std::vector<int> present(rest.size(), 0);
    for (std::size_t k = 0; k < rest.size(); ++k)
      present[k] = (trial < 7 ? dot(normal, rest[k]) < offset : random.between(0, 1) < 0.3) ? 1 : 0;
    for (std::size_t k = 0; k < rest.size(); ++k)
      for (std::size_t j = 0; j < rest.size() && present[k] == 0; ++j)
        if (present[j] == 1 && length(rest[k] - rest[j]) < 4.8 * d) present[k] = 2;
    const auto part = accelerations(present);
    for (std::size_t k = 0; k < rest.size(); ++k) {
      if (present[k] != 1) continue;
      EXPECT_TRUE(test::same_bits(part[k].x, whole[k].x)) << trial << ": " << k;
      EXPECT_TRUE(test::same_bits(part[k].y, whole[k].y)) << trial << ": " << k;
    }
  }
}

TEST(TotalLagrangianSweep, NamesTheFirstRowThatIsTurnedInsideOut) {
  Body body(material<StVenantKirchhoff>());
  evaluate(body.sweep, body.solid);
  EXPECT_FALSE(body.sweep.inverted(body.solid));
  place(body.solid, [](Vector x) { return Vector{-x.x, x.y}; });
  evaluate(body.sweep, body.solid);
  ASSERT_TRUE(body.sweep.inverted(body.solid));
  EXPECT_EQ(body.sweep.inverted(body.solid)->row, 0);
  EXPECT_NEAR(body.sweep.inverted(body.solid)->determinant, -1.0, 1e-12);
}

}  // namespace
}  // namespace sphdrop
