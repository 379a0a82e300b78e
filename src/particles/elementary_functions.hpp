#pragma once
// Sine, cosine and exponential from + - * / alone. A library's versions differ in their last bits from one machine and
// compiler to the next; whatever feeds the particles' state must not.

#include <cassert>
#include <cmath>

namespace sphdrop {

struct SineCosine {
  double sine, cosine;
};

/// sin and cos of `angle` in radians, within 2 units in the last place for |angle| < 1e5.
inline SineCosine sine_cosine(double angle) {
  assert(std::abs(angle) < 1e5);
  // pi/2 in three pieces. The first two have 33 bits, so that quarter_turns times each is exact and the reduced angle
  // keeps its relative accuracy even next to a multiple of pi (Cody & Waite).
  constexpr double first_piece = 0x1.921fb544p+0;
  constexpr double second_piece = 0x1.0b4611a6p-34;
  constexpr double third_piece = 0x1.3198a2e037073p-69;
  constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
  const double quarter_turns = std::floor(angle * two_over_pi + 0.5);
  const double r = ((angle - quarter_turns * first_piece) - quarter_turns * second_piece) - quarter_turns * third_piece;

  // Taylor series about 0; for |r| <= pi/4 the first terms left out are below 1e-19.
  const double s = r * r;
  double sine_tail = 1.0;
  for (int n = 16; n >= 4; n -= 2) sine_tail = 1.0 - s * sine_tail / (n * (n + 1));
  const double sine = r - r * (s * sine_tail / 6.0);
  double cosine_tail = 1.0;
  for (int n = 17; n >= 3; n -= 2) cosine_tail = 1.0 - s * cosine_tail / (n * (n + 1));
  const double cosine = 1.0 - s * cosine_tail / 2.0;

  switch (static_cast<long long>(quarter_turns) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

/// e^x within 2 units in the last place; 0 below and infinity above what a double can hold.
inline double exponential(double x) {
  if (x < -746.0) return 0.0;
  if (x > 710.0) return HUGE_VAL;
  if (std::isnan(x)) return x;
  // x = doublings ln 2 + r with ln 2 in two pieces, the first short enough for an exact product.
  constexpr double first_piece = 0x1.62e42feep-1;
  constexpr double second_piece = 0x1.a39ef35793c76p-33;
  constexpr double inverse_of_ln2 = 0x1.71547652b82fep+0;
  const double doublings = std::floor(x * inverse_of_ln2 + 0.5);
  const double r = (x - doublings * first_piece) - doublings * second_piece;
  double tail = 1.0;
  for (int n = 15; n >= 2; --n) tail = 1.0 + r * tail / n;
  return std::ldexp(1.0 + r * tail, static_cast<int>(doublings));  // ldexp only moves the exponent: exact
}

/// Hyperbolic cosine; relative accuracy as exponential().
inline double hyperbolic_cosine(double x) {
  const double e = exponential(x);
  return 0.5 * (e + 1.0 / e);
}

/// Hyperbolic sine; accurate to a few 1e-16 in absolute terms for small |x|, relative for |x| > 1.
inline double hyperbolic_sine(double x) {
  const double e = exponential(x);
  return 0.5 * (e - 1.0 / e);
}

/// ln x for finite x > 0, within a few units in the last place.
inline double natural_logarithm(double x) {
  assert(x > 0);
  int exponent = 0;
  double fraction = std::frexp(x, &exponent);  // only takes the number apart: exact
  if (fraction < 0.70710678118654752) {
    fraction *= 2.0;
    --exponent;
  }
  // ln f = 2 artanh z, z = (f - 1)/(f + 1), |z| < 0.172: the first term left out is below 1e-18 of the sum.
  const double z = (fraction - 1.0) / (fraction + 1.0), z_squared = z * z;
  double tail = 1.0 / 23.0;
  for (int n = 21; n >= 1; n -= 2) tail = 1.0 / n + z_squared * tail;
  constexpr double first_piece = 0x1.62e42feep-1;  // ln 2 in two pieces, the first times any exponent exact
  constexpr double second_piece = 0x1.a39ef35793c76p-33;
  return exponent * first_piece + (exponent * second_piece + 2.0 * z * tail);
}

}  // namespace sphdrop
