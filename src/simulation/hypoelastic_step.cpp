#include "simulation/hypoelastic_step.hpp"

#include <algorithm>
#include <utility>

#include "diagnostics/energy.hpp"

namespace sphdrop {

HypoelasticStep::HypoelasticStep(const Case& input, const HypoelasticParameters& parameters)
    : sweep_(parameters),
      material_(parameters.material),
      is_plane_strain_(input.first_elastic_solid().deviatoric_trace == DeviatoricTrace::plane_strain) {}

std::vector<Column<double>*> HypoelasticStep::ghosted(SolidParticles& solid) const {
  return solid.columns_with(Role::ghosted);
}

void HypoelasticStep::relist(SolidParticles& solid, const Distribution&) {
  // Blocks without ghosts in reach may still load ghosts' rows, to weight them by zero, before the halo has arrived.
  for (const RowRange& range : solid.ghosts)
    std::fill(solid.density.data() + range.begin, solid.density.data() + range.end, material_.density);
  sweep_.update_stress(solid, solid.ghosts);
  predicted_for_.reset();
}

void HypoelasticStep::predict_rows(SolidParticles& solid, std::span<const RowRange> rows, double previous_step) const {
  sphdrop::predict(solid, rows, previous_step);
  sweep_.update_stress(solid, rows);
}

void HypoelasticStep::predict(SolidParticles& solid, double previous_step) {
  if (std::exchange(predicted_for_, std::nullopt) == previous_step) return;
  for_each_run(solid.owned, [&](std::span<const RowRange> rows) { predict_rows(solid, rows, previous_step); });
}

void HypoelasticStep::sweep_inner(SolidParticles& solid, const Distribution& distribution) {
  sweep_.apply(solid, distribution.solid(), HypoelasticSweep::Blocks::without_ghosts);
}

void HypoelasticStep::sweep_rest(SolidParticles& solid, const Distribution& distribution) {
  sweep_.update_stress(solid, solid.ghosts);
  sweep_.apply(solid, distribution.solid(), HypoelasticSweep::Blocks::with_ghosts);
}

MotionMaxima HypoelasticStep::move(SolidParticles& solid, StepLengths steps, double speed_limit) {
  // What the next step predicts follows from what is in the cache here, and nothing comes between but other rows.
  predicted_for_ = steps.next;
  return kick_and_drift(solid, steps, speed_limit,
                        [&](std::span<const RowRange> rows) { predict_rows(solid, rows, steps.next); });
}

void HypoelasticStep::add_elastic_energy(const SolidParticles& s, ExactSum& sum) const {
  s.for_each_owned([&](std::size_t row) {
    const double m = s.mass[row];
    const double xx = s.deviatoric_stress.xx[row], yy = s.deviatoric_stress.yy[row], xy = s.deviatoric_stress.xy[row];
    const DeviatoricStress tau =
        is_plane_strain_ ? plane_strain_deviator(xx, yy, xy) : two_dimensional_deviator(xx, yy, xy);
    sum.add(m / s.density[row] * distortion_energy_density(tau, material_.shear_modulus()) +
            m * compressive_energy_per_mass(s.density[row], material_.density, material_.sound_speed()));
  });
}

}  // namespace sphdrop
