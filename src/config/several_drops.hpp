#pragma once
// Cases of several drops: [[drop]] in files, drop[2].diameter on the command line.

#include <cstddef>
#include <string>
#include <string_view>

#include "config/case.hpp"

namespace sphdrop {

/// The largest of f(case of one drop) over the drops.
template <class F>
double largest_over_drops(const Case& values, F&& f) {
  double largest = f(values.with_drop(0));
  for (std::size_t k = 1; k < values.drop_count(); ++k) {
    const double value = f(values.with_drop(k));
    if (value > largest) largest = value;
  }
  return largest;
}

/// "drop.diameter" of drop 1 as "drop[2].diameter"; other keys, and those of drop 0, as they are.
inline std::string key_of_drop(std::string_view key, std::size_t k) {
  constexpr std::string_view section = "drop.";
  if (k == 0 || !key.starts_with(section)) return std::string(key);
  return "drop[" + std::to_string(k + 1) + "]." + std::string(key.substr(section.size()));
}

}  // namespace sphdrop
