#pragma once
// What a drop will do on a rigid wall that repels it, before it is computed: fits to this program's own runs of
// cases/rigid_wall, We 3.5 to 56, in two dimensions. Pure functions.

namespace sphdrop {

inline constexpr double least_fitted_weber_number = 3, largest_fitted_weber_number = 60;

/// D_max/D0 as 1 + 0.28 We^(2/3): within 4 % of the runs with the artificial viscosity up to We 14, within 8 % of those
/// with water's own and of the one at We 55.5.
double expected_spread(double weber_number);

/// Time on the wall, s: 0.83 of the free drop's period times sqrt(D_max/D0), as a film draws back the longer the wider
/// it is. Within 5 % of the runs up to We 14 with either viscosity. `free_period`: drop_oscillation_period(), s.
double expected_contact_time(double free_period, double spread);

/// The paper's, at every speed: 3.17 ms where the drop's free period is 3.38 ms (Figs 14, 15), s.
double contact_time_of_the_paper(double free_period);

/// Thickness of a flat film of that width with the area of the drop, m: pi D0/(4 D_max/D0).
double film_thickness(double diameter, double spread);

}  // namespace sphdrop
