#pragma once
// A validated case: everything a run needs to know, in SI units.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "config/given_particles.hpp"

namespace sphdrop {

enum class Mode { paper, modern, fast };
enum class DropShape { none, round, square, ellipse, particles };
enum class DropArrangement { rings, lattice };
enum class DropPlacement { above_solid, centre, file };
enum class DropMaterial { liquid, rigid };
enum class SolidKind { none, cantilever, fixed_fixed_beam, rigid_wall, polygon, obstacle };
enum class SolidFormulation { automatic, hypoelastic, cells, total_lagrangian };
enum class MaterialLaw { st_venant_kirchhoff, neo_hookean };
enum class Clamp { strips, ideal };
enum class DeviatoricTrace { plane_strain, two_dimensional };
enum class ContactStiffness { time_step, fixed };
enum class SurfaceTensionForm { none, conservative, curvature };
enum class KernelShape { cubic_spline, wendland_c2 };
enum class ViscosityForm { artificial, physical };
enum class DensityTreatment { none, moving_least_squares, density_diffusion };
enum class DetectionMotion { absolute, relative };
enum class Switch { off, on };

using Points = std::vector<Point>;

/// One section of the case file each. Which key fills which member, its default, range and the paper's symbol stand in
/// the table in config/parameter_table.cpp and nowhere else.
///
/// A default-constructed Case is all zeros and no valid case; parse_case_text (config/case_file.hpp) makes valid ones.
struct Case {
  std::string name;         ///< of the run's files; a single file name
  Mode mode = Mode::paper;  ///< which scheme the automatic parameters choose

  struct Resolution {
    double spacing = 0;                              ///< d, m
    double smoothing_ratio = 0;                      ///< h/d
    KernelShape kernel = KernelShape::cubic_spline;  ///< of the liquid
    bool operator==(const Resolution&) const = default;
  } resolution;

  struct Time {
    double end = 0;                   ///< s
    double step = 0;                  ///< s; 0: Eqs 40-42
    double sound_cfl = 0;             ///< Eq 40's factor
    double liquid_sound_cfl = 0;      ///< Eq 40's factor for the liquid where the solid takes sub-steps
    std::int64_t solid_substeps = 0;  ///< steps of the solid in one step of the liquid
    double capillary_cfl = 0;         ///< Eq 41's factor
    double viscous_cfl = 0;           ///< Eq 42's factor
    bool operator==(const Time&) const = default;
  } time;

  struct Fluid {
    double density = 0;    ///< rho0, kg/m3
    double viscosity = 0;  ///< mu, Pa s; enters Eq 42, and the forces of the physical form
    ViscosityForm viscosity_form = ViscosityForm::artificial;
    double sound_speed = 0;  ///< c_f, m/s
    double artificial_viscosity_alpha = 0;
    double artificial_viscosity_beta = 0;
    DensityTreatment density_treatment = DensityTreatment::moving_least_squares;
    std::int64_t density_correction_interval = 0;  ///< steps; 0: never
    double density_diffusion = 0;                  ///< delta
    Switch gauge_pressure = Switch::off;
    double gauge_relaxation_time = 0;  ///< s
    double ambient_pressure = 0;       ///< Pa: how far below zero the gauge may fall
    Switch shifting = Switch::off;
    std::int64_t shifting_interval = 0;  ///< steps
    bool operator==(const Fluid&) const = default;
  } fluid;

