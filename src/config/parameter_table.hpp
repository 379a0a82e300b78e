#pragma once
// The parameters of a case, declared once: parsing, messages, listings and the effective case follow from this table.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/case.hpp"

namespace sphdrop {

/// Allowed numbers: from lower to upper, each end included or not.
struct Range {
  double lower;
  bool lower_included;
  double upper;
  bool upper_included;

  /// False for NaN and for infinities.
  constexpr bool contains(double value) const {
    return (lower_included ? value >= lower : value > lower) && (upper_included ? value <= upper : value < upper);
  }
};

struct Required {};  ///< the case must give the value
struct Automatic {   ///< "auto": derived from other parameters (config/derived_defaults.hpp); NaN or "" until then
  std::string_view meaning;
};

struct RealParameter {
  double& (*member)(Case&);
  std::variant<Required, Automatic, double> fallback;
  Range range;
};
struct IntegerParameter {
  std::int64_t& (*member)(Case&);
  std::int64_t fallback;
  std::int64_t lower, upper;
  std::span<const std::int64_t> choices = {};  ///< if given, only these
};
struct VectorParameter {  ///< [x, y]
  double& (*x)(Case&);
  double& (*y)(Case&);
  std::array<double, 2> fallback;
  Range range;  ///< of either component
};
struct WordParameter {  ///< an enumeration; its enumerators are the words' positions
  std::span<const std::string_view> words;
  std::size_t (*get)(const Case&);
  void (*set)(Case&, std::size_t);
  std::size_t fallback;
};
struct TextParameter {
  std::string& (*member)(Case&);
  Automatic fallback;
  bool may_be_empty = false;  ///< then "" is the default, and nothing takes its place
};

struct PointsParameter {  ///< [[x, y], ...]; none by default
  Points& (*member)(Case&);
  Range range;                 ///< of either coordinate
  std::string_view none = "";  ///< what no points mean
};
struct RegionsParameter {  ///< [[[x, y], ...], ...]; none by default
  std::vector<Points>& (*member)(Case&);
  Range range;  ///< of either coordinate
};

struct Parameter {
  std::string_view key;     ///< "section.name", or "name" outside all sections
  std::string_view symbol;  ///< the paper's; "" where it has none
  std::string_view unit;    ///< SI; "-" for pure numbers and words
  std::variant<RealParameter, IntegerParameter, VectorParameter, WordParameter, TextParameter, PointsParameter,
               RegionsParameter>
      value;
  std::string_view description;

  /// "" outside all sections.
  std::string_view section() const;
  std::string_view name() const;
};

/// In the order in which listings show them: section by section.
std::span<const Parameter> parameter_table();

/// nullptr if there is no such key.
const Parameter* find_parameter(std::string_view key);

/// The sections' names, in the table's order.
std::span<const std::string_view> section_names();

}  // namespace sphdrop
