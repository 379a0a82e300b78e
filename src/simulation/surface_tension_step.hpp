#pragma once
// Surface tension on a distributed drop (Sec. 2.5): detection on every rank, forces at the interface's owner.

#include <span>
#include <vector>

#include "config/case.hpp"
#include "decomposition/interface_gather.hpp"
#include "particles/fluid_particles.hpp"
#include "particles/solid_particles.hpp"
#include "simulation/contact_step.hpp"
#include "simulation/distribution.hpp"
#include "surface_tension/arc_search.hpp"
#include "surface_tension/boundary_detection.hpp"
#include "surface_tension/force_sharing.hpp"
#include "surface_tension/surface_curve.hpp"
#include "surface_tension/surface_force.hpp"
#include "time_integration/leapfrog.hpp"
#include "wetting/adhesion.hpp"

namespace sphdrop {

/// The surface as the owner sees it at the last evaluated instant; the same on all ranks only after a broadcast.
struct SurfaceReport {
  double length = 0;             ///< m
  double mean_curvature = 0;     ///< over the nodes, weighted by arc length, 1/m
  double curvature_scatter = 0;  ///< standard deviation, same weights, 1/m
  double node_count = 0;
  double curve_count = 0;  ///< of three nodes or more
  double net_force = 0;    ///< |sum of the tension's forces| over the sum of their magnitudes
  double area = 0;         ///< within the curves, m2
  double lost_points = 0;  ///< surface points without a particle to act on
  double unmatched_arcs = 0;
  double base_width = 0;  ///< B, m; 0 unless the solid attracts the liquid
};

/// In a step: start(), receive(), work(), finish(). Connectivity is found by detect() and kept; it is a function of the
/// particles' positions at detection alone, which travel with them, so redistributing or restarting does not change it.
///
/// Where the solid attracts the liquid (method.md, 6b) the contact's owner is this one's too: there the boundary is at
/// hand and takes its part of the forces. Otherwise contact is never asked for anything.
class SurfaceTensionStep {
 public:
  SurfaceTensionStep(const Communicator& communicator, const Case& input, const SmoothingKernel& kernel);

  bool is_enabled() const { return form_ != SurfaceTensionForm::none; }
  /// Whether only motion against the drop as a whole counts.
  bool displacement_is_relative() const { return displacement_is_relative_; }
  /// Whether detect() is due: some particle has moved so far since the last one, by its largest squared displacement
  /// from there, m2, or, where motion counts as relative, from the middle of all displacements.
  bool detection_is_due(double squared_displacement, const DisplacementBox& displacements) const;

  /// Collective. Takes the present positions as those of detection, and finds the surface's arcs in them.
  /// `gauge_pressure` (Pa) is for the ledger.
  void detect(FluidParticles& fluid, const SolidParticles& solid, Distribution& distribution, ContactStep& contact,
              double gauge_pressure);
  /// Collective. Brings the band along the surface to its owner; after detect() and after every redistribution.
  void regather(FluidParticles& fluid, const ContactStep& contact, const Distribution& distribution);

  /// Collective. After the first redistribution of a restored run: the curves of the last detection, if there was one.
  void recover(FluidParticles& fluid, Distribution& distribution, const ContactStep& contact);

  /// Sends the band's positions and velocities to the owner.
  void start(const FluidParticles& fluid);
  /// Waits for them.
  void receive();
  /// At the owner: surface points, forces and their shares; starts sending them back. The drop's `gauge_pressure` (Pa)
  /// pushes its surface outwards. If the solid attracts the liquid, contact must have received, and gets forces on the
  /// boundary.
  void work(ContactStep& contact, double gauge_pressure);
  /// Adds the accelerations to the band's rows.
  void finish(FluidParticles& fluid);

  /// Collective, after work(). What displacing the owned rows by (x, y) (m, by row) adds to the energy of
  /// surface, adhesion and gauge, at the owner, J/m; minus infinity at the others.
  double energy_of_displacement(std::span<const double> x, std::span<const double> y, double gauge_pressure,
                                const ContactStep& contact);

