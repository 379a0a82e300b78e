#pragma once
// The force of surface tension on the surface points (Sec 2.5, Eqs 28-31).
//
// Everywhere: points, forces and curvatures are by node of the curves; points in m, sigma in N/m, forces in N per metre
// of depth. Curves of fewer than three nodes have force, curvature and length 0; so have segments of length zero.

#include <span>

#include "particles/vector.hpp"
#include "surface_tension/surface_curve.hpp"

namespace sphdrop {

/// F_k = sigma (t_{k,k+1} - t_{k-1,k}), t the unit vectors along the curve's segments: minus the gradient of
/// sigma times their length. Sums to zero round every curve, and so does its moment. Used instead of Eq 31 by default.
void conservative_forces(const SurfaceCurves& curves, std::span<const Vector> points, double sigma,
                         std::span<Vector> forces);

/// F_k = sigma kappa n dS (31), with curvature (29) and normal (30) of a polynomial through `polynomial_points` (3 or
/// 5) consecutive surface points (28) in a frame turned to the local tangent, dS half the distance to both neighbours.
/// Where the points do not advance along the tangent: 3 points instead of 5, and the conservative force instead of 3.
/// Throws std::invalid_argument if polynomial_points is neither 3 nor 5.
void curvature_forces(const SurfaceCurves& curves, std::span<const Vector> points, double sigma, int polynomial_points,
                      std::span<Vector> forces);

/// Adds to F_k the force p/2 (D_y, -D_x), D = s_{k+1} - s_{k-1}, of a pressure p (Pa) inside: p times the gradient of
/// the area that the curve encloses. Sums to zero round every curve, and so does its moment.
void add_pressure_forces(const SurfaceCurves& curves, std::span<const Vector> points, double pressure,
                         std::span<Vector> forces);

/// The curvature (29) that curvature_forces uses, 1/m: positive where the liquid is convex, 1/R on a drop's outline and
/// -1/R on a bubble's.
void curvatures(const SurfaceCurves& curves, std::span<const Vector> points, int polynomial_points,
                std::span<double> curvature);

}  // namespace sphdrop
