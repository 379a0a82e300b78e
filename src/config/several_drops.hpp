#pragma once
// Cases of several drops or solids: [[drop]] and [[solid]] in files, drop[2].diameter on the command line.

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

/// Likewise over the solids.
template <class F>
double largest_over_solids(const Case& values, F&& f) {
  double largest = f(values.with_solid(0));
  for (std::size_t k = 1; k < values.solid_count(); ++k) {
    const double value = f(values.with_solid(k));
    if (value > largest) largest = value;
  }
  return largest;
}

/// Sections that a case may have several of.
inline bool may_repeat(std::string_view section) {
  return section == "drop" || section == "solid";
}

/// Which of several bodies is meant: k = 0, 1, ... of its section; "" and 0 for none of them.
struct Which {
  std::string_view section;
  std::size_t index = 0;
};

/// "drop.diameter" of drop 1 as "drop[2].diameter"; keys of other sections, and those of drop 0, as they are.
inline std::string key_of(std::string_view key, Which which) {
  if (which.index == 0 || key.size() <= which.section.size() || !key.starts_with(which.section) ||
      key[which.section.size()] != '.')
    return std::string(key);
  return std::string(which.section) + "[" + std::to_string(which.index + 1) + "]" +
         std::string(key.substr(which.section.size()));
}

}  // namespace sphdrop
