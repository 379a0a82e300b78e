#pragma once
// Values that follow from others where a case says "auto", and the estimates they and the checks rest on.

#include <string>

#include "config/case.hpp"

namespace sphdrop {

/// Fills in the run's name, that of the case file source_name without its ending, and the folder of its results.
void fill_names(Case& values, const std::string& source_name);

/// Puts a number or word where a parameter is still automatic (NaN, or a word "auto").
void fill_derived_defaults(Case& values);

/// Upper estimate of the speeds in the run, m/s: initial ones, what gravity adds until time.end (a beam by itself falls
/// no farther than its length), and the speed at which
/// surface tension draws back a sheet as thick as the drop, sqrt(2 sigma/(rho D0)); of a rigid drop its rim's.
double expected_speed(const Case& values);

/// Largest sound speed, m/s: the liquid's, and the beam's c_s = sqrt(K/rho) with K = E/(3 (1 - 2 nu)) (method.md, 3a).
/// A rigid drop has none; without a beam fluid.sound_speed stands in for it, as the contact's stiffness needs a time
/// step.
double largest_sound_speed(const Case& values);

/// The step that Eq 40 gives with the case's CFL factors, s, at the speed expected: of solid and liquid together, or,
/// where the solid takes sub-steps, the smaller of the liquid's step and so many of the solid's.
double sound_step(const Case& values);

struct StepBound {
  double step = 0;  ///< s; infinity if nothing bounds it
  const char* equation = "";
};

/// The smallest of Eqs 40-42 with all CFL factors 1, for the materials and forces that the case has.
StepBound largest_step(const Case& values);

/// Whether the solid can take sub-steps: a beam whose neighbours follow from its undeformed body, and a liquid.
bool can_take_substeps(const Case& values);

bool has_drop(const Case& values);
bool has_beam(const Case& values);

}  // namespace sphdrop
