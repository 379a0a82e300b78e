#include "diagnostics/impact_estimates.hpp"

#include <cmath>
#include <numbers>

namespace sphdrop {

double expected_spread(double weber_number) {
  return 1.0 + 0.28 * std::cbrt(weber_number * weber_number);
}

double expected_contact_time(double free_period, double spread) {
  return 0.83 * free_period * std::sqrt(spread);
}

double contact_time_of_the_paper(double free_period) {
  return 3.17 / 3.38 * free_period;
}

double film_thickness(double diameter, double spread) {
  return std::numbers::pi * diameter / (4.0 * spread);
}

}  // namespace sphdrop
