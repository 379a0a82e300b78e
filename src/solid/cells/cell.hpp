#pragma once
// One bilinear cell of a solid: energy, corner forces, damping (method: Belytschko & Bindeman 1991, on the undeformed
// body; the bending part without shear locking).
//
// The body of a cell is a part of the undeformed plane about four particles. Inside it the place is x = A + X a + Y b +
// X Y c. F is its gradient at the centroid, and away from there F's columns change by Y c and X c, hence Green's
// strains E_XX and E_YY by Y h_1 and X h_2, h = F^T c, in the lowest order. The energy is
//   V psi(F) + E'/2 (I_y h_1^2 + I_x h_2^2),   E' = E/(1 - nu^2),
// with I_x, I_y the second moments of X and Y: as in a beam, a strain that grows across the cell meets the modulus of a
// plate in bending, and the shear strain that a bilinear field would add to it is left out.

#include "solid/plane_strain.hpp"

namespace sphdrop {

template <class T>
struct PlaneVector {
  T x{0.0}, y{0.0};

  [[gnu::always_inline]] friend PlaneVector operator+(const PlaneVector& a, const PlaneVector& b) {
    return {a.x + b.x, a.y + b.y};
  }
  [[gnu::always_inline]] friend PlaneVector operator-(const PlaneVector& a, const PlaneVector& b) {
    return {a.x - b.x, a.y - b.y};
  }
  [[gnu::always_inline]] friend PlaneVector operator*(const T& s, const PlaneVector& a) { return {s * a.x, s * a.y}; }
};

/// A vector for each corner: south-west, south-east, north-west, north-east.
template <class T>
struct CellCorners {
  PlaneVector<T> sw, se, nw, ne;
};

/// The body of a cell in units of the lattice spacing, about the middle of its corners. All zero: no cell, which is
/// never deformed, wherever its corners are, and has no forces.
template <class T>
struct CellShape {
  T area{0.0}, centroid_x{0.0}, centroid_y{0.0};
  T moment_x{0.0}, moment_y{0.0};  ///< second moments about the centroid: integrals of X^2 and Y^2
  /// 1; 2 where a side of held particles counts as if it lay midway to the other side (an ideal clamp's edge).
  T inverse_width_x{0.0}, inverse_width_y{0.0};
};

/// How a cell is deformed.
template <class T>
struct CellStrain {
  PlaneTensor<T> gradient;  ///< F at the centroid
  PlaneVector<T> twist;     ///< c = x_XY times the spacing
  T bending_x, bending_y;   ///< h times the spacing
};

template <class T>
[[gnu::always_inline]] inline CellStrain<T> cell_strain(const CellShape<T>& shape, const CellCorners<T>& position,
                                                        double inverse_spacing) {
  const T half(0.5 * inverse_spacing), whole(inverse_spacing), one(1.0);
  const PlaneVector<T> south = position.se - position.sw, north = position.ne - position.nw;
  const PlaneVector<T> west = position.nw - position.sw, east = position.ne - position.se;
  const PlaneVector<T> along_x = half * (south + north), along_y = half * (west + east);
  const PlaneVector<T> c = (whole * shape.inverse_width_x * shape.inverse_width_y) * (north - south);
  CellStrain<T> strain;
  strain.gradient = {one + shape.inverse_width_x * (along_x.x - one) + c.x * shape.centroid_y,
                     shape.inverse_width_y * along_y.x + c.x * shape.centroid_x,
                     shape.inverse_width_x * along_x.y + c.y * shape.centroid_y,
                     one + shape.inverse_width_y * (along_y.y - one) + c.y * shape.centroid_x};
  strain.twist = c;
  const PlaneTensor<T>& f = strain.gradient;
  strain.bending_x = f.xx * c.x + f.yx * c.y;
  strain.bending_y = f.xy * c.x + f.yy * c.y;
  return strain;
}

/// The rate of a cell's strain from its corners' velocities; `strain` is the present one.
template <class T>
[[gnu::always_inline]] inline CellStrain<T> cell_strain_rate(const CellShape<T>& shape, const CellStrain<T>& strain,
                                                             const CellCorners<T>& velocity, double inverse_spacing) {
  const T half(0.5 * inverse_spacing), whole(inverse_spacing);
  const PlaneVector<T> south = velocity.se - velocity.sw, north = velocity.ne - velocity.nw;
  const PlaneVector<T> west = velocity.nw - velocity.sw, east = velocity.ne - velocity.se;
  const PlaneVector<T> along_x = (half * shape.inverse_width_x) * (south + north);
  const PlaneVector<T> along_y = (half * shape.inverse_width_y) * (west + east);
  const PlaneVector<T> c = (whole * shape.inverse_width_x * shape.inverse_width_y) * (north - south);
  CellStrain<T> rate;
  rate.gradient = {along_x.x + c.x * shape.centroid_y, along_y.x + c.x * shape.centroid_x,
                   along_x.y + c.y * shape.centroid_y, along_y.y + c.y * shape.centroid_x};
  rate.twist = c;
  const PlaneTensor<T>&f = strain.gradient, &g = rate.gradient;
  rate.bending_x = g.xx * strain.twist.x + g.yx * strain.twist.y + f.xx * c.x + f.yx * c.y;
  rate.bending_y = g.xy * strain.twist.x + g.yy * strain.twist.y + f.xy * c.x + f.yy * c.y;
  return rate;
}

/// What all cells of a body have in common.
template <class Law>
struct CellMaterial {
  Law law;
  double bending_modulus = 0;  ///< E' = E/(1 - nu^2), Pa
  double spacing = 0;          ///< d, m
  double damping_time = 0;     ///< of Kelvin's and Voigt's viscosity: stress by strain rate over stress by strain, s
};

/// J/m.
template <class Law>
double cell_energy(const CellMaterial<Law>& m, const CellShape<double>& shape, const CellStrain<double>& strain) {
  const double bending =
      0.5 * m.bending_modulus *
      (shape.moment_y * (strain.bending_x * strain.bending_x) + shape.moment_x * (strain.bending_y * strain.bending_y));
  return m.spacing * m.spacing * (shape.area * m.law.energy_density(strain.gradient) + bending);
}

/// The heat that the damping makes in a cell, W/m.
template <class Law, class T>
[[gnu::always_inline]] inline T cell_heating(const CellMaterial<Law>& m, const CellShape<T>& shape,
                                             const CellStrain<T>& strain, const CellStrain<T>& rate) {
  const T stretching = T(2.0) * m.law.moduli.energy(green_strain_rate(strain.gradient, rate.gradient));
  const T bending = T(m.bending_modulus) * (shape.moment_y * (rate.bending_x * rate.bending_x) +
                                            shape.moment_x * (rate.bending_y * rate.bending_y));
  return T(m.damping_time * m.spacing * m.spacing) * (shape.area * stretching + bending);
}

/// The forces of a cell on its corners, N/m: minus the gradient of its energy. `stress` is the first Piola-Kirchhoff
/// stress at the centroid, Pa; bending_x and bending_y the bending strains that make the moments.
template <class T>
[[gnu::always_inline]] inline CellCorners<T> corner_forces(const CellShape<T>& shape, const CellStrain<T>& strain,
                                                           const PlaneTensor<T>& stress, const T& bending_x,
                                                           const T& bending_y, double bending_modulus, double spacing) {
  const T moment_x = T(bending_modulus) * shape.moment_y * bending_x;
  const T moment_y = T(bending_modulus) * shape.moment_x * bending_y;
  const PlaneTensor<T>& f = strain.gradient;
  const PlaneVector<T>& c = strain.twist;
  // Derivatives of the energy by F's columns and by c.
  const PlaneVector<T> first{shape.area * stress.xx + moment_x * c.x, shape.area * stress.yx + moment_x * c.y};
  const PlaneVector<T> second{shape.area * stress.xy + moment_y * c.x, shape.area * stress.yy + moment_y * c.y};
  const PlaneVector<T> twisting{
      moment_x * f.xx + moment_y * f.xy + shape.centroid_y * first.x + shape.centroid_x * second.x,
      moment_x * f.yx + moment_y * f.yy + shape.centroid_y * first.y + shape.centroid_x * second.y};
  const PlaneVector<T> p = (T(0.5 * spacing) * shape.inverse_width_x) * first;
  const PlaneVector<T> q = (T(0.5 * spacing) * shape.inverse_width_y) * second;
  const PlaneVector<T> r = (T(spacing) * shape.inverse_width_x * shape.inverse_width_y) * twisting;
  const PlaneVector<T> sum = p + q, difference = q - p;
  return {sum - r, difference + r, r - difference, T(-1.0) * (sum + r)};
}

/// Elastic forces of a cell.
template <class Law, class T>
[[gnu::always_inline]] inline CellCorners<T> elastic_forces(const CellMaterial<Law>& m, const CellShape<T>& shape,
                                                            const CellStrain<T>& strain) {
  return corner_forces(shape, strain, m.law.stress(strain.gradient), strain.bending_x, strain.bending_y,
                       m.bending_modulus, m.spacing);
}

/// Elastic and viscous forces of a cell.
template <class Law, class T>
[[gnu::always_inline]] inline CellCorners<T> damped_forces(const CellMaterial<Law>& m, const CellShape<T>& shape,
                                                           const CellStrain<T>& strain, const CellStrain<T>& rate) {
  const T tau(m.damping_time);
  const PlaneTensor<T> elastic = m.law.stress(strain.gradient);
  const PlaneTensor<T> viscous =
      product(strain.gradient, m.law.moduli.stress(green_strain_rate(strain.gradient, rate.gradient)));
  return corner_forces(shape, strain,
                       PlaneTensor<T>{elastic.xx + tau * viscous.xx, elastic.xy + tau * viscous.xy,
                                      elastic.yx + tau * viscous.yx, elastic.yy + tau * viscous.yy},
                       strain.bending_x + tau * rate.bending_x, strain.bending_y + tau * rate.bending_y,
                       m.bending_modulus, m.spacing);
}

}  // namespace sphdrop
