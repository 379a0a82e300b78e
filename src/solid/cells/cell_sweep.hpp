#pragma once
// Forces, energy and stress of a solid made of cells.

#include <cstdint>
#include <optional>
#include <variant>

#include "particles/solid_particles.hpp"
#include "solid/cells/cell.hpp"
#include "solid/cells/cell_mesh.hpp"

namespace sphdrop {

using AnyCellMaterial = std::variant<CellMaterial<StVenantKirchhoff>, CellMaterial<NeoHookean>>;

/// How the lattice lies in the plane: its rows along (cosine, sine). Cells are computed in its frame.
struct LatticeTurn {
  double cosine = 1, sine = 0;

  bool is_none() const { return sine == 0 && cosine == 1; }
};

/// In a step: sweep() of the cells without ghosts, then of those with, then accelerate().
class CellSweep {
 public:
  explicit CellSweep(const AnyCellMaterial& material, LatticeTurn turn = {}) : material_(material), turn_(turn) {}

  /// After every change of the rows.
  void set_mesh(CellMesh mesh);
  const CellMesh& mesh() const { return mesh_; }

  enum class Cells { without_ghosts, with_ghosts };
  /// The forces on the corners of those cells, from positions, and with damping from velocities.
  void sweep(const SolidParticles& solid, Cells which);
  /// Sets acceleration of the owned rows, and dissipation_rate if there is damping. Every particle sums its cells'
  /// forces in the same order, whoever owns it.
  void accelerate(SolidParticles& solid) const;

  /// A cell that is turned inside out, with the lowest row of a south-west corner, as last swept: J <= 0 at its
  /// centroid.
  struct Inverted {
    std::int32_t row = 0;
    double determinant = 0;
  };
  const std::optional<Inverted>& inverted() const { return inverted_; }

  /// Of the cell in this row as it lies, J/m.
  double energy(const SolidParticles& solid, std::int32_t row) const;
  /// Sets stress, pressure and density of the owned rows: means over the cells about a particle. Particles without
  /// cells are not deformed.
  void complete(SolidParticles& solid, double reference_density) const;

 private:
  template <class Law>
  void sweep_runs(const CellMaterial<Law>& material, const SolidParticles& solid, Cells which);
  double spacing() const;
  bool is_damped() const;
  void look_for_inverted(const SolidParticles& solid, Cells which);

  AnyCellMaterial material_;
  LatticeTurn turn_;
  CellMesh mesh_;
  // By row of the cell: x and y of the forces on the corners sw, se, nw, ne; heating.
  std::array<Column<double>, 8> force_;
  Column<double> heating_;
  std::optional<Inverted> inverted_;
};

}  // namespace sphdrop
