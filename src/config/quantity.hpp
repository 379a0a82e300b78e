#pragma once
// Values with a unit: "1.0 mm", "72 mN/m", "9.81 m/s^2".

#include <optional>
#include <string>
#include <string_view>

namespace sphdrop {

/// A number in SI units, or what is wrong with the text.
struct Quantity {
  std::optional<double> value;
  std::string mistake;
};

/// Whether case files may give values of this unit (of the parameter table) with a unit of their own: so for SI units
/// and degrees, not for pure numbers or those counted in particle spacings or steps.
bool takes_units(std::string_view unit);

/// "number unit" into `unit`, an SI unit as the parameter table has it. Units are m, g, s, N, Pa, J, Hz, rad or deg
/// with a prefix from n to G, multiplied by a space, * or ·, divided by /, raised by ^2 or 2. As every factor is a
/// power of ten, the point is moved in the text: "0.1 mm" has the same bits as 1e-4.
Quantity parse_quantity(std::string_view text, std::string_view unit);

/// Whether the text begins with a number and goes on with something else.
bool looks_like_quantity(std::string_view text);

}  // namespace sphdrop
