#pragma once
// Forces, energy and stress of a total-Lagrangian solid.

#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "particles/solid_particles.hpp"
#include "solid/plane_strain.hpp"
#include "sph/kernel.hpp"
#include "sph/offset_neighbours.hpp"

namespace sphdrop {

template <class Law>
struct TotalLagrangianMaterial {
  Law law;
  double density = 0;       ///< rho0, kg/m3
  double viscous_time = 0;  ///< of Kelvin's and Voigt's viscosity, s
};
using AnyTotalLagrangianMaterial =
    std::variant<TotalLagrangianMaterial<StVenantKirchhoff>, TotalLagrangianMaterial<NeoHookean>>;

/// In a step: deform() the blocks without ghosts, then those with, then accelerate(). The ghosts next to owned
/// particles are deformed here too, so that one halo, of twice the kernel's reach, is enough.
class TotalLagrangianSweep {
 public:
  TotalLagrangianSweep(const AnyTotalLagrangianMaterial& material, const CubicSpline& kernel);

  /// How far ghosts must reach, m.
  double reach() const { return 2.0 * support_; }
  /// After every change of the rows: neighbours in the undeformed body and the moments B. Rows marked in `is_rigid` (as
  /// many as rows, or none) are never deformed; they must be out of reach of the others.
  void relist(const SolidParticles& solid, const std::vector<char>& is_rigid = {});

  enum class Blocks { without_ghosts, with_ghosts };
  /// F and P B of those blocks.
  void deform(const SolidParticles& solid, Blocks which);
  /// Sets acceleration of the owned rows, and with viscosity dissipation_rate.
  void accelerate(SolidParticles& solid) const;

  /// An owned row where J < 0, the lowest.
  struct Inverted {
    std::int32_t row = 0;
    double determinant = 0;
  };
  std::optional<Inverted> inverted(const SolidParticles& solid) const;
  /// Of an owned row, J/m.
  double energy(const SolidParticles& solid, std::int32_t row) const;
  /// Sets stress, pressure and density of the owned rows.
  void complete(SolidParticles& solid) const;

 private:
  PlaneTensor<double> gradient(std::int32_t row) const;
  void find_displacements(const SolidParticles& solid, RowRange rows);
  template <class Law, bool is_viscous>
  void deform_blocks(const TotalLagrangianMaterial<Law>& material, const SolidParticles& solid, Blocks which);

  AnyTotalLagrangianMaterial material_;
  CubicSpline kernel_;
  double support_, density_;
  bool is_viscous_;
  OffsetNeighbours deformed_, owned_;
  // gradient_factor() of the pairs times V_j, or V_j/rho_0, which never change: eight lanes for each offset of each
  // block, one block after the other.
  std::vector<double> deformed_weights_, owned_weights_;
  std::array<Column<double>, 2> displacement_;  // m: once a row, not once a pair
  std::array<Column<double>, 3> moment_;        // B: xx, yy, xy
  std::array<Column<double>, 4> gradient_;      // F: xx, xy, yx, yy
  std::array<Column<double>, 4> load_;          // P B
  Column<double> heating_;                      // W/kg
  double least_determinant_ = 1;
};

}  // namespace sphdrop
