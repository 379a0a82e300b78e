#pragma once
// The hypoelastic solid in a step (Sec. 2.2).

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
  HypoelasticSweep sweep_;
  ElasticMaterial material_;
  bool is_plane_strain_;
};

}  // namespace sphdrop
