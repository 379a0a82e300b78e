// The sweep against the sum over cells, one by one; wherever the body is cut.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "solid/cells/cell_sweep.hpp"
#include "tests/support/random_numbers.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/unit/solid/lattice_body.hpp"

namespace sphdrop {
namespace {

using test::lattice_body;
using test::LatticeBody;
constexpr double d = 2.5e-5, density = 1000.0;
constexpr std::int64_t first_id = 100;

template <class Law>
CellMaterial<Law> material(double damping_time) {
  CellMaterial<Law> m;
  m.law.moduli = LameModuli(ElasticMaterial{density, 6e6, 0.3});
  m.bending_modulus = 6e6 / 0.91;
  m.spacing = d;
  m.damping_time = damping_time;
  return m;
}

struct Body {
  LatticeBody rest;
  LatticeCells cells;
  std::vector<Vector> positions, velocities;

  explicit Body(const std::vector<std::string>& drawing, double amplitude = 0.1)
      : rest(lattice_body(drawing, d)), cells(rest.positions, rest.is_held, d, false) {
    test::RandomNumbers random(5);
    for (const Vector& p : rest.positions) {
      const Vector away = amplitude * d * random.in_box({-1, -1}, {1, 1});
      positions.push_back(p + away);
      velocities.push_back(random.in_box({-1, -1}, {1, 1}));
    }
  }
};

/// The particles of `present`: 1 owned, 2 ghost, 0 not here.
void fill(SolidParticles& solid, const Body& body, const std::vector<int>& present) {
  std::vector<std::size_t> here;
  for (std::size_t k = 0; k < present.size(); ++k)
    if (present[k] != 0) here.push_back(k);
  solid.resize(here.size());
  for (std::size_t row = 0; row < here.size(); ++row) {
    const std::size_t k = here[row];
    solid.id[row] = first_id + static_cast<std::int64_t>(k);
    solid.mass[row] = density * d * d * (1.0 + 0.01 * static_cast<double>(k % 7));
    solid.position.set(row, body.positions[k]);
    solid.velocity.set(row, body.velocities[k]);
    auto& ranges = present[k] == 1 ? solid.owned : solid.ghosts;
    const auto r = static_cast<std::int32_t>(row);
    if (!ranges.empty() && ranges.back().end == r)
      ++ranges.back().end;
    else
      ranges.push_back({r, r + 1});
  }
}

struct Result {
  double ax = NAN, ay = NAN, heat = NAN, sxx = NAN, pressure = NAN, rho = NAN;
};

std::vector<Result> swept(const Body& body, const AnyCellMaterial& m, const std::vector<int>& present) {
  SolidParticles solid;
  fill(solid, body, present);
  CellSweep sweep(m);
  sweep.set_mesh(CellMesh(solid, body.cells, first_id));
  // While the halo is under way ghosts are anywhere.
  for (const RowRange& range : solid.ghosts)
    for (std::int32_t row = range.begin; row < range.end; ++row)
      solid.position.set(static_cast<std::size_t>(row), {0, 0});
  sweep.sweep(solid, CellSweep::Cells::without_ghosts);
  for (const RowRange& range : solid.ghosts)
    for (std::int32_t k = range.begin; k < range.end; ++k) {
      const auto row = static_cast<std::size_t>(k);
      solid.position.set(row, body.positions[static_cast<std::size_t>(solid.id[row] - first_id)]);
    }
  sweep.sweep(solid, CellSweep::Cells::with_ghosts);
  sweep.accelerate(solid);
  sweep.complete(solid, density);
  std::vector<Result> result(body.positions.size());
  solid.for_each_owned([&](std::size_t row) {
    result[static_cast<std::size_t>(solid.id[row] - first_id)] = {
        solid.acceleration.x[row], solid.acceleration.y[row], solid.dissipation_rate[row],
        solid.stress.xx[row],      solid.pressure[row],       solid.density[row]};
  });
  return result;
}

template <class Law>
class Sweep : public testing::Test {};
using Laws = testing::Types<StVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(Sweep, Laws);

TYPED_TEST(Sweep, IsTheSumOverTheCells) {
  const Body body(test::notched);
  const auto m = material<TypeParam>(2e-7);
  const auto count = body.positions.size();
  std::vector<Vector> force(count);
  std::vector<double> heat(count), stress(count), determinants(count), cells(count);
  double energy = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const CellShape<double>* shape = body.cells.shape(static_cast<std::int32_t>(k));
    if (shape == nullptr) continue;
    const auto east = static_cast<std::size_t>(body.cells.east_of(static_cast<std::int32_t>(k)));
    const std::array<std::size_t, 4> corner{k, east, k + 1, east + 1};
    const auto at = [&](const std::vector<Vector>& values) {
      const auto one = [&](std::size_t c) { return PlaneVector<double>{values[corner[c]].x, values[corner[c]].y}; };
      return CellCorners<double>{one(0), one(1), one(2), one(3)};
    };
    const auto strain = cell_strain(*shape, at(body.positions), 1 / d);
    const auto rate = cell_strain_rate(*shape, strain, at(body.velocities), 1 / d);
    const auto f = damped_forces(m, *shape, strain, rate);
    const std::array<Vector, 4> forces{Vector{f.sw.x, f.sw.y}, {f.se.x, f.se.y}, {f.nw.x, f.nw.y}, {f.ne.x, f.ne.y}};
    for (std::size_t c = 0; c < 4; ++c) {
      force[corner[c]] += forces[c];
      heat[corner[c]] += 0.25 * cell_heating(m, *shape, strain, rate);
      stress[corner[c]] += cauchy_stress(m.law, strain.gradient).xx;
      determinants[corner[c]] += determinant(strain.gradient);
      cells[corner[c]] += 1;
    }
    energy += cell_energy(m, *shape, strain);
  }
  const std::vector<int> all(count, 1);
  const auto result = swept(body, m, all);
  SolidParticles solid;
  fill(solid, body, all);
  CellSweep sweep(m);
  sweep.set_mesh(CellMesh(solid, body.cells, first_id));
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double mass = solid.mass[k];
    EXPECT_NEAR(result[k].ax * mass, force[k].x, 1e-13 * 6e6 * d) << k;
    EXPECT_NEAR(result[k].ay * mass, force[k].y, 1e-13 * 6e6 * d) << k;
    EXPECT_NEAR(result[k].heat * mass, heat[k], 1e-13 * std::abs(heat[k])) << k;
    EXPECT_NEAR(result[k].sxx, stress[k] / cells[k], 1e-13 * 6e6) << k;
    EXPECT_NEAR(result[k].rho, density * cells[k] / determinants[k], 1e-12 * density) << k;
    if (sweep.mesh().is_cell(static_cast<std::int32_t>(k))) sum += sweep.energy(solid, static_cast<std::int32_t>(k));
  }
  EXPECT_NEAR(sum, energy, 1e-13 * energy);
}

