#pragma once
// Derivatives of an interpolating polynomial (28, 29).

#include <array>
#include <cstddef>

namespace sphdrop {

struct PolynomialDerivatives {
  double first, second;
};

/// P'(0) and P''(0) of the Lagrange polynomial through the origin and the points (x[j], y[j]) (28); no x[j] may be
/// zero, nor equal another. As P(0) = 0, it is done for Q = P/x, of one degree less: P'(0) = Q(0), P''(0) = 2 Q'(0).
template <std::size_t N>
PolynomialDerivatives derivatives_at_origin(const std::array<double, N>& x, const std::array<double, N>& y) {
  PolynomialDerivatives derivatives{0.0, 0.0};
  for (std::size_t j = 0; j < N; ++j) {
    double denominator = x[j];
    double basis = 1.0;        // numerator of the basis polynomial of Q at zero
    double basis_slope = 0.0;  // and its derivative there
    for (std::size_t m = 0; m < N; ++m) {
      if (m == j) continue;
      denominator *= x[j] - x[m];
      basis_slope = basis - basis_slope * x[m];  // (B (x - x_m))' = B + B' (x - x_m)
      basis *= -x[m];
    }
    const double weight = y[j] / denominator;
    derivatives.first += weight * basis;
    derivatives.second += 2.0 * (weight * basis_slope);
  }
  return derivatives;
}

}  // namespace sphdrop
