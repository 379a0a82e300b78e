#pragma once
// From the values of a case to the constants of the formulas.

#include <vector>

#include "config/case.hpp"
#include "fluid/fluid_sweep.hpp"
#include "simulation/distribution.hpp"
#include "solid/hypoelastic/hypoelastic_sweep.hpp"
#include "time_integration/time_step.hpp"

namespace sphdrop {

/// Constants of the formulas that follow from a case.
struct DerivedParameters {
  explicit DerivedParameters(const Case& input);

  double smoothing_length;  ///< h, m
  SmoothingKernel kernel;   ///< of the liquid
  InteractionRange range;
  AnyFluidPairParameters fluid_pair;
  HypoelasticParameters solid;
  TimeStepLimits time_step;
  std::vector<double> damping_rate;  ///< [solids] in proportion to mass, 1/s
};

}  // namespace sphdrop
