#pragma once
// The weakly compressible equation of state (Eqs 4, 5).

namespace sphdrop {

/// p = c^2 (rho - rho0), Pa. T is double or a SIMD vector.
template <class T>
[[gnu::always_inline]] inline T equation_of_state_pressure(const T& density, double sound_speed,
                                                           double reference_density) {
  return T(sound_speed * sound_speed) * (density - T(reference_density));
}

}  // namespace sphdrop
