#pragma once
// What theory says of beams and drops (Eqs 43-47 and the drop's capillary numbers): pure functions, per metre of depth.

namespace sphdrop {

/// A beam of rectangular section, per metre of depth.
struct BeamProperties {
  double youngs_modulus = 0;  ///< E, Pa
  double poisson_ratio = 0;   ///< nu
  double density = 0;         ///< rho, kg/m3
  double length = 0;          ///< L, free length, m
  double thickness = 0;       ///< H, m
};

/// M_b = rho H L, kg/m.
double beam_mass(const BeamProperties& beam);

/// First angular frequency of a cantilever in plane strain, rad/s (Eq 43). The factor is the square of the first root
/// of 1 + cos x cosh x, 3.51602; the paper prints 3.52.
double cantilever_angular_frequency(const BeamProperties& beam);

/// First angular frequency of a beam clamped at both ends, rad/s: Eq 43 with the first root of 1 - cos x cosh
/// x, 4.73004.
double fixed_fixed_angular_frequency(const BeamProperties& beam);

/// How far the free end of a cantilever sinks under its own weight at rest, m: w L^4/(8 D) with w = rho g H and D =
/// E H^3/(12 (1 - nu^2)), for slopes that are small. gravity g in m/s2, a positive depth for a positive g.
double cantilever_depth_under_weight(const BeamProperties& beam, double gravity);

/// The same of the middle of a beam clamped at both ends: w L^4/(384 D).
double fixed_fixed_depth_under_weight(const BeamProperties& beam, double gravity);

/// Share of the critical damping that damping in proportion to mass, a = -rate v, gives to a mode: rate/(2 omega). 1/s
/// and rad/s.
double damping_ratio(double rate, double angular_frequency);

/// Period of an angular frequency, s: tau0 where that is the cantilever's (Eq 44).
double period_of(double angular_frequency);

/// m = rho pi D0^2 / 4, kg/m.
double round_drop_mass(double density, double diameter);

/// Largest deflection of a cantilever struck at its free end, m (Eq 46): tau0 m U0 / (4 (m + M_b/2)), a positive depth.
/// drop_mass in kg/m, impact_speed U0 in m/s.
double cantilever_largest_deflection(const BeamProperties& beam, double drop_mass, double impact_speed);

/// chi = delta_max / L (Eq 47), for the depth of Eq 46 as well as for a measured one.
double relative_deflection(double largest_deflection, double length);

/// Period of a two-dimensional drop's small oscillations in its lowest mode without viscosity, s: 2 pi sqrt(rho R^3/(6
/// sigma)) (Rayleigh's omega^2 = n (n^2 - 1) sigma/(rho R^3) with n = 2).
double drop_oscillation_period(double density, double radius, double surface_tension);

/// sigma / R, Pa: the pressure in a two-dimensional drop at rest over that outside.
double laplace_pressure(double surface_tension, double radius);

/// Radius of the circle that has the area of a square of the given side, m.
double equal_area_radius(double square_side);

/// We = rho U^2 D / sigma.
double weber_number(double density, double speed, double diameter, double surface_tension);

/// Re = rho U D / mu.
double reynolds_number(double density, double speed, double diameter, double viscosity);

/// Bo = rho g D^2 / sigma, with the diameter as its length.
double bond_number(double density, double gravity, double diameter, double surface_tension);

}  // namespace sphdrop
