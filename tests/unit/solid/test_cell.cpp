#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "solid/cells/cell.hpp"
#include "tests/support/random_numbers.hpp"

namespace sphdrop {
namespace {

using Corners = CellCorners<double>;
using Shape = CellShape<double>;
constexpr double d = 2.5e-5;

constexpr Shape interior{1.0, 0, 0, 1.0 / 12, 1.0 / 12, 1, 1};
// An arbitrary one, without any symmetry, and one that ends at an ideal clamp's edge.
constexpr Shape odd{1.375, 0.2, -0.13, 0.19, 0.11, 1, 1};
constexpr Shape clamped{0.75, 0.05, 0.25, 0.015, 0.14, 2, 1};

template <class Law>
CellMaterial<Law> material(double damping_time = 0) {
  CellMaterial<Law> m;
  const ElasticMaterial rubber{1000.0, 6e6, 0.3};
  m.law.moduli = LameModuli(rubber);
  m.bending_modulus = 6e6 / (1 - 0.09);
  m.spacing = d;
  m.damping_time = damping_time;
  return m;
}

std::array<double*, 8> numbers(Corners& c) {
  return {&c.sw.x, &c.sw.y, &c.se.x, &c.se.y, &c.nw.x, &c.nw.y, &c.ne.x, &c.ne.y};
}

/// The corners of the undeformed cell under x -> F x.
Corners mapped(const PlaneTensor<double>& f, double edge_of_clamp = 0) {
  const auto place = [&](double x, double y) {
    return PlaneVector<double>{f.xx * x + f.xy * y - edge_of_clamp, f.yx * x + f.yy * y};
  };
  return {place(0, 0), place(d, 0), place(0, d), place(d, d)};
}

Corners random_corners(test::RandomNumbers& random, double amplitude) {
  Corners corners = mapped({1, 0, 0, 1});
  for (double* number : numbers(corners)) *number += random.between(-amplitude, amplitude) * d;
  return corners;
}

template <class Law>
double energy(const CellMaterial<Law>& m, const Shape& shape, const Corners& corners) {
  return cell_energy(m, shape, cell_strain(shape, corners, 1 / d));
}

template <class Law>
Corners forces(const CellMaterial<Law>& m, const Shape& shape, const Corners& corners) {
  return elastic_forces(m, shape, cell_strain(shape, corners, 1 / d));
}

double largest(Corners c) {
  double result = 0;
  for (const double* number : numbers(c)) result = std::max(result, std::abs(*number));
  return result;
}

template <class Law>
class Cell : public testing::Test {};
using Laws = testing::Types<StVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(Cell, Laws);

TYPED_TEST(Cell, ForcesAreMinusTheGradientOfTheEnergy) {
  const auto m = material<TypeParam>();
  test::RandomNumbers random(1);
  for (const Shape& shape : {interior, odd, clamped})
    for (int trial = 0; trial < 10; ++trial) {
      Corners corners = random_corners(random, 0.15);
      Corners f = forces(m, shape, corners);
      const double scale = largest(f);
      for (std::size_t k = 0; k < 8; ++k) {
        double& number = *numbers(corners)[k];
        const double at = number;
        const auto energy_at = [&](double offset) {
          number = at + offset * d;
          const double e = energy(m, shape, corners);
          number = at;
          return e;
        };
        const double step = 1e-3;  // of fourth order
        const double slope =
            (8 * (energy_at(step) - energy_at(-step)) - (energy_at(2 * step) - energy_at(-2 * step))) / (12 * step * d);
        EXPECT_NEAR(*numbers(f)[k], -slope, 1e-7 * scale) << "number " << k;
      }
    }
}

TYPED_TEST(Cell, ForcesHaveNoSumAndNoTorque) {
  const auto m = material<TypeParam>();
  test::RandomNumbers random(2);
  for (const Shape& shape : {interior, odd}) {
    const Corners c = random_corners(random, 0.2);
    const Corners f = forces(m, shape, c);
    const double scale = largest(f);
    EXPECT_NEAR(f.sw.x + f.se.x + f.nw.x + f.ne.x, 0, 1e-15 * scale);
    EXPECT_NEAR(f.sw.y + f.se.y + f.nw.y + f.ne.y, 0, 1e-15 * scale);
    const auto torque = [](const PlaneVector<double>& x, const PlaneVector<double>& g) {
      return x.x * g.y - x.y * g.x;
    };
    EXPECT_NEAR(torque(c.sw, f.sw) + torque(c.se, f.se) + torque(c.nw, f.nw) + torque(c.ne, f.ne), 0,
                2e-15 * scale * d);
  }
}

TYPED_TEST(Cell, ARigidRotationMakesNoForce) {
  const auto m = material<TypeParam>();
  const double c = std::cos(1.0), s = std::sin(1.0);
  for (const Shape& shape : {interior, odd}) {
    const Corners turned = mapped({c, -s, s, c});
    EXPECT_LT(largest(forces(m, shape, turned)), 1e-12 * m.bending_modulus * d);
    EXPECT_LT(energy(m, shape, turned), 1e-24 * m.bending_modulus * d * d);
  }
}

// A linear field: the stress is that of the law, and the corners share the load of the faces evenly.
TYPED_TEST(Cell, PassesThePatchTest) {
  const auto m = material<TypeParam>();
  const PlaneTensor<double> f{1.1, 0.05, -0.2, 0.93};
  const PlaneTensor<double> p = m.law.stress(f);
  const CellStrain<double> strain = cell_strain(odd, mapped(f), 1 / d);
  EXPECT_NEAR(strain.gradient.xy, f.xy, 1e-14);
  EXPECT_NEAR(strain.gradient.yx, f.yx, 1e-14);
  EXPECT_NEAR(m.law.stress(strain.gradient).xy, p.xy, 1e-13 * m.bending_modulus);
  const Corners g = forces(m, interior, mapped(f));
  EXPECT_NEAR(g.ne.x, -0.5 * d * (p.xx + p.xy), 1e-13 * m.bending_modulus * d);
  EXPECT_NEAR(g.ne.y, -0.5 * d * (p.yx + p.yy), 1e-13 * m.bending_modulus * d);
  EXPECT_NEAR(g.nw.x, 0.5 * d * (p.xx - p.xy), 1e-13 * m.bending_modulus * d);
  EXPECT_NEAR(energy(m, odd, mapped(f)), odd.area * d * d * m.law.energy_density(f), 1e-13 * m.bending_modulus * d * d);
}

// Pure bending by a curvature k: a beam's energy E' I k^2/2, though the corners alone bend a bilinear field with shear.
TYPED_TEST(Cell, BendsAsABeam) {
  const auto m = material<TypeParam>();
  const double k = 1e-4 / d;
  Corners corners = mapped({1, 0, 0, 1}, 0.5 * d);
  for (auto [corner, x, y] :
       {std::tuple{&corners.sw, -0.5, 0.0}, {&corners.se, 0.5, 0.0}, {&corners.nw, -0.5, 1.0}, {&corners.ne, 0.5, 1.0}})
    corner->x -= k * x * (y - 0.5) * d * d;
  const double beam = 0.5 * m.bending_modulus * (1.0 / 12) * d * d * d * d * k * k;
  EXPECT_NEAR(energy(m, interior, corners) / beam, 1.0, 1e-6);
}

// Held corners count as if they stood at the clamp's edge, half a spacing nearer.
TYPED_TEST(Cell, AnIdealClampsCellEndsAtItsEdge) {
  const double stretch = 0.01;
  Corners corners = mapped({1, 0, 0, 1});
  corners.se.x += stretch * d;
  corners.ne.x += stretch * d;
  EXPECT_NEAR(cell_strain(clamped, corners, 1 / d).gradient.xx, 1 + 2 * stretch, 1e-14);
  EXPECT_NEAR(cell_strain(interior, corners, 1 / d).gradient.xx, 1 + stretch, 1e-14);
  EXPECT_NEAR(cell_strain(clamped, corners, 1 / d).gradient.yy, 1, 1e-14);
}

TYPED_TEST(Cell, WhatIsNoCellHasNoForcesWhereverItsCornersAre) {
  const auto m = material<TypeParam>();
  for (Corners corners : {Corners{}, mapped({0, 0, 0, 0}), mapped({1e6, 3e9, -1e11, 7})}) {
    const Corners f = forces(m, Shape{}, corners);
    EXPECT_EQ(largest(f), 0.0);
  }
}

// The heat is the power lost by the viscous forces; none is made by a rigid motion.
TYPED_TEST(Cell, DampingTakesThePowerThatItHeatsWith) {
  const auto m = material<TypeParam>(1e-6);
  test::RandomNumbers random(3);
  for (const Shape& shape : {interior, odd, clamped}) {
    const Corners corners = random_corners(random, 0.1);
    Corners velocity;
    for (double* number : numbers(velocity)) *number = random.between(-1, 1);
    const auto strain = cell_strain(shape, corners, 1 / d);
    const auto rate = cell_strain_rate(shape, strain, velocity, 1 / d);
    Corners damped = damped_forces(m, shape, strain, rate), elastic = elastic_forces(m, shape, strain);
    double power = 0;
    for (std::size_t k = 0; k < 8; ++k) power += (*numbers(damped)[k] - *numbers(elastic)[k]) * *numbers(velocity)[k];
    EXPECT_NEAR(cell_heating(m, shape, strain, rate) / -power, 1.0, 1e-12);
    EXPECT_GT(power, -1e3);
    EXPECT_LT(power, 0);

    // The strain's rate is that of the strain.
    const double step = 1e-6 * d;
    Corners after = corners, before = corners;
    for (std::size_t k = 0; k < 8; ++k) {
      *numbers(after)[k] += step * *numbers(velocity)[k];
      *numbers(before)[k] -= step * *numbers(velocity)[k];
    }
    const auto strain_after = cell_strain(shape, after, 1 / d), strain_before = cell_strain(shape, before, 1 / d);
    EXPECT_NEAR((strain_after.bending_x - strain_before.bending_x) / (2 * step), rate.bending_x, 1e-8 / d);
    EXPECT_NEAR((strain_after.bending_y - strain_before.bending_y) / (2 * step), rate.bending_y, 1e-8 / d);
    EXPECT_NEAR((strain_after.gradient.xy - strain_before.gradient.xy) / (2 * step), rate.gradient.xy, 1e-8 / d);
  }
  const Corners turned = mapped({0.6, -0.8, 0.8, 0.6});
  const auto spin = [](const PlaneVector<double>& x) { return PlaneVector<double>{-x.y + 0.3, x.x}; };
  const Corners velocity{spin(turned.sw), spin(turned.se), spin(turned.nw), spin(turned.ne)};
  const auto strain = cell_strain(odd, turned, 1 / d);
  EXPECT_LT(largest(damped_forces(m, odd, strain, cell_strain_rate(odd, strain, velocity, 1 / d))),
            1e-12 * m.bending_modulus * d);
}

}  // namespace
}  // namespace sphdrop
