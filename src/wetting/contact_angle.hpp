#pragma once
// The energy by which a solid attracts a liquid that makes a contact angle with it (method.md, 6b).
//
// The liquid's curve costs sigma per length all round, its base on the solid included; the solid gives W per base width
// back. What the base then costs, sigma - W = -sigma cos theta, is Young's difference of the solid's two tensions.

#include <numbers>

#include "particles/elementary_functions.hpp"

namespace sphdrop {

/// W = sigma (1 + cos theta), N/m: the work of adhesion (Young-Dupre). `surface_tension` in N/m, `contact_angle` theta
/// in degrees; 0 at 180 degrees.
inline double work_of_adhesion(double surface_tension, double contact_angle) {
  if (contact_angle == 180.0) return 0.0;
  return surface_tension * (1.0 + sine_cosine(contact_angle * (std::numbers::pi / 180.0)).cosine);
}

/// How much of a surface point belongs to the base: w, and its derivative by the gap, 1/m.
struct BaseWeight {
  double value = 0, slope = 0;
};

/// Gaps, in spacings, up to which a surface point belongs to the base, and from which on it does not.
inline constexpr double base_begins = 0.25, base_ends = 2.0;

/// w(delta) = 1 up to delta = d/4, 0 from 2 d on, and 1 - u^2 (3 - 2 u) between, u the fraction of the way. `gap`
/// delta: of the surface point beyond where it rests on the solid, m; `spacing` d in m.
constexpr BaseWeight base_weight(double gap, double spacing) {
  constexpr double width = base_ends - base_begins;
  const double u = (gap / spacing - base_begins) / width;
  if (u <= 0.0) return {1.0, 0.0};
  if (u >= 1.0) return {0.0, 0.0};
  return {1.0 - u * u * (3.0 - 2.0 * u), -6.0 * u * (1.0 - u) / (width * spacing)};
}

}  // namespace sphdrop