TYPED_TEST(Sweep, DoesNotDependOnWhereTheBodyIsCut) {
  // Long enough for runs of their own: inner cells, cells with ghosts, cells that wait for the halo with them.
  const std::string line(40, '#');
  std::vector<std::string> beam(9, line);
  for (std::size_t row : {0U, 1U, 7U, 8U}) beam[row] = "##########" + std::string(20, '.') + "##########";
  for (const std::vector<std::string>& drawing : {test::notched, beam}) {
    const Body body(drawing);
    for (const double damping_time : {0.0, 2e-7}) {
      const auto m = material<TypeParam>(damping_time);
      const auto whole = swept(body, m, std::vector<int>(body.positions.size(), 1));
      test::RandomNumbers random(6);
      for (int trial = 0; trial < 12; ++trial) {
        // Upright, lying and slanting cuts, and a body dealt out at random.
        const Vector normal = random.in_box({-1, -1}, {1, 1});
        const double offset = random.between(0.2, 0.8) * dot(normal, body.rest.positions.back());
        std::vector<int> present(body.positions.size(), 0);
        for (std::size_t k = 0; k < present.size(); ++k)
          present[k] = (trial < 9 ? dot(normal, body.rest.positions[k]) < offset : random.between(0, 1) < 0.5) ? 1 : 0;
        for (std::size_t k = 0; k < present.size(); ++k)
          for (std::size_t j = 0; j < present.size() && present[k] == 0; ++j)
            if (present[j] == 1 && length(body.rest.positions[k] - body.rest.positions[j]) < 1.5 * d) present[k] = 2;
        const auto part = swept(body, m, present);
        for (std::size_t k = 0; k < present.size(); ++k) {
          if (present[k] != 1) continue;
          EXPECT_TRUE(test::same_bits(part[k].ax, whole[k].ax)) << trial << ": " << k;
          EXPECT_TRUE(test::same_bits(part[k].ay, whole[k].ay)) << trial << ": " << k;
          EXPECT_TRUE(test::same_bits(part[k].heat, whole[k].heat)) << trial << ": " << k;
          EXPECT_TRUE(test::same_bits(part[k].sxx, whole[k].sxx)) << trial << ": " << k;
          EXPECT_TRUE(test::same_bits(part[k].rho, whole[k].rho)) << trial << ": " << k;
        }
      }
    }
  }
}

TEST(CellSweep, NamesTheFirstCellThatIsTurnedInsideOut) {
  Body body(test::notched, 0.0);
  SolidParticles solid;
  CellSweep sweep(material<StVenantKirchhoff>(0));
  fill(solid, body, std::vector<int>(body.positions.size(), 1));
  sweep.set_mesh(CellMesh(solid, body.cells, first_id));
  sweep.sweep(solid, CellSweep::Cells::without_ghosts);
  sweep.sweep(solid, CellSweep::Cells::with_ghosts);
  EXPECT_FALSE(sweep.inverted());
  // The north-east corner of the first cell is pushed through its south-west corner.
  const auto corner = static_cast<std::size_t>(body.cells.east_of(0)) + 1;
  solid.position.set(corner, body.rest.positions[0] - Vector{2 * d, 2 * d});
  sweep.sweep(solid, CellSweep::Cells::without_ghosts);
  sweep.sweep(solid, CellSweep::Cells::with_ghosts);
  ASSERT_TRUE(sweep.inverted());
  EXPECT_EQ(sweep.inverted()->row, 0);
  EXPECT_LT(sweep.inverted()->determinant, 0);
}

}  // namespace
}  // namespace sphdrop
