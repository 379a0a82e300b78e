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

/// The points, and how fast they move with their particles: ds_k/dt = v_k + dn_k/dt d/2, which the neighbours on the
/// curve turn; v_k alone where the two are the same particle. node_velocities and velocities by node, m/s.
void surface_points(const SurfaceCurves& curves, std::span<const Vector> node_positions,
                    std::span<const Vector> node_velocities, double spacing, std::span<Vector> points,
                    std::span<Vector> velocities);

}  // namespace sphdrop
