#pragma once
// The hypoelastic solid in a step (Sec. 2.2).

#include <optional>
#include <span>

#include "simulation/solid_step.hpp"
#include "solid/hypoelastic/hypoelastic_sweep.hpp"

namespace sphdrop {

class HypoelasticStep : public SolidStep {
 public:
  HypoelasticStep(const Case& input, const HypoelasticParameters& parameters);

  bool is_total_lagrangian() const override { return false; }
  std::vector<Column<double>*> ghosted(SolidParticles& solid) const override;
  void relist(SolidParticles& solid, const Distribution& distribution) override;
  void predict(SolidParticles& solid, double previous_step) override;
  void sweep_inner(SolidParticles& solid, const Distribution& distribution) override;
  void sweep_rest(SolidParticles& solid, const Distribution& distribution) override;
  MotionMaxima move(SolidParticles& solid, StepLengths steps, double speed_limit) override;
  void complete(SolidParticles&) const override {}
  void add_elastic_energy(const SolidParticles& solid, ExactSum& sum) const override;

 private:
  void predict_rows(SolidParticles& solid, std::span<const RowRange> rows, double previous_step) const;

  HypoelasticSweep sweep_;
  ElasticMaterial material_;
  bool is_plane_strain_;
  std::optional<double> predicted_for_;  ///< length of the previous step, s: the owned rows are predicted already
};

}  // namespace sphdrop
