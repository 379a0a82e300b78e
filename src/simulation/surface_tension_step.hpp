#pragma once
// Surface tension on a distributed drop (Sec. 2.5): every rank detects its part of the surface, and works on it.

#include <span>
#include <vector>

#include "config/case.hpp"
#include "decomposition/collected_rows.hpp"
#include "decomposition/interface_gather.hpp"
#include "particles/fluid_particles.hpp"
#include "particles/solid_particles.hpp"
#include "simulation/contact_step.hpp"
#include "simulation/distribution.hpp"
#include "simulation/shared_energy.hpp"
#include "surface_tension/arc_search.hpp"
#include "surface_tension/boundary_detection.hpp"
#include "surface_tension/curve_piece.hpp"
#include "surface_tension/force_sharing.hpp"
#include "surface_tension/surface_curve.hpp"
#include "surface_tension/surface_force.hpp"
#include "time_integration/leapfrog.hpp"
#include "wetting/adhesion.hpp"

namespace sphdrop {

/// The surface at the last evaluated instant.
struct SurfaceReport {
  double length = 0;             ///< m
  double mean_curvature = 0;     ///< over the nodes, weighted by arc length, 1/m
  double curvature_scatter = 0;  ///< standard deviation, same weights, 1/m
  double curve_count = 0;        ///< of three nodes or more
  double net_force = 0;          ///< |sum of the tension's forces| over the sum of their magnitudes
  double area = 0;               ///< within the curves, m2
  double base_width = 0;         ///< B, m; 0 unless the solid attracts the liquid
};

/// In a step: start(), receive(), work(), finish(). Connectivity is found by detect() and kept; it is a function of the
/// particles' positions at detection alone, which travel with them, so redistributing or restarting does not change it.
///
/// Every rank knows the curves of the last detection, and works on the points that act on its own particles: what it
/// needs for that it has from the ranks beside it (surface_share.hpp), and nothing has to be sent back. A point's force
/// is worked out alike wherever it is needed, from the same particles in the same order.
///
/// Where the solid attracts the liquid (method.md, 6b) the contact's owner works on all points: there the boundary is
/// at hand and takes its part of the forces; it tells the other ranks what they need of them. Otherwise contact is
/// never asked for anything.
class SurfaceTensionStep {
 public:
  /// A node whose particle lives here, of a curve that carries a force.
  struct OwnNode {
    std::uint32_t node, previous, next;  ///< in this rank's piece
    std::uint32_t row;
    Vector curve_place;  ///< from where the area within its curve is counted, m
  };

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
  /// Collective. Brings together what each rank needs for its part of the surface; after detect() and after every
  /// redistribution.
  void regather(FluidParticles& fluid, const ContactStep& contact, const Distribution& distribution);

  /// Collective. After the first redistribution of a restored run: the curves of the last detection, if there was one.
  void recover(FluidParticles& fluid, Distribution& distribution, const ContactStep& contact);

  /// Sends other ranks the positions they need.
  void start(const FluidParticles& fluid);
  /// Waits for them.
  void receive();
  /// Surface points, forces and their shares. The drop's `gauge_pressure` (Pa) pushes its surface outwards. If the
  /// solid attracts the liquid, contact must have received, and gets forces on the boundary.
  void work(ContactStep& contact, double gauge_pressure);
  /// Adds the accelerations to the rows along the surface. `kick`: for how long they act, s.
  void finish(FluidParticles& fluid, double kick);

  /// Collective, after work(). What displacing the owned rows by (x, y) (m, by row) adds to the energy of surface,
  /// adhesion and gauge.
  void add_energy_of_displacement(std::span<const double> x, std::span<const double> y, double gauge_pressure,
                                  const ContactStep& contact, SharedEnergy& energy);

  /// Power of the forces on the particles less that of the same forces on the surface's points, of which they are the
  /// gradient, summed up over time. The points go with their particles, the forces are shared out over all within 2h:
  /// where these move otherwise, energy comes or goes.
  const SharedEnergy& sharing_work() const { return sharing_work_; }
  /// Counts what the step under way adds.
  void book_sharing_work() { sharing_work_.book(); }

