#include "diagnostics/frequency.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace sphdrop {

namespace {

using std::numbers::pi;

/// Time counted from the first sample in units of the whole duration: keeps the fits well conditioned.
struct ScaledSignal {
  std::vector<double> u, y;
  double first, duration;
};

ScaledSignal scaled(std::span<const double> times, std::span<const double> values) {
  if (times.size() != values.size()) throw std::invalid_argument("a signal needs as many times as values");
  if (times.size() < 8) throw std::invalid_argument("a frequency needs 8 samples at least");
  ScaledSignal signal{{}, {values.begin(), values.end()}, times.front(), times.back() - times.front()};
  signal.u.reserve(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0 && !(times[i] > times[i - 1])) throw std::invalid_argument("a signal's times must increase");
    signal.u.push_back((times[i] - signal.first) / signal.duration);
  }
  return signal;
}

/// Crossings of zero, in the unit of u; see frequency_by_zero_crossings for which ones count.
std::vector<double> zero_crossings(const std::vector<double>& u, const std::vector<double>& v) {
  double squares = 0;
  for (const double value : v) squares += value * value;
  const double threshold = 0.1 * std::sqrt(squares / static_cast<double>(v.size()));
  std::vector<double> crossings;
  int side = 0;
  double candidate = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (i > 0 && (v[i - 1] < 0.0) != (v[i] < 0.0))
      candidate = u[i - 1] + (u[i] - u[i - 1]) * v[i - 1] / (v[i - 1] - v[i]);
    const int new_side = v[i] > threshold ? 1 : (v[i] < -threshold ? -1 : 0);
    if (new_side == 0 || new_side == side) continue;
    if (side != 0) crossings.push_back(candidate);
    side = new_side;
  }
  return crossings;
}

/// Half a period: the slope of the least-squares line through crossing time against crossing number.
double half_period(const std::vector<double>& crossings) {
  if (crossings.size() < 3)
    throw std::invalid_argument("the signal crosses its trend fewer than three times: too short for a frequency");
  const double mean_number = 0.5 * static_cast<double>(crossings.size() - 1);
  double top = 0, bottom = 0;
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    const double number = static_cast<double>(k) - mean_number;
    top += number * crossings[k];
    bottom += number * number;
  }
  return top / bottom;
}

/// 1, u, exp(-decay u) cos(omega u), exp(-decay u) sin(omega u).
Eigen::Vector4d basis(double u, double omega, double decay) {
  const double envelope = std::exp(-decay * u);
  return {1.0, u, envelope * std::cos(omega * u), envelope * std::sin(omega * u)};
}

/// The least-squares coefficients of the basis functions for given omega and decay.
Eigen::Vector4d coefficients(const ScaledSignal& signal, double omega, double decay) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < signal.u.size(); ++i) {
    const Eigen::Vector4d row = basis(signal.u[i], omega, decay);
    normal += row * row.transpose();
    right += signal.y[i] * row;
  }
  return normal.ldlt().solve(right);
}

/// Offset, slope, cosine and sine coefficient, omega, decay, with time in units of the duration.
using Parameters = Eigen::Matrix<double, 6, 1>;

Parameters parameters(const ScaledSignal& signal, double omega, double decay) {
  Parameters p;
  p << coefficients(signal, omega, decay), omega, decay;
  return p;
}

double squared_misfit(const ScaledSignal& signal, const Parameters& p) {
  double sum = 0;
  for (std::size_t i = 0; i < signal.u.size(); ++i) {
    const double residual = basis(signal.u[i], p[4], p[5]).dot(p.head<4>()) - signal.y[i];
    sum += residual * residual;
  }
  return sum;
}

/// Levenberg and Marquardt's step from p.
Parameters damped_step(const ScaledSignal& signal, const Parameters& p, double damping) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Parameters gradient = Parameters::Zero();
  for (std::size_t i = 0; i < signal.u.size(); ++i) {
    const double u = signal.u[i];
    const Eigen::Vector4d row = basis(u, p[4], p[5]);
    Parameters derivative;
    derivative << row, u * (p[3] * row[2] - p[2] * row[3]), -u * (p[2] * row[2] + p[3] * row[3]);
    normal += derivative * derivative.transpose();
    gradient += (row.dot(p.head<4>()) - signal.y[i]) * derivative;
  }
  normal.diagonal() *= 1.0 + damping;
  return -normal.ldlt().solve(gradient);
}

