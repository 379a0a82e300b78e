#pragma once
// The total-Lagrangian solid in a step.

#include "simulation/solid_bodies.hpp"
#include "simulation/solid_step.hpp"
#include "solid/total_lagrangian/total_lagrangian_sweep.hpp"

namespace sphdrop {

class TotalLagrangianStep : public SolidStep {
 public:
  TotalLagrangianStep(const Case& input, const ElasticMaterial& material, const CubicSpline& kernel,
                      const InitialSolid& initial, std::int64_t first_id);

  bool is_total_lagrangian() const override { return true; }
  double reach() const override { return sweep_.reach(); }
  std::vector<Column<double>*> ghosted(SolidParticles& solid) const override;
  void relist(SolidParticles& solid, const Distribution& distribution) override;
  void predict(SolidParticles& solid, double previous_step) override;
  void sweep_inner(SolidParticles& solid, const Distribution& distribution) override;
  void sweep_rest(SolidParticles& solid, const Distribution& distribution) override;
  MotionMaxima move(SolidParticles& solid, StepLengths steps, double speed_limit) override;
  void complete(SolidParticles& solid) const override;
  void add_elastic_energy(const SolidParticles& solid, ExactSum& sum) const override;
  std::optional<Inversion> inversion(const SolidParticles& solid) const override;

 private:
  std::vector<SolidIds> rigid_;
  TotalLagrangianSweep sweep_;
  bool is_viscous_, is_damped_;
};

}  // namespace sphdrop
