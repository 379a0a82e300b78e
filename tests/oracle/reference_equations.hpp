#pragma once
// The method's equations in their plainest form, sharing no code with the program: an independent second opinion.

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <span>

#include "tests/support/particle_samples.hpp"

namespace sphdrop::reference {

using Eigen::Matrix2d;
using Eigen::Vector2d;

inline Vector2d as_eigen(Vector v) {
  return {v.x, v.y};
}

/// W (11).
inline double kernel(double r, double h) {
  const double q = r / h, a = 15.0 / (7.0 * std::numbers::pi * h * h);
  if (q < 1) return a * (2.0 / 3.0 - q * q + q * q * q / 2);
  if (q < 2) return a * std::pow(2 - q, 3) / 6;
  return 0;
}

/// Gradient of W with respect to x_i.
inline Vector2d kernel_gradient(const Vector2d& x_ij, double h) {
  const double r = x_ij.norm(), q = r / h, a = 15.0 / (7.0 * std::numbers::pi * h * h);
  if (q == 0 || q >= 2) return Vector2d::Zero();
  const double slope = q < 1 ? a * (-2 * q + 1.5 * q * q) / h : -a * (2 - q) * (2 - q) / (2 * h);
  return slope * x_ij / r;
}

struct Viscosity {
  double alpha, beta, sound_speed;
};

/// Pi_ij (17, 18).
inline double artificial_viscosity(const Viscosity& v, double h, const Vector2d& v_ij, const Vector2d& x_ij,
                                   double density_i, double density_j) {
  if (v_ij.dot(x_ij) >= 0) return 0;
  const double mu = h * v_ij.dot(x_ij) / (x_ij.squaredNorm() + 0.01 * h * h);
  return (-v.alpha * v.sound_speed * mu + v.beta * mu * mu) / (0.5 * (density_i + density_j));
}

/// A sum beside the sum of its terms' magnitudes, which is the scale of its rounding error.
struct Sum {
  double value = 0, magnitude = 0;
  void operator+=(double term) {
    value += term;
    magnitude += std::abs(term);
  }
  void operator+=(const Sum& other) {
    value += other.value;
    magnitude += other.magnitude;
  }
};

struct FluidRates {
  Sum density_rate, acceleration_x, acceleration_y, heating;
};

/// Rates of particle i (9, 12, 17, 18); pressures by (4).
inline FluidRates fluid_rates(std::span<const test::FluidSample> sample, std::size_t i, double h,
                              const Viscosity& viscosity, double sound_speed) {
  const auto pressure = [&](const test::FluidSample& s) {
    return sound_speed * sound_speed * (s.density - test::reference_density);
  };
  FluidRates rates;
  const test::FluidSample& a = sample[i];
  for (std::size_t j = 0; j < sample.size(); ++j) {
    if (j == i) continue;
    const test::FluidSample& b = sample[j];
    const Vector2d x = as_eigen(a.position - b.position), v = as_eigen(a.velocity - b.velocity);
    const Vector2d gradient = kernel_gradient(x, h);
    const double pi = artificial_viscosity(viscosity, h, v, x, a.density, b.density);
    rates.density_rate += b.mass * v.dot(gradient);
    const Vector2d by_pressure = -b.mass * (pressure(a) + pressure(b)) / (a.density * b.density) * gradient;
    const Vector2d by_viscosity = -b.mass * pi * gradient;
    rates.acceleration_x += by_pressure.x();
    rates.acceleration_x += by_viscosity.x();
    rates.acceleration_y += by_pressure.y();
    rates.acceleration_y += by_viscosity.y();
    rates.heating += 0.5 * b.mass * pi * v.dot(gradient);
  }
  return rates;
}

/// Density by first-order moving least squares (13).
inline double moving_least_squares_density(std::span<const test::FluidSample> sample, std::size_t i, double h,
                                           double spacing) {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  const auto basis = [&](std::size_t j) {
    const Vector x = (sample[i].position - sample[j].position) / spacing;
    return Eigen::Vector3d(1, x.x, x.y);
  };
  const auto weight = [&](std::size_t j) { return kernel(length(sample[i].position - sample[j].position), h); };
  bool lone = true;
  for (std::size_t j = 0; j < sample.size(); ++j) {
    a += sample[j].mass / sample[j].density * weight(j) * basis(j) * basis(j).transpose();
    lone = lone && (j == i || weight(j) == 0);
  }
  if (lone) return sample[i].density;
  Eigen::Vector3d beta(1 / a(0, 0), 0, 0);
  if (a.determinant() >= 1e-3 * std::pow(a(0, 0), 3)) beta = a.fullPivLu().solve(Eigen::Vector3d(1, 0, 0));
  double density = 0;
  for (std::size_t j = 0; j < sample.size(); ++j) density += sample[j].mass * beta.dot(basis(j)) * weight(j);
  return density;
}

struct Solid {
  double bulk_modulus, shear_modulus, trace_factor, artificial_stress_coefficient;
};

inline Matrix2d deviatoric_stress(const test::SolidSample& s) {
  return (Matrix2d() << s.tau_xx, s.tau_xy, s.tau_xy, s.tau_yy).finished();
}

/// sigma = -p I + tau, p by (5).
inline Matrix2d total_stress(const test::SolidSample& s, const Solid& solid) {
  const double squared_sound_speed = solid.bulk_modulus / test::reference_density;
  return deviatoric_stress(s) - squared_sound_speed * (s.density - test::reference_density) * Matrix2d::Identity();
}

/// R (20-23), by the angle of Eq 21 and rotations there and back.
inline Matrix2d artificial_stress(const test::SolidSample& s, const Solid& solid) {
  const Matrix2d stress = total_stress(s, solid);
  const double theta = 0.5 * std::atan2(2 * stress(0, 1), stress(0, 0) - stress(1, 1));
  const Matrix2d axes = Eigen::Rotation2Dd(theta).toRotationMatrix();
  const Matrix2d principal = axes.transpose() * stress * axes;
  Matrix2d r = Matrix2d::Zero();
  for (int k = 0; k < 2; ++k)
    if (principal(k, k) > 0) r(k, k) = -solid.artificial_stress_coefficient * principal(k, k) / (s.density * s.density);
  return axes * r * axes.transpose();
}

struct SolidRates {
  Sum density_rate, acceleration_x, acceleration_y, heating;
  Sum gradient[2][2];  // dv^a/dx^b
  Matrix2d deviatoric_stress_rate;
  double stress_rate_magnitude = 0;
  double artificial_stress_power = 0, artificial_stress_power_magnitude = 0;
};

/// Rates of particle i (6-9, 14-23).
inline SolidRates solid_rates(std::span<const test::SolidSample> sample, std::size_t i, double h, double spacing,
                              const Viscosity& viscosity, const Solid& solid) {
  SolidRates rates;
  const test::SolidSample& a = sample[i];
  Sum artificial_x, artificial_y;
  for (std::size_t j = 0; j < sample.size(); ++j) {
    if (j == i) continue;
    const test::SolidSample& b = sample[j];
    const Vector2d x = as_eigen(a.position - b.position), v = as_eigen(a.velocity - b.velocity);
    const Vector2d gradient = kernel_gradient(x, h);
    const double pi = artificial_viscosity(viscosity, h, v, x, a.density, b.density);
    rates.density_rate += b.mass * v.dot(gradient);
    for (int c = 0; c < 2; ++c)
      for (int e = 0; e < 2; ++e) rates.gradient[c][e] += b.mass / b.density * -v[c] * gradient[e];
    const Matrix2d stress = (total_stress(a, solid) + total_stress(b, solid)) / (a.density * b.density);
    const double f = kernel(x.norm(), h) / kernel(spacing, h);
    const Matrix2d artificial = std::pow(f, 4) * (artificial_stress(a, solid) + artificial_stress(b, solid));
    for (int e = 0; e < 2; ++e) {
      rates.acceleration_x += b.mass * stress(0, e) * gradient[e];
      rates.acceleration_y += b.mass * stress(1, e) * gradient[e];
      artificial_x += b.mass * artificial(0, e) * gradient[e];
      artificial_y += b.mass * artificial(1, e) * gradient[e];
    }
    rates.acceleration_x += -b.mass * pi * gradient.x();
    rates.acceleration_y += -b.mass * pi * gradient.y();
    rates.heating += 0.5 * b.mass * pi * v.dot(gradient);
  }
  rates.acceleration_x += artificial_x;
  rates.acceleration_y += artificial_y;
  rates.artificial_stress_power = a.velocity.x * artificial_x.value + a.velocity.y * artificial_y.value;
  rates.artificial_stress_power_magnitude =
      std::abs(a.velocity.x) * artificial_x.magnitude + std::abs(a.velocity.y) * artificial_y.magnitude;

  Matrix2d l;
  for (int c = 0; c < 2; ++c)
    for (int e = 0; e < 2; ++e) {
      l(c, e) = rates.gradient[c][e].value;
      rates.stress_rate_magnitude += rates.gradient[c][e].magnitude;
    }
  const Matrix2d tau = deviatoric_stress(a);
  rates.stress_rate_magnitude *= 2 * solid.shear_modulus + tau.norm();
  const Matrix2d strain_rate = 0.5 * (l + l.transpose()), rotation_rate = 0.5 * (l - l.transpose());
  rates.deviatoric_stress_rate =
      2 * solid.shear_modulus * (strain_rate - solid.trace_factor * strain_rate.trace() * Matrix2d::Identity()) +
      rotation_rate * tau - tau * rotation_rate;
  return rates;
}

}  // namespace sphdrop::reference
