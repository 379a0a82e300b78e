#include "solid/cells/cell_sweep.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "particles/pack.hpp"

namespace sphdrop {

namespace {

// One number or several: the same code for the body of a run and for its end.
template <class T>
[[gnu::always_inline]] inline T load_as(const double* p) {
  if constexpr (std::is_same_v<T, double>)
    return *p;
  else
    return load(p);
}
template <class T>
[[gnu::always_inline]] inline void store_as(const T& value, double* p) {
  if constexpr (std::is_same_v<T, double>)
    *p = value;
  else
    store(value, p);
}

template <class T>
[[gnu::always_inline]] inline CellCorners<T> load_corners(const double* x, const double* y, std::int32_t row,
                                                          std::int32_t east) {
  const std::int32_t e = row + east;
  return {{load_as<T>(x + row), load_as<T>(y + row)},
          {load_as<T>(x + e), load_as<T>(y + e)},
          {load_as<T>(x + row + 1), load_as<T>(y + row + 1)},
          {load_as<T>(x + e + 1), load_as<T>(y + e + 1)}};
}

template <class T>
[[gnu::always_inline]] inline CellShape<T> load_shape(const std::array<const double*, 7>& columns, std::int32_t row) {
  return {load_as<T>(columns[0] + row), load_as<T>(columns[1] + row), load_as<T>(columns[2] + row),
          load_as<T>(columns[3] + row), load_as<T>(columns[4] + row), load_as<T>(columns[5] + row),
          load_as<T>(columns[6] + row)};
}

template <class T>
[[gnu::always_inline]] inline PlaneVector<T> turned(const PlaneVector<T>& a, double cosine, double sine) {
  return {T(cosine) * a.x - T(sine) * a.y, T(sine) * a.x + T(cosine) * a.y};
}

template <class T>
[[gnu::always_inline]] inline CellCorners<T> turned(const CellCorners<T>& a, double cosine, double sine) {
  return {turned(a.sw, cosine, sine), turned(a.se, cosine, sine), turned(a.nw, cosine, sine),
          turned(a.ne, cosine, sine)};
}

/// The cells of `row` ... `row + width of T`; returns area times J.
template <bool is_damped, bool is_turned, class T, class Law>
[[gnu::always_inline]] inline T compute_cells(const CellMaterial<Law>& material, const LatticeTurn& turn,
                                              double inverse_spacing, const std::array<const double*, 7>& shapes,
                                              const double* x, const double* y, const double* velocity_x,
                                              const double* velocity_y, std::int32_t east, std::int32_t row,
                                              const std::array<double*, 8>& force, double* heating) {
  const CellShape<T> shape = load_shape<T>(shapes, row);
  CellCorners<T> places = load_corners<T>(x, y, row, east);
  if constexpr (is_turned) places = turned(places, turn.cosine, -turn.sine);
  const CellStrain<T> strain = cell_strain(shape, places, inverse_spacing);
  CellCorners<T> forces;
  if constexpr (is_damped) {
    CellCorners<T> velocities = load_corners<T>(velocity_x, velocity_y, row, east);
    if constexpr (is_turned) velocities = turned(velocities, turn.cosine, -turn.sine);
    const CellStrain<T> rate = cell_strain_rate(shape, strain, velocities, inverse_spacing);
    forces = damped_forces(material, shape, strain, rate);
    store_as(cell_heating(material, shape, strain, rate), heating + row);
  } else {
    forces = elastic_forces(material, shape, strain);
  }
  if constexpr (is_turned) forces = turned(forces, turn.cosine, turn.sine);
  store_as(forces.sw.x, force[0] + row);
  store_as(forces.sw.y, force[1] + row);
  store_as(forces.se.x, force[2] + row);
  store_as(forces.se.y, force[3] + row);
  store_as(forces.nw.x, force[4] + row);
  store_as(forces.nw.y, force[5] + row);
  store_as(forces.ne.x, force[6] + row);
  store_as(forces.ne.y, force[7] + row);
  return shape.area * determinant(strain.gradient);
}

std::array<const double*, 7> pointers(const std::array<Column<double>, 7>& columns) {
  std::array<const double*, 7> result;
  for (std::size_t c = 0; c < 7; ++c) result[c] = columns[c].data();
  return result;
}

CellStrain<double> strain_of(const CellMesh& mesh, const SolidParticles& s, const CellMesh::CellRun& run,
                             std::int32_t row, double spacing, const LatticeTurn& turn) {
  CellCorners<double> places = load_corners<double>(s.position.x.data(), s.position.y.data(), row, run.east);
  if (!turn.is_none()) places = turned(places, turn.cosine, -turn.sine);
  return cell_strain(mesh.shape(row), places, 1.0 / spacing);
}

CauchyStress turned(const CauchyStress& s, const LatticeTurn& turn) {
  if (turn.is_none()) return s;
  const double c = turn.cosine, z = turn.sine;
  CauchyStress result = s;
  result.xx = c * c * s.xx - 2.0 * c * z * s.xy + z * z * s.yy;
  result.yy = z * z * s.xx + 2.0 * c * z * s.xy + c * c * s.yy;
  result.xy = c * z * (s.xx - s.yy) + (c * c - z * z) * s.xy;
  return result;
}

}  // namespace

void CellSweep::set_mesh(CellMesh mesh) {
  mesh_ = std::move(mesh);
  // Rows that are no cell act on nobody: zeros, also beyond the ends.
  for (Column<double>& column : force_) {
    column.resize(0);
    column.resize(mesh_.shape_columns()[0].size());
  }
  heating_.resize(0);
  heating_.resize(mesh_.shape_columns()[0].size());
}

double CellSweep::spacing() const {
  return std::visit([](const auto& material) { return material.spacing; }, material_);
}

bool CellSweep::is_damped() const {
  return std::visit([](const auto& material) { return material.damping_time > 0; }, material_);
}

void CellSweep::sweep(const SolidParticles& solid, Cells which) {
  std::visit([&](const auto& material) { sweep_runs(material, solid, which); }, material_);
}

template <class Law>
void CellSweep::sweep_runs(const CellMaterial<Law>& m, const SolidParticles& s, Cells which) {
  const CellMaterial<Law> material = m;
  const double inverse_spacing = 1.0 / material.spacing;
  const std::array<const double*, 7> shapes = pointers(mesh_.shape_columns());
  std::array<double*, 8> force;
  for (std::size_t c = 0; c < 8; ++c) force[c] = force_[c].data();
  double* heating = heating_.data();
  const double *x = s.position.x.data(), *y = s.position.y.data();
  const double *u = s.velocity.x.data(), *v = s.velocity.y.data();
  double least = 0;
  const LatticeTurn turn = turn_;
  const auto compute = [&]<bool is_damped, bool is_turned>() __attribute__((always_inline)) {
    Pack least_of_lanes(0.0);
    for (const CellMesh::CellRun& run : mesh_.cell_runs()) {
      if (run.needs_ghosts != (which == Cells::with_ghosts)) continue;
      std::int32_t row = run.begin;
      for (; row + pack_size <= run.end; row += pack_size)
        least_of_lanes =
            min(least_of_lanes, compute_cells<is_damped, is_turned, Pack>(material, turn, inverse_spacing, shapes, x, y,
                                                                          u, v, run.east, row, force, heating));
      for (; row < run.end; ++row)
        least = std::min(least, compute_cells<is_damped, is_turned, double>(material, turn, inverse_spacing, shapes, x,
                                                                            y, u, v, run.east, row, force, heating));
    }
    least = std::min(least, hmin(least_of_lanes));
  };
  const auto compute_damped = [&]<bool is_turned>() __attribute__((always_inline)) {
    if (material.damping_time > 0)
      compute.template operator()<true, is_turned>();
    else
      compute.template operator()<false, is_turned>();
  };
  if (turn.is_none())
    compute_damped.template operator()<false>();
  else
    compute_damped.template operator()<true>();
  if (which == Cells::without_ghosts) inverted_.reset();
  if (least < 0) look_for_inverted(s, which);
}

void CellSweep::look_for_inverted(const SolidParticles& s, Cells which) {
  for (const CellMesh::CellRun& run : mesh_.cell_runs()) {
    if (run.needs_ghosts != (which == Cells::with_ghosts)) continue;
    for (std::int32_t row = run.begin; row < run.end; ++row) {
      if (!mesh_.is_cell(row)) continue;
      const double j = determinant(strain_of(mesh_, s, run, row, spacing(), turn_).gradient);
      if (j < 0 && (!inverted_ || row < inverted_->row)) inverted_ = Inverted{row, j};
    }
  }
}

void CellSweep::accelerate(SolidParticles& s) const {
  std::array<const double*, 8> force;
  for (std::size_t c = 0; c < 8; ++c) force[c] = force_[c].data();
  const double* heating = heating_.data();
  const double* mass = s.mass.data();
  double *ax = s.acceleration.x.data(), *ay = s.acceleration.y.data(), *heat = s.dissipation_rate.data();
  const bool is_heated = is_damped();
  // The cells to the south-west, north-west, south-east and north-east, whose north-east, ... corner the particle is.
  const auto sum = [&]<class T>(std::int32_t row, std::int32_t west) __attribute__((always_inline)) {
    T fx(0.0), fy(0.0), q(0.0);
    if (west > 0) {
      const std::int32_t w = row - west;
      fx = load_as<T>(force[6] + w - 1) + load_as<T>(force[2] + w);
      fy = load_as<T>(force[7] + w - 1) + load_as<T>(force[3] + w);
      if (is_heated) q = load_as<T>(heating + w - 1) + load_as<T>(heating + w);
    }
    fx = (fx + load_as<T>(force[4] + row - 1)) + load_as<T>(force[0] + row);
    fy = (fy + load_as<T>(force[5] + row - 1)) + load_as<T>(force[1] + row);
    const T inverse_mass = T(1.0) / load_as<T>(mass + row);
    store_as(fx * inverse_mass, ax + row);
    store_as(fy * inverse_mass, ay + row);
    if (is_heated) {
      q = (q + load_as<T>(heating + row - 1)) + load_as<T>(heating + row);
      store_as(T(0.25) * q * inverse_mass, heat + row);
    }
  };
  for (const CellMesh::ParticleRun& run : mesh_.particle_runs()) {
    std::int32_t row = run.begin;
    for (; row + pack_size <= run.end; row += pack_size) sum.template operator()<Pack>(row, run.west);
    for (; row < run.end; ++row) sum.template operator()<double>(row, run.west);
  }
}

double CellSweep::energy(const SolidParticles& s, std::int32_t row) const {
  const auto after = std::upper_bound(mesh_.cell_runs().begin(), mesh_.cell_runs().end(), row,
                                      [](std::int32_t r, const CellMesh::CellRun& run) { return r < run.begin; });
  const CellMesh::CellRun& run = *(after - 1);
  return std::visit(
      [&](const auto& material) {
        return cell_energy(material, mesh_.shape(row), strain_of(mesh_, s, run, row, material.spacing, turn_));
      },
      material_);
}

void CellSweep::complete(SolidParticles& s, double reference_density) const {
  struct Content {
    CauchyStress stress;
    double determinant = 0;
    bool is_cell = false;
  };
  std::vector<Content> contents(s.size());
  std::visit(
      [&](const auto& material) {
        for (const CellMesh::CellRun& run : mesh_.cell_runs())
          for (std::int32_t row = run.begin; row < run.end; ++row) {
            if (!mesh_.is_cell(row)) continue;
            const PlaneTensor<double> f = strain_of(mesh_, s, run, row, material.spacing, turn_).gradient;
            contents[static_cast<std::size_t>(row)] = {turned(cauchy_stress(material.law, f), turn_), determinant(f),
                                                       true};
          }
      },
      material_);
  for (const CellMesh::ParticleRun& run : mesh_.particle_runs())
    for (std::int32_t row = run.begin; row < run.end; ++row) {
      CauchyStress sum;
      double determinants = 0, count = 0;
      const auto add = [&](std::int32_t cell) {
        if (cell < 0 || !contents[static_cast<std::size_t>(cell)].is_cell) return;
        const Content& content = contents[static_cast<std::size_t>(cell)];
        sum.xx += content.stress.xx;
        sum.yy += content.stress.yy;
        sum.xy += content.stress.xy;
        sum.zz += content.stress.zz;
        determinants += content.determinant;
        count += 1;
      };
      if (run.west > 0) {
        add(row - run.west - 1);
        add(row - run.west);
      }
      add(row - 1);
      add(row);
      const double share = count > 0 ? 1.0 / count : 0.0;
      const auto r = static_cast<std::size_t>(row);
      s.stress.xx[r] = share * sum.xx;
      s.stress.yy[r] = share * sum.yy;
      s.stress.xy[r] = share * sum.xy;
      s.pressure[r] = share * sum.pressure();
      s.density[r] = count > 0 ? reference_density / (share * determinants) : reference_density;
    }
}

}  // namespace sphdrop
