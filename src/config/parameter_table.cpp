#include "config/parameter_table.hpp"

#include <algorithm>
#include <vector>

namespace sphdrop {
namespace {

template <auto Section, auto Member>
constexpr auto& member_of(Case& values) {
  return values.*Section.*Member;
}

template <auto Section, auto Member>
constexpr RealParameter real(std::variant<Required, Automatic, double> fallback, Range range) {
  return {member_of<Section, Member>, fallback, range};
}

template <auto Section, auto Member>
constexpr IntegerParameter integer(std::int64_t fallback, std::int64_t lower, std::int64_t upper,
                                   std::span<const std::int64_t> choices = {}) {
  return {member_of<Section, Member>, fallback, lower, upper, choices};
}

template <auto Section, auto X, auto Y>
constexpr VectorParameter vector(std::array<double, 2> fallback, Range range) {
  return {member_of<Section, X>, member_of<Section, Y>, fallback, range};
}

template <auto Section, auto Member, typename Enumeration>
constexpr WordParameter word(std::span<const std::string_view> words, Enumeration fallback) {
  return {words, [](const Case& values) { return static_cast<std::size_t>(values.*Section.*Member); },
          [](Case& values, std::size_t position) { values.*Section.*Member = static_cast<Enumeration>(position); },
          static_cast<std::size_t>(fallback)};
}

template <auto Member>
constexpr TextParameter drop_text(std::string_view meaning) {
  return {[](Case& values) -> std::string& { return values.drop.*Member; }, Automatic{meaning}, true};
}

template <auto Member>
constexpr PointsParameter points(Range range, std::string_view none = "") {
  return {[](Case& values) -> Points& { return values.solid.*Member; }, range, none};
}

constexpr Range positive(double upper) {
  return {0, false, upper, true};
}
constexpr Range non_negative(double upper) {
  return {0, true, upper, true};
}
constexpr Range either_sign(double bound) {
  return {-bound, true, bound, true};
}

// The words of each enumeration, in the order of its enumerators (config/case.hpp).
constexpr std::string_view mode_words[] = {"paper", "modern", "fast"};
constexpr std::string_view shape_words[] = {"none", "round", "square", "ellipse", "particles"};
constexpr std::string_view arrangement_words[] = {"rings", "lattice"};
constexpr std::string_view placement_words[] = {"above_solid", "centre", "file"};
constexpr std::string_view material_words[] = {"liquid", "rigid"};
constexpr std::string_view solid_words[] = {"none",       "cantilever", "fixed_fixed_beam",
                                            "rigid_wall", "polygon",    "obstacle"};
constexpr std::string_view formulation_words[] = {"auto", "hypoelastic", "cells", "total_lagrangian"};
constexpr std::string_view law_words[] = {"st_venant_kirchhoff", "neo_hookean"};
constexpr std::string_view clamp_words[] = {"strips", "ideal"};
constexpr std::string_view trace_words[] = {"plane_strain", "two_dimensional"};
constexpr std::string_view stiffness_words[] = {"time_step", "fixed"};
constexpr std::string_view form_words[] = {"none", "conservative", "curvature"};
constexpr std::string_view kernel_words[] = {"cubic_spline", "wendland_c2"};
constexpr std::string_view viscosity_words[] = {"artificial", "physical"};
constexpr std::string_view density_words[] = {"none", "moving_least_squares", "density_diffusion"};
constexpr std::string_view motion_words[] = {"absolute", "relative"};
constexpr std::string_view switch_words[] = {"off", "on"};

constexpr std::int64_t stencil_choices[] = {3, 5};

// Upper limits that no physics sets: they catch slips of units and keep products of parameters finite.
constexpr double largest_length = 100;            // m
constexpr double largest_time = 1e4;              // s
constexpr double largest_speed = 1e5;             // m/s
constexpr double largest_density = 1e6;           // kg/m3
constexpr double largest_spin = 1e9;              // rad/s
constexpr double largest_ambient_pressure = 1e6;  // Pa
constexpr std::int64_t most_steps = 1000000000;
constexpr std::int64_t most_substeps = 20;

using C = Case;

constexpr Parameter table[] = {
    {"name", "", "-",
     TextParameter{[](C& c) -> std::string& { return c.name; }, {"the case file's name without its ending"}},
     "name of the run: the start of its files' names"},
    {"mode", "", "-",
     WordParameter{mode_words, [](const C& c) { return static_cast<std::size_t>(c.mode); },
                   [](C& c, std::size_t position) { c.mode = static_cast<Mode>(position); }, 0},
     "scheme that parameters left to themselves choose: paper = as printed, completed where the print is silent; "
     "modern = what works better; fast = modern with the longest steps that were measured to leave its results as they "
     "are"},

    {"resolution.spacing", "d_ini", "m",
     real<&C::resolution, &C::Resolution::spacing>(Required{}, positive(largest_length)),
     "particle spacing d at the start"},
    {"resolution.smoothing_ratio", "h/d_ini", "-",
     real<&C::resolution, &C::Resolution::smoothing_ratio>(1.2, {1, true, 2, true}),
     "smoothing length over particle spacing"},
    {"resolution.kernel", "W", "-",
     word<&C::resolution, &C::Resolution::kernel>(kernel_words, KernelShape::cubic_spline),
     "smoothing kernel of the liquid: cubic_spline = Eq 11; wendland_c2 has the same support 2h and wants a "
     "smoothing_ratio of 1.5. The solid's is the spline"},

    {"time.end", "t", "s", real<&C::time, &C::Time::end>(Required{}, positive(largest_time)),
     "simulated time at which the run ends"},
    {"time.step", "dt", "s",
     real<&C::time, &C::Time::step>(Automatic{"0: Eqs 40-42, every step"}, non_negative(largest_time)),
     "fixed time step; 0 = the smallest of Eqs 40-42"},
    {"time.sound_cfl", "", "-",
     real<&C::time, &C::Time::sound_cfl>(
         Automatic{
             "0.1; mode modern: 0.4, less where the step would be more than 0.2 by the liquid's sound; mode fast: "
             "the same, and 0.5 of a solid that takes sub-steps"},
         positive(1)),
     "factor of Eq 40 (sound); of a solid that takes sub-steps, for those"},
    {"time.liquid_sound_cfl", "", "-", real<&C::time, &C::Time::liquid_sound_cfl>(0.25, positive(1)),
     "factor of Eq 40 for the liquid where solid_substeps is more than 1; elsewhere sound_cfl holds for both"},
    {"time.solid_substeps", "", "-", integer<&C::time, &C::Time::solid_substeps>(1, 0, most_substeps),
     "equal steps that the solid takes in one step of liquid, surface tension and contact, whose reaction it gets as "
     "one impulse; more than 1 needs a liquid drop and a beam of cells or total_lagrangian; 0 = as many as the "
     "liquid's sound allows, at most 3"},
    {"time.capillary_cfl", "", "-", real<&C::time, &C::Time::capillary_cfl>(0.1, positive(1)),
     "factor of Eq 41 (capillary waves)"},
    {"time.viscous_cfl", "", "-", real<&C::time, &C::Time::viscous_cfl>(0.1, positive(1)),
     "factor of Eq 42 (viscosity)"},

    {"fluid.density", "rho0", "kg/m3", real<&C::fluid, &C::Fluid::density>(1000.0, positive(largest_density)),
     "the liquid's density at rest"},
    {"fluid.viscosity", "mu", "Pa s", real<&C::fluid, &C::Fluid::viscosity>(0.001, non_negative(1e4)),
     "the liquid's viscosity; enters the time step (Eq 42), and the forces where viscosity_form = physical"},
    {"fluid.viscosity_form", "", "-",
     word<&C::fluid, &C::Fluid::viscosity_form>(viscosity_words, ViscosityForm::artificial),
     "artificial = Eqs 17, 18 with alpha and beta; physical = that of a Newtonian liquid with fluid.viscosity, without "
     "alpha and beta (Monaghan & Cleary)"},
    {"fluid.sound_speed", "c_f", "m/s", real<&C::fluid, &C::Fluid::sound_speed>(50.0, positive(largest_speed)),
     "the liquid's numerical sound speed (Eq 4), about 50 times the largest speed expected; with a rigid drop and no "
     "beam it still sets the time step (Eq 40)"},
    {"fluid.artificial_viscosity_alpha", "alpha", "-",
     real<&C::fluid, &C::Fluid::artificial_viscosity_alpha>(0.1, non_negative(100)),
     "linear artificial viscosity of the liquid (Eq 17), where viscosity_form = artificial"},
    {"fluid.artificial_viscosity_beta", "beta", "-",
     real<&C::fluid, &C::Fluid::artificial_viscosity_beta>(0.0, non_negative(100)),
     "quadratic artificial viscosity of the liquid (Eq 17), where viscosity_form = artificial"},
    {"fluid.density_treatment", "", "-",
     word<&C::fluid, &C::Fluid::density_treatment>(density_words, DensityTreatment::moving_least_squares),
     "what keeps the density smooth: moving_least_squares = Eq 13 now and then, density_diffusion = delta-SPH "
     "(Antuono et al. 2010) in every step"},
    {"fluid.density_correction_interval", "", "steps",
     integer<&C::fluid, &C::Fluid::density_correction_interval>(20, 0, most_steps),
     "steps between density corrections by moving least squares (Eq 13); 0 = never"},
    {"fluid.density_diffusion", "delta", "-", real<&C::fluid, &C::Fluid::density_diffusion>(0.1, non_negative(1)),
     "strength of the density diffusion"},
    {"fluid.gauge_pressure", "", "-", word<&C::fluid, &C::Fluid::gauge_pressure>(switch_words, Switch::off),
     "on = the drop's pressure is counted from a reference near its smallest, which acts on its surface: the "
     "particles' "
     "lattice does not stiffen under it"},
    {"fluid.gauge_relaxation_time", "", "s",
     real<&C::fluid, &C::Fluid::gauge_relaxation_time>(20e-6, positive(largest_time)),
     "time in which that reference follows the drop's pressure"},
    {"fluid.ambient_pressure", "", "Pa",
     real<&C::fluid, &C::Fluid::ambient_pressure>(0.0, non_negative(largest_ambient_pressure)),
     "how far below zero that reference may fall: the air's pressure, which keeps liquid under tension from tearing; a "
     "small one does, such as the pressure of the drop at rest, 2 sigma/diameter; 0 = none"},
    {"fluid.shifting", "", "-", word<&C::fluid, &C::Fluid::shifting>(switch_words, Switch::off),
     "on = particles are shifted a little from crowded to empty places, along the surface near it, so that they do not "
     "clump"},
    {"fluid.shifting_interval", "", "steps", integer<&C::fluid, &C::Fluid::shifting_interval>(4, 1, most_steps),
     "steps between shifts"},

    {"drop.shape", "", "-", word<&C::drop, &C::Drop::shape>(shape_words, DropShape::round),
     "the drop's shape at the start; particles = what particles_file holds, and that is the default where it is given"},
    {"drop.particles_file", "", "-", drop_text<&C::Drop::particles_file>("none"),
     "file with the drop's particles, beside the case file or with an absolute path: CSV with the columns x and y and, "
     "if wanted, vx, vy and mass; HDF5 with position, velocity and mass; or a snapshot, whose drop it is"},
    {"drop.particles_checksum", "", "-", drop_text<&C::Drop::particles_checksum>("that of particles_file"),
     "XXH3 (128 bits) of that file's bytes; a file with another one is refused"},
    {"drop.arrangement", "", "-", word<&C::drop, &C::Drop::arrangement>(arrangement_words, DropArrangement::rings),
     "how a round drop's particles start: concentric rings, or cut out of the square lattice"},
    {"drop.material", "", "-", word<&C::drop, &C::Drop::material>(material_words, DropMaterial::liquid),
     "liquid, or rigid = a ball that moves as one rigid body (Sec. 4.4), without surface tension and viscosity"},
    {"drop.density", "", "kg/m3",
     real<&C::drop, &C::Drop::density>(Automatic{"fluid.density"}, positive(largest_density)),
     "a rigid drop's density"},
    {"drop.diameter", "D0", "m", real<&C::drop, &C::Drop::diameter>(1e-3, positive(largest_length)),
     "diameter of a round drop, of the circle of the same area of an ellipse, side of a square; of particles without "
     "masses the diameter of the circle whose area they share, by default spacing^2 each"},
    {"drop.aspect_ratio", "", "-", real<&C::drop, &C::Drop::aspect_ratio>(1.5, {0.1, true, 10, true}),
     "an ellipse's width over its height; its area is that of a circle of the diameter"},
    {"drop.velocity", "U0", "m/s",
     vector<&C::drop, &C::Drop::velocity_x, &C::Drop::velocity_y>({0, 0}, either_sign(largest_speed)),
     "the drop's velocity at the start, to which that of a file's particles is added; downwards is negative y"},
    {"drop.gap", "", "m",
     real<&C::drop, &C::Drop::gap>(Automatic{"0.1 spacing beyond the contact distance"}, non_negative(largest_length)),
     "distance between the surfaces of drop and solid at the start"},
    {"drop.centre_x", "", "m",
     real<&C::drop, &C::Drop::centre_x>(
         Automatic{
             "cantilever: length - diameter/2; fixed_fixed_beam: mid-span; polygon, obstacle: its middle; else 0"},
         either_sign(largest_length)),
     "x of the drop's centre; 0 is the left clamp's edge, or the middle of a rigid wall"},
    {"drop.placement", "", "-", word<&C::drop, &C::Drop::placement>(placement_words, DropPlacement::above_solid),
     "above_solid = the gap above the solid's surface, centre = the centre at centre_y, file = where particles_file "
     "has "
     "it, and that is the default of one unless gap, centre_x or centre_y is given"},
    {"drop.centre_y", "", "m", real<&C::drop, &C::Drop::centre_y>(0.0, either_sign(largest_length)),
     "y of the drop's centre without a solid or where placement says so; 0 is a beam's underside, or a rigid wall's "
     "surface"},
    {"drop.jitter", "", "d_ini", real<&C::drop, &C::Drop::jitter>(0.01, {0, true, 0.3, true}),
     "largest random displacement of a lattice start, in spacings; a rigid drop has none"},
    {"drop.seed", "", "-", integer<&C::drop, &C::Drop::seed>(1, 0, std::numeric_limits<std::int64_t>::max()),
     "seed of the jitter"},
    {"drop.oscillation_velocity", "V0", "m/s",
     real<&C::drop, &C::Drop::oscillation_velocity>(0.0, either_sign(largest_speed)),
     "amplitude of the oscillating drop's initial velocity field; 0 = none"},
    {"drop.oscillation_radius", "r0", "m",
     real<&C::drop, &C::Drop::oscillation_radius>(0.25e-3, positive(largest_length)),
     "decay length of the oscillating drop's initial velocity field"},
    {"drop.initial_spin", "", "rad/s", real<&C::drop, &C::Drop::initial_spin>(0.0, either_sign(largest_spin)),
     "a rigid drop's angular velocity at the start, counterclockwise"},
    {"drop.relaxation_time", "", "s", real<&C::drop, &C::Drop::relaxation_time>(0.0, non_negative(largest_time)),
     "so long before t = 0 a liquid drop is left to itself at rest, damped and without gravity, so that its particles "
     "settle; its velocity is given to it at t = 0"},

    {"solid.kind", "", "-", word<&C::solid, &C::Solid::kind>(solid_words, SolidKind::none),
     "what the drop meets: polygon = an elastic body of any outline, obstacle = a rigid one. Each of several is a "
     "section [[solid]]"},
    {"solid.polygon", "", "m", points<&C::Solid::polygon>(either_sign(largest_length)),
     "corners of a polygon or an obstacle in their order, either way round. The particles of a polygon stand on the "
     "square lattice with corners at whole spacings; area and mass are the polygon's own"},
    {"solid.clamps", "", "m",
     RegionsParameter{[](C& c) -> std::vector<Points>& { return c.solid.clamps; }, either_sign(largest_length)},
     "parts of the plane in which a polygon is held, each a list of points: two = opposite corners of a box, more = a "
     "polygon"},
    {"solid.lattice_direction", "", "-",
     vector<&C::solid, &C::Solid::lattice_x, &C::Solid::lattice_y>({1, 0}, either_sign(1e6)),
     "direction of the rows of a polygon's particles; best that of its long sides, where those are oblique"},
    {"solid.pinned", "", "m", points<&C::Solid::pinned>(either_sign(largest_length)),
     "places where an elastic solid is held in both directions, free to turn: its nearest particle is"},
    {"solid.held_in_x", "", "m", points<&C::Solid::held_in_x>(either_sign(largest_length)),
     "places where it is held in x alone, a roller"},
    {"solid.held_in_y", "", "m", points<&C::Solid::held_in_y>(either_sign(largest_length)),
     "places where it is held in y alone, a roller"},
    {"solid.probe", "", "m",
     points<&C::Solid::probe>(either_sign(largest_length),
                              "the free end or mid-span of a beam; of a polygon the particle farthest from held ones"),
     "places whose mean displacement is the deflection of an elastic solid"},
    {"solid.origin", "", "m",
     vector<&C::solid, &C::Solid::origin_x, &C::Solid::origin_y>({0, 0}, either_sign(largest_length)),
     "by how much the whole solid is moved, with all the places given for it; the beam's or wall's own zero"},
    {"solid.length", "L", "m",
     real<&C::solid, &C::Solid::length>(
         Automatic{"rigid_wall: 8 drop diameters; polygon, obstacle: the longer extent; a beam must give it"},
         positive(10 * largest_length)),
     "a beam's free length, from the clamp's edge or between the clamps' edges; a rigid wall's width"},
    {"solid.thickness", "H", "m", real<&C::solid, &C::Solid::thickness>(0.25e-3, positive(largest_length)),
     "the beam's thickness"},
    {"solid.density", "rho_b", "kg/m3", real<&C::solid, &C::Solid::density>(1000.0, positive(largest_density)),
     "the beam's density"},
    {"solid.youngs_modulus", "E", "Pa", real<&C::solid, &C::Solid::youngs_modulus>(300e6, positive(1e14)),
     "the beam's Young's modulus"},
    {"solid.poisson_ratio", "nu", "-", real<&C::solid, &C::Solid::poisson_ratio>(0.3, {-1, false, 0.5, false}),
     "the beam's Poisson's ratio"},
    {"solid.formulation", "", "-",
     word<&C::solid, &C::Solid::formulation>(formulation_words, SolidFormulation::automatic),
     "how the beam's stress is computed: hypoelastic = the paper's (Eqs 6-9, 14-23), cells = bilinear cells on the "
     "same particles, total_lagrangian = kernel sums over the undeformed body; auto = hypoelastic, in mode modern "
     "cells"},
    {"solid.material_law", "", "-",
     word<&C::solid, &C::Solid::material_law>(law_words, MaterialLaw::st_venant_kirchhoff),
     "elastic law of a beam that is not hypoelastic, in plane strain"},
    {"solid.deviatoric_trace", "", "-",
     word<&C::solid, &C::Solid::deviatoric_trace>(trace_words, DeviatoricTrace::plane_strain),
     "share of tr(e) taken off in Eq 6, hypoelastic only: plane_strain = 1/3, two_dimensional = 1/2"},
    {"solid.artificial_viscosity_alpha", "alpha", "-",
     real<&C::solid, &C::Solid::artificial_viscosity_alpha>(2.0, non_negative(100)),
     "linear artificial viscosity of a hypoelastic beam (Eq 17)"},
    {"solid.artificial_viscosity_beta", "beta", "-",
     real<&C::solid, &C::Solid::artificial_viscosity_beta>(0.0, non_negative(100)),
     "quadratic artificial viscosity of a hypoelastic beam (Eq 17)"},
    {"solid.artificial_stress_coefficient", "eps", "-",
     real<&C::solid, &C::Solid::artificial_stress_coefficient>(0.2, non_negative(1)),
     "artificial stress of a hypoelastic beam (Eq 20); the paper's 0.5 is unstable at h = 1.2 d"},
    {"solid.clamp", "", "-", word<&C::solid, &C::Solid::clamp>(clamp_words, Clamp::strips),
     "strips = the beam's end is free to move between two strips of held particles, as in the paper; ideal = its "
     "particles in the clamp are held themselves, as those of a polygon always are"},
    {"solid.clamp_length", "", "m",
     real<&C::solid, &C::Solid::clamp_length>(Automatic{"2 thicknesses"}, positive(2 * largest_length)),
     "length of the beam in a clamp, and of the clamp's strips"},
    {"solid.clamp_layers", "", "-", integer<&C::solid, &C::Solid::clamp_layers>(3, 1, 1000),
     "particles across a clamp's strip; an ideal clamp has none"},
    {"solid.damping_rate", "", "1/s", real<&C::solid, &C::Solid::damping_rate>(0.0, non_negative(1e6)),
     "mass-proportional damping of the beam, a = -damping_rate v, to bring it to rest: of a mode of angular frequency "
     "omega the damping ratio is damping_rate/(2 omega), so that 2 omega is critical; 0 = none"},
    {"solid.damping_ratio", "", "-", real<&C::solid, &C::Solid::damping_ratio>(0.0, non_negative(10)),
     "damping of the beam's first bending mode, of critical, by as much more mass-proportional damping: 2 "
     "damping_ratio "
     "omega with omega of beam theory"},
    {"solid.viscous_time", "", "s", real<&C::solid, &C::Solid::viscous_time>(0.0, non_negative(1)),
     "stiffness-proportional damping of a beam that is not hypoelastic (Kelvin and Voigt): viscous stress = "
     "viscous_time x the "
     "elastic "
     "stress of the strain rate; of a mode of angular frequency omega the damping ratio is viscous_time omega/2; it "
     "shortens the time step"},
    {"solid.initial_tip_velocity", "", "m/s",
     real<&C::solid, &C::Solid::initial_tip_velocity>(0.0, either_sign(largest_speed)),
     "speed of a cantilever's tip in its first bending mode at the start; upwards is positive"},

    {"contact.stiffness_form", "", "-",
     word<&C::contact, &C::Contact::stiffness_form>(stiffness_words, ContactStiffness::time_step),
     "what the contact force is in proportion to: time_step = 1/dt^2 (Eq 24), fixed = rho c^2 of what yields (the "
     "liquid; "
     "with a rigid drop the beam), whatever the time step"},
    {"contact.stiffness", "", "-",
     real<&C::contact, &C::Contact::stiffness>(Automatic{"0.1 for time_step, 0.3 for fixed"}, positive(100)),
     "factor of the contact force (Eq 24): time_step: the acceleration is stiffness overlap/dt^2; fixed: the force is "
     "stiffness rho c^2 overlap"},
    {"contact.damping_ratio", "", "-", real<&C::contact, &C::Contact::damping_ratio>(0.0, non_negative(1)),
     "damping of a particle's motion along the normal while in contact; 1 = critical, 0 = none"},
    {"contact.wall_drag", "", "-", real<&C::contact, &C::Contact::wall_drag>(0.0, non_negative(1000)),
     "drag on particles in contact, in units of mu/(rho d^2) times their velocity along the wall; 1 = a no-slip "
     "wall's, 0 = "
     "none: the wall is smooth"},
    {"contact.distance_ratio", "d0/d_ini", "-", real<&C::contact, &C::Contact::distance_ratio>(1.0, positive(2)),
     "distance at which contact begins, in spacings"},
    {"contact.overlap_limit", "", "d0",
     real<&C::contact, &C::Contact::overlap_limit>(Automatic{"0.2 for time_step, 0.5 for fixed"}, positive(1)),
     "overlap at which the run stops, in contact distances"},

    {"surface_tension.form", "", "-",
     word<&C::surface_tension, &C::SurfaceTension::form>(form_words, SurfaceTensionForm::conservative),
     "conservative = minus the gradient of sigma x curve length, curvature = Eqs 28-31"},
    {"surface_tension.coefficient", "sigma", "N/m",
     real<&C::surface_tension, &C::SurfaceTension::coefficient>(0.072, non_negative(100)), "surface tension"},
    {"surface_tension.contact_angle", "theta", "deg",
     real<&C::surface_tension, &C::SurfaceTension::contact_angle>(180.0, {0, false, 180, true}),
     "angle at which the liquid meets the solid: below 90 it wets it, at 180, as in the paper, nothing holds it there"},
    {"surface_tension.polynomial_points", "", "-",
     integer<&C::surface_tension, &C::SurfaceTension::polynomial_points>(3, 3, 5, stencil_choices),
     "surface points of the local polynomial (Eq 28); used by the curvature form"},
    {"surface_tension.detection_motion", "", "-",
     word<&C::surface_tension, &C::SurfaceTension::detection_motion>(motion_words, DetectionMotion::absolute),
     "what detection_displacement counts: absolute = a particle's whole motion; relative = its motion against the drop "
     "as a whole, which leaves a drop in flight alone; with contact_angle < 180 the whole motion counts all the same"},
    {"surface_tension.detection_displacement", "", "d_ini",
     real<&C::surface_tension, &C::SurfaceTension::detection_displacement>(0.03, non_negative(0.5)),
     "the surface curve is detected anew once a particle has moved this far; 0 = every step"},

    {"gravity.acceleration", "g", "m/s2", vector<&C::gravity, &C::Gravity::x, &C::Gravity::y>({0, 0}, either_sign(1e6)),
     "acceleration of gravity; downwards is negative y"},

    {"output.directory", "", "-",
     TextParameter{[](C& c) -> std::string& { return c.output.directory; }, {"results/<name>"}},
     "folder of the results"},
    {"output.snapshot_interval", "", "s",
     real<&C::output, &C::Output::snapshot_interval>(1e-4, non_negative(largest_time)),
     "simulated time between snapshots of all particles; 0 = only the first and the last"},
    {"output.history_interval", "", "s", real<&C::output, &C::Output::history_interval>(2e-6, positive(largest_time)),
     "simulated time between rows of the history"},

    {"checkpoint.interval", "", "s", real<&C::checkpoint, &C::Checkpoint::interval>(0.0, non_negative(largest_time)),
     "simulated time between checkpoints; 0 = none for it"},
    {"checkpoint.wall_interval", "", "s", real<&C::checkpoint, &C::Checkpoint::wall_interval>(600.0, non_negative(1e9)),
     "wall time between checkpoints; 0 = none for it"},
    {"checkpoint.keep", "", "-", integer<&C::checkpoint, &C::Checkpoint::keep>(2, 1, 1000000),
     "the newest checkpoints that are kept"},

    {"parallel.skin", "", "d_ini", real<&C::parallel, &C::Parallel::skin>(0.3, positive(5)),
     "neighbour lists reach this far beyond the support 2h, in spacings"},
    {"parallel.imbalance_threshold", "", "-",
     real<&C::parallel, &C::Parallel::imbalance_threshold>(1.1, {1, false, 1000, true}),
     "largest over mean load of a process from which the particles are dealt out anew"},
    {"parallel.repartition_interval", "", "steps",
     integer<&C::parallel, &C::Parallel::repartition_interval>(0, 0, most_steps),
     "steps between forced repartitions; 0 = none"},
    {"parallel.cells_per_process", "", "-", integer<&C::parallel, &C::Parallel::cells_per_process>(64, 1, 1000000),
     "particles are dealt out by cells as wide as the lists reach, or wider as long as a process has so many of them"},

    {"safety.speed_limit", "", "m/s",
     real<&C::safety, &C::Safety::speed_limit>(Automatic{"fluid.sound_speed"}, positive(10 * largest_speed)),
     "a faster particle stops the run"},
    {"safety.domain_margin", "", "m",
     real<&C::safety, &C::Safety::domain_margin>(Automatic{"twice the farthest free flight plus the largest body"},
                                                 positive(1e18)),
     "a particle this far outside the box of the initial particles stops the run"},
};

std::vector<std::string_view> sections_of_table() {
  std::vector<std::string_view> names;
  for (const Parameter& parameter : table) {
    const std::string_view section = parameter.section();
    if (!section.empty() && (names.empty() || names.back() != section)) names.push_back(section);
  }
  return names;
}

}  // namespace

std::string_view Parameter::section() const {
  const std::size_t dot = key.find('.');
  return dot == std::string_view::npos ? std::string_view{} : key.substr(0, dot);
}

std::string_view Parameter::name() const {
  const std::size_t dot = key.find('.');
  return dot == std::string_view::npos ? key : key.substr(dot + 1);
}

std::span<const Parameter> parameter_table() {
  return table;
}

const Parameter* find_parameter(std::string_view key) {
  const auto found = std::find_if(std::begin(table), std::end(table), [&](const Parameter& p) { return p.key == key; });
  return found == std::end(table) ? nullptr : &*found;
}

std::span<const std::string_view> section_names() {
  static const std::vector<std::string_view> names = sections_of_table();
  return names;
}

}  // namespace sphdrop
