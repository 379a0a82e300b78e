#pragma once
// The solid of cells in a step.

#include <vector>

#include "simulation/solid_bodies.hpp"
#include "simulation/solid_step.hpp"
#include "solid/cells/cell_sweep.hpp"
#include "solid/cells/lattice_cells.hpp"

namespace sphdrop {

/// Of several solids each has its own cells and material.
class CellStep : public SolidStep {
 public:
  /// Throws std::invalid_argument if the particles do not stand on a lattice.
  CellStep(const Case& input, const InitialSolid& initial, std::int64_t first_id);

  bool is_total_lagrangian() const override { return true; }
  /// One lattice diagonal, and something for rounding.
  double reach() const override { return 1.5 * spacing_; }
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
  struct Body {
    LatticeCells lattice;
    CellSweep sweep;
    double density;
    std::int64_t first_id;
  };
  std::vector<Body> bodies_;
  std::vector<SolidIds> rigid_;
  double spacing_;
  bool is_viscous_, is_damped_;
};

}  // namespace sphdrop