  struct Drop {
    DropShape shape = DropShape::none;
    DropArrangement arrangement = DropArrangement::rings;
    DropMaterial material = DropMaterial::liquid;
    double density = 0;       ///< kg/m3; a liquid's is fluid.density
    double diameter = 0;      ///< D0 (round), side (square), that of the circle of the same area (ellipse), m
    double aspect_ratio = 0;  ///< of an ellipse, width over height
    double velocity_x = 0, velocity_y = 0;  ///< m/s
    double gap = 0;                         ///< at the start, between the surfaces of drop and solid, m
    double centre_x = 0;                    ///< m; x = 0 at the left clamp's edge, or at the middle of a rigid wall
    DropPlacement placement = DropPlacement::above_solid;
    double centre_y = 0;  ///< m; of a drop that is not placed above a solid
    double jitter = 0;    ///< of a lattice start, in units of d
    std::int64_t seed = 0;
    double oscillation_velocity = 0;  ///< V0, m/s
    double oscillation_radius = 0;    ///< r0, m
    double initial_spin = 0;          ///< of a rigid drop, rad/s, counterclockwise
    double relaxation_time = 0;       ///< s: a liquid drop comes to rest for so long before it starts at t = 0
    std::string particles_file;       ///< of shape particles; absolute once it has been read
    std::string particles_checksum;   ///< of its bytes
    GivenParticlesOfCase given;       ///< what it holds, once it has been read
    /// Moved as one rigid body (Sec. 4.4).
    bool is_rigid() const { return shape != DropShape::none && material == DropMaterial::rigid; }
    /// Has pressure, viscosity and surface tension.
    bool is_liquid() const { return shape != DropShape::none && material == DropMaterial::liquid; }
    bool operator==(const Drop&) const = default;
  } drop;
  std::vector<Drop> more_drops;  ///< beside `drop`; all are liquid then

  struct Solid {
    SolidKind kind = SolidKind::none;
    double length = 0;                                                 ///< L, free length, m (rigid wall: its width)
    double thickness = 0;                                              ///< H, m
    double density = 0;                                                ///< kg/m3
    double youngs_modulus = 0;                                         ///< E, Pa
    double poisson_ratio = 0;                                          ///< nu
    SolidFormulation formulation = SolidFormulation::automatic;        ///< never automatic in a validated case
    MaterialLaw material_law = MaterialLaw::st_venant_kirchhoff;       ///< of cells and total_lagrangian
    DeviatoricTrace deviatoric_trace = DeviatoricTrace::plane_strain;  ///< k = 1/3 or 1/2
    double artificial_viscosity_alpha = 0;
    double artificial_viscosity_beta = 0;
    double artificial_stress_coefficient = 0;  ///< eps, Eq 20
    Clamp clamp = Clamp::strips;
    double clamp_length = 0;  ///< m
    std::int64_t clamp_layers = 0;
    double damping_rate = 0;   ///< 1/s, in proportion to mass: a = -damping_rate v
    double damping_ratio = 0;  ///< of critical damping in the first bending mode; as much damping in proportion to mass
    double viscous_time = 0;   ///< s, in proportion to stiffness: stress by strain rate over stress by strain
    double initial_tip_velocity = 0;  ///< m/s, along +y (up); of the cantilever's first bending mode
    Points polygon;                   ///< corners of a body of kind polygon or obstacle, either way round
    /// Parts of the plane in which a polygon is held: two points are opposite corners of a box, more are a polygon.
    std::vector<Points> clamps;
    double lattice_x = 1, lattice_y = 0;  ///< direction of the rows of a polygon's lattice, of any length
    Points pinned, held_in_x, held_in_y;  ///< where it is held in both directions, or in one
    Points probe;                         ///< where the deflection is watched; empty: automatic
    double origin_x = 0, origin_y = 0;    ///< by which the whole body is moved, m; all places above move with it
    /// Whether theory knows how it swings: a straight beam that nothing but its clamps holds.
    bool has_theory() const { return is_straight_beam() && pinned.empty() && held_in_x.empty() && held_in_y.empty(); }
    /// Whether it is a beam with two parallel sides.
    bool is_straight_beam() const { return kind == SolidKind::cantilever || kind == SolidKind::fixed_fixed_beam; }
    /// Whether it yields and moves.
    bool is_elastic() const { return is_straight_beam() || kind == SolidKind::polygon; }
    bool has_polygon() const { return kind == SolidKind::polygon || kind == SolidKind::obstacle; }
    bool operator==(const Solid&) const = default;
  } solid;
  std::vector<Solid> more_solids;  ///< beside `solid`

  struct Contact {
    ContactStiffness stiffness_form = ContactStiffness::time_step;
    double stiffness = 0;       ///< time_step: Eq 24's 0.1; fixed: k_n over contact_modulus()
    double damping_ratio = 0;   ///< of a particle's normal motion; 1: critical
    double wall_drag = 0;       ///< of the motion along the wall, in units of nu/d^2
    double distance_ratio = 0;  ///< d0/d
    double overlap_limit = 0;   ///< d0 - d_p at which the run stops, in units of d0
    bool operator==(const Contact&) const = default;
  } contact;