  /// At the owner, of the instant last worked on, W/m: power of the forces on the particles less that of the same
  /// forces on the surface's points, of which they are the gradient. The points go with their particles, the forces are
  /// shared out over all within 2h: where these move otherwise, energy comes or goes.
  double sharing_power() const { return sharing_power_; }
  /// What that has added to the energy so far, J/m; the same on every rank.
  double sharing_work() const { return sharing_work_; }
  void add_sharing_work(double energy) { sharing_work_ += energy; }

  int owner() const { return gather_.owner(); }
  /// Who sends the owner what.
  const InterfaceGather& gather() const { return gather_; }
  /// Length of curve that came or went at once as the surface was detected anew, so far, m: no force did that work. The
  /// same on every rank.
  double reconnected_length() const { return reconnected_length_; }
  /// Likewise of the base on a solid that attracts the liquid, m.
  double reconnected_base() const { return reconnected_base_; }
  /// Likewise -gauge pressure times the area within the curves, J/m.
  double reconnected_gauge_energy() const { return reconnected_gauge_energy_; }
  /// Counts them and sharing_work() anew.
  void start_ledger() { reconnected_length_ = reconnected_base_ = reconnected_gauge_energy_ = sharing_work_ = 0; }
  /// W, N/m: energy per width of the base; 0 where the solid does not attract the liquid.
  double work_of_adhesion() const { return adhesion_parameters_.work; }
  /// At the owner: what adhesion does to the solid.
  const AdhesionSummary& adhesion() const { return adhesion_summary_; }
  /// Within the curves, at the owner, of the instant last worked on, m2; 0 at the others.
  double enclosed_area() const { return total_area(curves_, points_); }
  /// At the owner, of the instant last worked on.
  SurfaceReport report() const;

  /// What a restored run needs beside the particles.
  std::vector<double> to_numbers() const;
  /// Throws std::invalid_argument where the numbers are not of to_numbers().
  void from_numbers(std::span<const double> numbers);

 private:
  void find_arcs(FluidParticles& fluid, Distribution& distribution);
  void place_nodes();
  double power_of_sharing(std::span<const Vector> forces);
  void find_arc_normals();
  void orient_along_surface(FluidParticles& fluid) const;
  void gather_points(const FluidParticles& fluid);
  struct Extent {
    double length = 0, base = 0, area = 0;  // m, m, m2
  };
  Extent extent_on_all_ranks(const ContactStep& contact);

  const Communicator& communicator_;
  SmoothingKernel kernel_;
  SurfaceTensionForm form_;
  double coefficient_, spacing_, support_, detection_displacement_;
  int polynomial_points_;
  bool orients_particles_, displacement_is_relative_;
  ArcSearch search_;

  // On every rank: the arcs of the last detection and where their particles were.
  std::vector<Arc> arcs_;
  std::vector<Vector> arc_centres_, arc_normals_;

  bool has_curves_ = false;
  double reconnected_length_ = 0, reconnected_base_ = 0, reconnected_gauge_energy_ = 0;
  double sharing_power_ = 0, sharing_work_ = 0;

  // This rank's part of the band, and what comes back for it.
  InterfaceGather gather_;
  std::vector<std::int32_t> band_rows_;
  std::vector<double> returned_x_, returned_y_;

  // At the owner, by gathered particle (x_ and y_ end with a place far away) or by node.
  SurfaceCurves curves_;
  ForceSharing sharing_;
  std::vector<std::int32_t> node_particle_;
  std::vector<double> x_, y_, velocity_x_, velocity_y_, mass_, powers_, acceleration_x_, acceleration_y_;
  std::vector<Vector> node_positions_, node_velocities_, points_, point_velocities_, forces_;
  std::vector<double> displacement_x_, displacement_y_;
  std::vector<Vector> displaced_positions_, displaced_points_;
  std::size_t lost_points_ = 0;

  // Where the solid attracts the liquid.
  bool is_wetting_;
  AdhesionParameters adhesion_parameters_;
  double adhesion_reach_;
  Adhesion adhesion_;
  AdhesionSummary adhesion_summary_;
  std::vector<Vector> all_forces_;  // by node, with adhesion
};

}  // namespace sphdrop
