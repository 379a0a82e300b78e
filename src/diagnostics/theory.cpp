#include "diagnostics/theory.hpp"

#include <cmath>
#include <numbers>

namespace sphdrop {

namespace {

using std::numbers::pi;

constexpr double cantilever_root = 1.8751040687119611;   // 1 + cos x cosh x = 0
constexpr double fixed_fixed_root = 4.7300407448627040;  // 1 - cos x cosh x = 0

/// E I/(1 - nu^2) with I = H^3/12 per metre of depth, N m.
double bending_stiffness(const BeamProperties& beam) {
  const double second_moment = beam.thickness * beam.thickness * beam.thickness / 12.0;
  return beam.youngs_modulus * second_moment / (1.0 - beam.poisson_ratio * beam.poisson_ratio);
}

/// root^2 sqrt(E I / (M_b L^3 (1 - nu^2))) (Eq 43).
double angular_frequency(const BeamProperties& beam, double root) {
  const double length_cubed = beam.length * beam.length * beam.length;
  return root * root * std::sqrt(bending_stiffness(beam) / (beam_mass(beam) * length_cubed));
}

/// w L^4/D, m.
double depth_scale_under_weight(const BeamProperties& beam, double gravity) {
  return beam_mass(beam) * gravity * beam.length * beam.length * beam.length / bending_stiffness(beam);
}

}  // namespace

double beam_mass(const BeamProperties& beam) {
  return beam.density * beam.thickness * beam.length;
}

double cantilever_angular_frequency(const BeamProperties& beam) {
  return angular_frequency(beam, cantilever_root);
}

double fixed_fixed_angular_frequency(const BeamProperties& beam) {
  return angular_frequency(beam, fixed_fixed_root);
}

double cantilever_depth_under_weight(const BeamProperties& beam, double gravity) {
  return depth_scale_under_weight(beam, gravity) / 8.0;
}

double fixed_fixed_depth_under_weight(const BeamProperties& beam, double gravity) {
  return depth_scale_under_weight(beam, gravity) / 384.0;
}

double damping_ratio(double rate, double angular_frequency) {
  return rate / (2.0 * angular_frequency);
}

double period_of(double angular_frequency) {
  return 2.0 * pi / angular_frequency;
}

double round_drop_mass(double density, double diameter) {
  return density * pi * diameter * diameter / 4.0;
}

double cantilever_largest_deflection(const BeamProperties& beam, double drop_mass, double impact_speed) {
  const double tau0 = period_of(cantilever_angular_frequency(beam));
  return tau0 * drop_mass * impact_speed / (4.0 * (drop_mass + beam_mass(beam) / 2.0));
}

double relative_deflection(double largest_deflection, double length) {
  return largest_deflection / length;
}

double drop_oscillation_period(double density, double radius, double surface_tension) {
  return 2.0 * pi * std::sqrt(density * radius * radius * radius / (6.0 * surface_tension));
}

double laplace_pressure(double surface_tension, double radius) {
  return surface_tension / radius;
}

double equal_area_radius(double square_side) {
  return square_side / std::sqrt(pi);
}

double weber_number(double density, double speed, double diameter, double surface_tension) {
  return density * speed * speed * diameter / surface_tension;
}

double reynolds_number(double density, double speed, double diameter, double viscosity) {
  return density * speed * diameter / viscosity;
}

double bond_number(double density, double gravity, double diameter, double surface_tension) {
  return density * gravity * diameter * diameter / surface_tension;
}

}  // namespace sphdrop
