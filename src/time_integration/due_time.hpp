#pragma once
// When something is due that comes at an interval.

#include <cmath>
#include <limits>

namespace sphdrop {

/// The first multiple of `interval` after `time`, both in s; infinity for an interval of 0. Multiples, as then it does
/// not depend on when a run was started or interrupted. A time that lies within rounding before a multiple counts as
/// it.
inline double next_multiple(double time, double interval) {
  if (!(interval > 0)) return std::numeric_limits<double>::infinity();
  const double intervals = time / interval;
  return interval * (std::floor(intervals * (1 + std::copysign(1e-12, intervals))) + 1.0);
}

}  // namespace sphdrop