  struct SurfaceTension {
    SurfaceTensionForm form = SurfaceTensionForm::conservative;
    double coefficient = 0;              ///< sigma, N/m
    double contact_angle = 0;            ///< theta, degrees; at 180 the solid does not attract the liquid
    std::int64_t polynomial_points = 0;  ///< 3 or 5, Eq 28
    double detection_displacement =
        0;  ///< in units of d: the curve's connectivity is kept until a particle has moved so far
    DetectionMotion detection_motion = DetectionMotion::absolute;
    bool operator==(const SurfaceTension&) const = default;
  } surface_tension;

  struct Gravity {
    double x = 0, y = 0;  ///< m/s2
    bool operator==(const Gravity&) const = default;
  } gravity;

  struct Output {
    std::string directory;
    double snapshot_interval = 0;  ///< s of simulated time; 0: only first and last
    double history_interval = 0;   ///< s of simulated time
    bool operator==(const Output&) const = default;
  } output;

  struct Checkpoint {
    double interval = 0;       ///< s of simulated time; 0: none for it
    double wall_interval = 0;  ///< s of wall time; 0: none for it
    std::int64_t keep = 0;     ///< the newest so many
    bool operator==(const Checkpoint&) const = default;
  } checkpoint;

  struct Parallel {
    double skin = 0;  ///< neighbour lists reach so far beyond 2h, in units of d
    double imbalance_threshold = 0;
    std::int64_t repartition_interval = 0;  ///< steps between forced repartitions; 0: none
    std::int64_t cells_per_process = 0;     ///< cells that are dealt out are as wide as leaves so many
    bool operator==(const Parallel&) const = default;
  } parallel;

  struct Safety {
    double speed_limit = 0;    ///< m/s: a faster particle stops the run
    double domain_margin = 0;  ///< m: a particle farther than this outside the box of the initial particles is lost
    bool operator==(const Safety&) const = default;
  } safety;

  /// Pa, of which contact.stiffness is a share where it is fixed: rho c^2 of the body that yields, the liquid; with a
  /// rigid drop the beam; where neither yields, of the liquid all the same, which sets the time step there too.
  double contact_modulus() const {
    double smallest = 0;
    for (std::size_t k = 0; drop.is_rigid() && k < solid_count(); ++k) {
      const Solid& one = solid_at(k);
      if (!one.is_elastic()) continue;
      const double bulk_modulus = one.youngs_modulus / (3.0 * (1.0 - 2.0 * one.poisson_ratio));
      if (smallest == 0 || bulk_modulus < smallest) smallest = bulk_modulus;
    }
    if (smallest > 0) return smallest;
    return fluid.density * fluid.sound_speed * fluid.sound_speed;
  }

  /// Whether the solid attracts the liquid.
  bool is_wetting() const { return surface_tension.contact_angle < 180.0; }

  bool operator==(const Case&) const = default;

  std::size_t drop_count() const { return 1 + more_drops.size(); }
  /// As if drop k = 0, 1, ... were the only one.
  Case with_drop(std::size_t k) const {
    Case one = *this;
    if (k > 0) one.drop = more_drops[k - 1];
    one.more_drops.clear();
    return one;
  }

  std::size_t solid_count() const { return 1 + more_solids.size(); }
  const Solid& solid_at(std::size_t k) const { return k == 0 ? solid : more_solids[k - 1]; }
  /// As if solid k = 0, 1, ... were the only one.
  Case with_solid(std::size_t k) const {
    Case one = *this;
    one.solid = solid_at(k);
    one.more_solids.clear();
    return one;
  }
  /// The first that is, or the first of all.
  const Solid& first_elastic_solid() const {
    for (std::size_t k = 0; k < solid_count(); ++k)
      if (solid_at(k).is_elastic()) return solid_at(k);
    return solid;
  }
  bool has_solid() const {
    return any_solid([](const Solid& one) { return one.kind != SolidKind::none; });
  }
  bool has_elastic_solid() const {
    return any_solid([](const Solid& one) { return one.is_elastic(); });
  }
  template <class F>
  bool any_solid(F&& f) const {
    for (std::size_t k = 0; k < solid_count(); ++k)
      if (f(solid_at(k))) return true;
    return false;
  }
};

}  // namespace sphdrop