/// Least-squares straight line: offset and slope.
Eigen::Vector2d straight_line(const ScaledSignal& signal) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < signal.u.size(); ++i) {
    const Eigen::Vector2d row(1.0, signal.u[i]);
    normal += row * row.transpose();
    right += signal.y[i] * row;
  }
  return normal.ldlt().solve(right);
}

struct Crossings {
  double omega;  ///< rad per unit of u
  std::vector<double> u;
};

Crossings crossings_of_trend(const ScaledSignal& signal) {
  // The first trend, a mere straight line, may follow the oscillation somewhat: each pass then fits the trend beside a
  // sinusoid of the frequency known so far.
  Eigen::Vector2d trend = straight_line(signal);
  Crossings result{0.0, {}};
  std::vector<double> detrended(signal.u.size());
  for (int pass = 0; pass < 8; ++pass) {
    for (std::size_t i = 0; i < detrended.size(); ++i) detrended[i] = signal.y[i] - trend[0] - trend[1] * signal.u[i];
    result.u = zero_crossings(signal.u, detrended);
    result.omega = pi / half_period(result.u);
    trend = coefficients(signal, result.omega, 0.0).head<2>();
  }
  return result;
}

}  // namespace

ZeroCrossingFrequency frequency_by_zero_crossings(std::span<const double> times, std::span<const double> values) {
  const ScaledSignal signal = scaled(times, values);
  Crossings found = crossings_of_trend(signal);
  ZeroCrossingFrequency result{found.omega / (2.0 * pi * signal.duration), std::move(found.u)};
  for (double& crossing : result.crossings) crossing = signal.first + signal.duration * crossing;
  return result;
}

DampedSinusoid fit_damped_sinusoid(std::span<const double> times, std::span<const double> values) {
  const ScaledSignal signal = scaled(times, values);
  const double omega_start = crossings_of_trend(signal).omega;

  // The linear coefficients follow from omega and decay; the best of a coarse grid lies in the right valley.
  Parameters p = parameters(signal, omega_start, 0.0);
  double misfit = squared_misfit(signal, p);
  for (const double factor : {0.85, 0.9, 0.95, 1.0, 1.05, 1.1, 1.15}) {
    for (const double decay : {0.0, 1.0, 2.0, 4.0, 8.0}) {
      const Parameters trial = parameters(signal, factor * omega_start, decay);
      const double trial_misfit = squared_misfit(signal, trial);
      if (trial_misfit < misfit) {
        misfit = trial_misfit;
        p = trial;
      }
    }
  }

  double damping = 1e-3;
  bool converged = false;
  for (int iteration = 0; iteration < 200 && !converged; ++iteration) {
    const Parameters step = damped_step(signal, p, damping);
    const Parameters trial = p + step;
    const double trial_misfit = squared_misfit(signal, trial);
    // Only the two nonlinear parameters have a size of their own to compare a step with.
    converged = std::abs(step[4]) + std::abs(step[5]) < 1e-11 * std::abs(p[4]);
    if (trial_misfit <= misfit) {
      p = trial;
      misfit = trial_misfit;
      damping *= 0.2;
    } else {
      damping *= 5.0;
    }
  }
  if (!converged || !p.allFinite()) throw std::runtime_error("the fit of a damped sinusoid does not converge");

  DampedSinusoid fit;
  fit.frequency = p[4] / (2.0 * pi * signal.duration);
  fit.decay_rate = p[5] / signal.duration;
  fit.offset = p[0];
  fit.slope = p[1] / signal.duration;
  fit.amplitude = std::sqrt(p[2] * p[2] + p[3] * p[3]);
  fit.phase = std::atan2(-p[3], p[2]);
  fit.rms_residual = std::sqrt(misfit / static_cast<double>(signal.u.size()));
  return fit;
}

}  // namespace sphdrop
