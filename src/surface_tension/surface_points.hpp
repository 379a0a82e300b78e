#pragma once
// Where the liquid's surface is (Sec 2.5).

#include <span>

#include "particles/vector.hpp"
#include "surface_tension/surface_curve.hpp"

namespace sphdrop {

/// The surface point of every node, s_k = x_k + n_k d/2: half a particle spacing outside the boundary particle, along
/// the outward normal of the line through its neighbours on the curve (27), or along the middle of its arc where these
/// two are the same particle. All arrays are by node; positions, spacing d and points in m.
void surface_points(const SurfaceCurves& curves, std::span<const Vector> node_positions, double spacing,
                    std::span<Vector> points);

/// The same, and the lengths of those lines, which turning_forces() needs, m.
void surface_points(const SurfaceCurves& curves, std::span<const Vector> node_positions, double spacing,
                    std::span<Vector> points, std::span<double> chords);

/// How forces on surface points come to act on the nodes they go with. A point moves with ds_k/dt = v_k + dn_k/dt d/2,
/// and its neighbours on the curve turn its normal; so the forces' power is sum F_k . ds_k/dt = sum v_k . (F_k +
/// T_{k-1} - T_{k+1}), with T_k what is worked out here: zero where the two neighbours are the same particle.
/// Forces and turning by node, N/m.
void turning_forces(const SurfaceCurves& curves, std::span<const Vector> node_positions, std::span<const double> chords,
                    double spacing, std::span<const Vector> forces, std::span<Vector> turning);

}  // namespace sphdrop