  /// Whether there are curves; the same on every rank.
  bool has_curves() const { return has_curves_; }
  /// Own rows of the curves' nodes, one for each, until the next redistribution.
  std::span<const OwnNode> own_nodes() const { return own_nodes_; }
  /// The part of the curves that this rank works on.
  const SurfaceCurves& piece() const { return curves_; }
  /// Where the solid attracts the liquid: who needs which forces of the contact's owner.
  const InterfaceGather& node_forces() const { return node_forces_; }
  /// Who sends whom what of the particles along the surface.
  const CollectedRows& band() const { return band_; }
  /// Length of curve that came or went at once as the surface was detected anew, so far, m: no force did that work. The
  /// same on every rank.
  double reconnected_length() const { return reconnected_length_; }
  /// Likewise of the base on a solid that attracts the liquid, m.
  double reconnected_base() const { return reconnected_base_; }
  /// Likewise -gauge pressure times the area within the curves, J/m.
  double reconnected_gauge_energy() const { return reconnected_gauge_energy_; }
  /// Counts them and sharing_work() anew.
  void start_ledger() {
    reconnected_length_ = reconnected_base_ = reconnected_gauge_energy_ = 0;
    sharing_work_.restart();
  }
  /// W, N/m: energy per width of the base; 0 where the solid does not attract the liquid.
  double work_of_adhesion() const { return adhesion_parameters_.work; }
  /// At the contact's owner: what adhesion does to the solid.
  const AdhesionSummary& adhesion() const { return adhesion_summary_; }
  /// Adds what the own nodes contribute to the area within the curves at the instant last worked on, m2.
  void add_area(QuantisedSum& area) const;
  /// Collective. Of the instant last worked on.
  SurfaceReport report() const;

  /// Collective. What a restored run needs beside the particles.
  std::vector<double> to_numbers() const;
  /// Throws std::invalid_argument where the numbers are not of to_numbers().
  void from_numbers(std::span<const double> numbers);

 private:
  void find_arcs(FluidParticles& fluid, Distribution& distribution);
  void find_arc_normals();
  void orient_along_surface(FluidParticles& fluid) const;
  void take_piece(CurvePiece piece, int contact_owner);
  void place_nodes();
  void place_points(const FluidParticles& fluid);
  void add_adhesion(ContactStep& contact);
  void share();
  void account_for_points(const FluidParticles& fluid, double kick);
  double area_of(const OwnNode& own, std::span<const Vector> points) const;
  struct Extent {
    double length = 0, base = 0, area = 0;  // m, m, m2
  };
  Extent extent_on_all_ranks(const ContactStep& contact, bool needs_area);
  bool works_on_adhesion() const { return is_wetting_ && node_forces_.owner() == communicator_.rank(); }

  const Communicator& communicator_;
  SmoothingKernel kernel_;
  SurfaceTensionForm form_;
  double coefficient_, spacing_, support_, detection_displacement_, skin_;
  int polynomial_points_;
  bool orients_particles_, displacement_is_relative_;
  ArcSearch search_;

  // On every rank: the arcs of the last detection and where their particles were.
  std::vector<Arc> arcs_;
  std::vector<Vector> arc_centres_, arc_normals_;
  double curve_count_ = 0;  // of those that carry a force

  bool has_curves_ = false;
  double reconnected_length_ = 0, reconnected_base_ = 0, reconnected_gauge_energy_ = 0;
  SharedEnergy sharing_work_;

  // By place in the band; after the last of them positions have one far away.
  CollectedRows band_;
  std::vector<Vector> positions_, displacements_;
  std::vector<double> inverse_mass_;  // of the own rows in it
  std::vector<double> energies_;      // that a step adds, of those rows and of the own nodes
  std::span<const Vector> shares_;

  // This rank's piece of the curves, by node.
  SurfaceCurves curves_;
  std::vector<std::int32_t> node_place_, beyond_;
  std::vector<OwnNode> own_nodes_;
  ForceSharing sharing_;
  std::vector<Vector> node_positions_, points_, forces_, turning_;
  std::vector<double> chords_;
  std::vector<Vector> displaced_positions_, displaced_points_;

  // Where the solid attracts the liquid.
  bool is_wetting_;
  AdhesionParameters adhesion_parameters_;
  double adhesion_reach_;
  Adhesion adhesion_;
  AdhesionSummary adhesion_summary_;
  InterfaceGather node_forces_;     // brought from the contact's owner by those who need them
  std::vector<Vector> all_forces_;  // by node, with adhesion
  std::vector<double> sent_force_x_, sent_force_y_, force_x_, force_y_;
};

}  // namespace sphdrop
