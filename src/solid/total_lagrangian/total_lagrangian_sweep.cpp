#include "solid/total_lagrangian/total_lagrangian_sweep.hpp"

#include <algorithm>
#include <vector>

#include "particles/pack.hpp"
#include "solid/total_lagrangian/total_lagrangian_pair.hpp"

namespace sphdrop {

namespace {

template <std::size_t n>
void clear(std::array<Column<double>, n>& columns, std::size_t rows) {
  for (Column<double>& column : columns) {
    column.resize(0);
    column.resize(rows);
  }
}

/// m_j `mass_factor` gradient_factor() of the pairs.
std::vector<double> pair_weights(const CubicSpline& kernel, const SolidParticles& s, const OffsetNeighbours& list,
                                 double mass_factor) {
  std::vector<double> weights(block_size * list.offsets.size());
  const double *x = s.reference_position.x.data(), *y = s.reference_position.y.data(), *mass = s.mass.data();
  for (const OffsetNeighbours::Block& block : list.blocks)
    for (std::int32_t k = block.first_offset; k < block.first_offset + block.offsets; ++k)
      for (std::int32_t lane = 0; lane < block_size; lane += pack_size) {
        const std::int64_t i = block.first_row + lane, j = i + list.offsets[static_cast<std::size_t>(k)];
        const Pack volume = load(mass + j) * Pack(mass_factor);
        store(volume * gradient_factor(kernel, load(x + i) - load(x + j), load(y + i) - load(y + j)),
              weights.data() + std::ptrdiff_t{block_size} * k + lane);
      }
  return weights;
}

}  // namespace

TotalLagrangianSweep::TotalLagrangianSweep(const AnyTotalLagrangianMaterial& material, const CubicSpline& kernel)
    : material_(material),
      kernel_(kernel),
      support_(2.0 / kernel.inverse_smoothing_length),
      density_(std::visit([](const auto& m) { return m.density; }, material)),
      is_viscous_(std::visit([](const auto& m) { return m.viscous_time > 0; }, material)) {}

void TotalLagrangianSweep::relist(const SolidParticles& s, const std::vector<char>& is_rigid) {
  const Column<double>&x = s.reference_position.x, &y = s.reference_position.y;
  std::vector<char> wanted(s.size(), 0);
  s.for_each_owned([&](std::size_t row) { wanted[row] = 1; });
  owned_ = OffsetNeighbours::build(s, x, y, support_);
  // Every row within reach of an owned one is deformed here.
  const std::vector<char> is_owned = wanted;
  for (const OffsetNeighbours::Block& block : owned_.blocks) {
    const std::int32_t* offsets = owned_.offsets.data() + block.first_offset;
    for (std::int32_t row = block.first_row; row < block.first_row + block_size; ++row)
      for (std::int32_t k = 0; k < block.offsets; ++k) {
        const std::int32_t j = row + offsets[k];
        const auto size = static_cast<std::int32_t>(s.size());
        if (row >= size || j < 0 || j >= size || !is_owned[static_cast<std::size_t>(row)]) continue;
        const Vector away = s.reference_position.at(static_cast<std::size_t>(row)) -
                            s.reference_position.at(static_cast<std::size_t>(j));
        if (squared_length(away) < support_ * support_) wanted[static_cast<std::size_t>(j)] = 1;
      }
  }
  for (std::size_t row = 0; row < is_rigid.size(); ++row)
    if (is_rigid[row] != 0) wanted[row] = 0;
  deformed_ = OffsetNeighbours::build(s, wanted, x, y, support_);

  deformed_weights_ = pair_weights(kernel_, s, deformed_, 1.0 / density_);
  owned_weights_ = pair_weights(kernel_, s, owned_, 1.0 / (density_ * density_));

  clear(displacement_, s.size());
  clear(moment_, s.size());
  clear(gradient_, s.size());
  clear(load_, s.size());
  heating_.resize(0);
  heating_.resize(s.size());
  // Whether or not a block of deformed rows happens to reach over them.
  for (std::size_t row = 0; row < is_rigid.size(); ++row)
    if (is_rigid[row] != 0) gradient_[0][row] = gradient_[3][row] = 1.0;
  // Rows that are not deformed here keep B = 0, hence F = I and no load.
  for (const OffsetNeighbours::Block& block : deformed_.blocks) {
    const std::int32_t* offsets = deformed_.offsets.data() + block.first_offset;
    for (std::int32_t row = block.first_row; row < block.first_row + block_size; ++row) {
      const auto i = static_cast<std::size_t>(row);
      if (i >= s.size() || !wanted[i]) continue;
      PlaneStrainTensor<double> moment;
      for (std::int32_t k = 0; k < block.offsets; ++k) {
        const std::int32_t j = row + offsets[k];
        if (j < 0 || static_cast<std::size_t>(j) >= s.size()) continue;
        const auto other = static_cast<std::size_t>(j);
        const double dx = x[i] - x[other], dy = y[i] - y[other];
        add_to_first_moment(s.mass[other] / density_, gradient_factor(kernel_, dx, dy), dx, dy, moment);
      }
      const PlaneStrainTensor<double> b = inverse(moment);
      moment_[0][i] = b.xx;
      moment_[1][i] = b.yy;
      moment_[2][i] = b.xy;
    }
  }
}

void TotalLagrangianSweep::find_displacements(const SolidParticles& s, RowRange rows) {
  const double *x0 = s.reference_position.x.data(), *y0 = s.reference_position.y.data();
  const double *x = s.position.x.data(), *y = s.position.y.data();
  double *moved_x = displacement_[0].data(), *moved_y = displacement_[1].data();
  for (std::int32_t row = rows.begin; row < rows.end; ++row) moved_x[row] = x[row] - x0[row];
  for (std::int32_t row = rows.begin; row < rows.end; ++row) moved_y[row] = y[row] - y0[row];
}

void TotalLagrangianSweep::deform(const SolidParticles& solid, Blocks which) {
  for (const RowRange& rows : which == Blocks::without_ghosts ? solid.owned : solid.ghosts)
    find_displacements(solid, rows);
  std::visit(
      [&]<class Law>(const TotalLagrangianMaterial<Law>& material) {
        if (is_viscous_)
          deform_blocks<Law, true>(material, solid, which);
        else
          deform_blocks<Law, false>(material, solid, which);
      },
      material_);
}

template <class Law, bool is_viscous>
void TotalLagrangianSweep::deform_blocks(const TotalLagrangianMaterial<Law>& m, const SolidParticles& s, Blocks which) {
  const TotalLagrangianMaterial<Law> material = m;
  const double inverse_density = 1.0 / material.density;
  const double *x0 = s.reference_position.x.data(), *y0 = s.reference_position.y.data();
  const double *moved_x = displacement_[0].data(), *moved_y = displacement_[1].data();
  const double *u = s.velocity.x.data(), *v = s.velocity.y.data();
  Pack least(which == Blocks::without_ghosts ? 1.0 : least_determinant_);
  for (const OffsetNeighbours::Block& block : deformed_.blocks) {
    if (block.needs_ghosts != (which == Blocks::with_ghosts)) continue;
    const std::int32_t* offsets = deformed_.offsets.data() + block.first_offset;
    const double* weights = deformed_weights_.data() + std::ptrdiff_t{block_size} * block.first_offset;
    for (std::int32_t lane = 0; lane < block_size; lane += pack_size) {
      const std::int64_t i = block.first_row + lane;
      const Pack x0_i = load(x0 + i), y0_i = load(y0 + i);
      const Pack moved_x_i = load(moved_x + i), moved_y_i = load(moved_y + i);
      const Pack u_i = load(u + i), v_i = load(v + i);
      PlaneTensor<Pack> displacement, velocity;
      for (std::int32_t k = 0; k < block.offsets; ++k) {
        const std::int64_t j = i + offsets[k];
        const Pack dx = x0_i - load(x0 + j), dy = y0_i - load(y0 + j);
        const Pack weight = load(weights + std::ptrdiff_t{block_size} * k + lane);
        add_to_gradient(weight, dx, dy, moved_x_i - load(moved_x + j), moved_y_i - load(moved_y + j), displacement);
        if constexpr (is_viscous) add_to_gradient(weight, dx, dy, u_i - load(u + j), v_i - load(v + j), velocity);
      }
      const PlaneStrainTensor<Pack> b{load(moment_[0].data() + i), load(moment_[1].data() + i),
                                      load(moment_[2].data() + i)};
      PlaneTensor<Pack> f = product(displacement, b);
      f.xx += Pack(1.0);
      f.yy += Pack(1.0);
      PlaneTensor<Pack> stress = material.law.stress(f);
      if constexpr (is_viscous) {
        const PlaneStrainTensor<Pack> rate = green_strain_rate(f, product(velocity, b));
        const Pack tau(material.viscous_time);
        const PlaneTensor<Pack> viscous = product(f, material.law.moduli.stress(rate));
        stress.xx += tau * viscous.xx;
        stress.xy += tau * viscous.xy;
        stress.yx += tau * viscous.yx;
        stress.yy += tau * viscous.yy;
        store(Pack(2.0 * inverse_density) * tau * material.law.moduli.energy(rate), heating_.data() + i);
      }
      const PlaneTensor<Pack> loaded = product(stress, b);
      least = min(least, determinant(f));
      store(f.xx, gradient_[0].data() + i);
      store(f.xy, gradient_[1].data() + i);
      store(f.yx, gradient_[2].data() + i);
      store(f.yy, gradient_[3].data() + i);
      store(loaded.xx, load_[0].data() + i);
      store(loaded.xy, load_[1].data() + i);
      store(loaded.yx, load_[2].data() + i);
      store(loaded.yy, load_[3].data() + i);
    }
  }
  least_determinant_ = hmin(least);
}

void TotalLagrangianSweep::accelerate(SolidParticles& s) const {
  const double *x0 = s.reference_position.x.data(), *y0 = s.reference_position.y.data();
  const auto load_of = [&](std::int64_t row) -> PlaneTensor<Pack> {
    return {load(load_[0].data() + row), load(load_[1].data() + row), load(load_[2].data() + row),
            load(load_[3].data() + row)};
  };
  for (const OffsetNeighbours::Block& block : owned_.blocks) {
    const std::int32_t* offsets = owned_.offsets.data() + block.first_offset;
    const double* weights = owned_weights_.data() + std::ptrdiff_t{block_size} * block.first_offset;
    for (std::int32_t lane = 0; lane < block_size; lane += pack_size) {
      const std::int64_t i = block.first_row + lane;
      const Pack x0_i = load(x0 + i), y0_i = load(y0 + i);
      const PlaneTensor<Pack> load_i = load_of(i);
      Pack ax(0.0), ay(0.0);
      for (std::int32_t k = 0; k < block.offsets; ++k) {
        const std::int64_t j = i + offsets[k];
        const Pack dx = x0_i - load(x0 + j), dy = y0_i - load(y0 + j);
        add_to_acceleration(load(weights + std::ptrdiff_t{block_size} * k + lane), dx, dy, load_i, load_of(j), ax, ay);
      }
      store(ax, s.acceleration.x.data() + i);
      store(ay, s.acceleration.y.data() + i);
      if (is_viscous_) store(load(heating_.data() + i), s.dissipation_rate.data() + i);
    }
  }
}

PlaneTensor<double> TotalLagrangianSweep::gradient(std::int32_t row) const {
  const auto r = static_cast<std::size_t>(row);
  return {gradient_[0][r], gradient_[1][r], gradient_[2][r], gradient_[3][r]};
}

std::optional<TotalLagrangianSweep::Inverted> TotalLagrangianSweep::inverted(const SolidParticles& s) const {
  if (!(least_determinant_ < 0)) return std::nullopt;
  std::optional<Inverted> found;
  s.for_each_owned([&](std::size_t row) {
    const auto r = static_cast<std::int32_t>(row);
    if (const double j = determinant(gradient(r)); j < 0 && !found) found = Inverted{r, j};
  });
  return found;
}

double TotalLagrangianSweep::energy(const SolidParticles& s, std::int32_t row) const {
  const double volume = s.mass[static_cast<std::size_t>(row)] / density_;
  return std::visit([&](const auto& m) { return volume * m.law.energy_density(gradient(row)); }, material_);
}

void TotalLagrangianSweep::complete(SolidParticles& s) const {
  std::visit(
      [&](const auto& material) {
        s.for_each_owned([&](std::size_t row) {
          const PlaneTensor<double> f = gradient(static_cast<std::int32_t>(row));
          const CauchyStress stress = cauchy_stress(material.law, f);
          s.stress.xx[row] = stress.xx;
          s.stress.yy[row] = stress.yy;
          s.stress.xy[row] = stress.xy;
          s.pressure[row] = stress.pressure();
          s.density[row] = density_ / determinant(f);
        });
      },
      material_);
}

}  // namespace sphdrop
