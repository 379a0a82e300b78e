#include "config/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "config/parameter_store.hpp"
#include "config/parameter_text.hpp"

namespace sphdrop {
namespace {

// Exponents of metre, kilogram, second, radian, degree; and of ten.
struct Unit {
  std::array<int, 5> dimension{};
  int ten = 0;
};

struct Symbol {
  std::string_view name;
  Unit unit;
};

constexpr Symbol symbols[] = {
    {"m", {{1, 0, 0, 0, 0}, 0}},   {"g", {{0, 1, 0, 0, 0}, -3}},   {"s", {{0, 0, 1, 0, 0}, 0}},
    {"N", {{1, 1, -2, 0, 0}, 0}},  {"Pa", {{-1, 1, -2, 0, 0}, 0}}, {"J", {{2, 1, -2, 0, 0}, 0}},
    {"Hz", {{0, 0, -1, 0, 0}, 0}}, {"rad", {{0, 0, 0, 1, 0}, 0}},  {"deg", {{0, 0, 0, 0, 1}, 0}},
    {"°", {{0, 0, 0, 0, 1}, 0}},   {"1", {{0, 0, 0, 0, 0}, 0}}};

struct Prefix {
  std::string_view name;
  int ten;
};
constexpr Prefix prefixes[] = {{"", 0},   {"n", -9}, {"u", -6}, {"µ", -6}, {"μ", -6},
                               {"m", -3}, {"c", -2}, {"k", 3},  {"M", 6},  {"G", 9}};

std::optional<Unit> unit_of_symbol(std::string_view name) {
  for (const Symbol& symbol : symbols)
    for (const Prefix& prefix : prefixes) {
      if (name.size() != prefix.name.size() + symbol.name.size() || !name.starts_with(prefix.name) ||
          !name.ends_with(symbol.name))
        continue;
      if (symbol.name == "1" && !prefix.name.empty()) continue;
      Unit found = symbol.unit;
      found.ten += prefix.ten;
      return found;
    }
  return std::nullopt;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// A factor such as "mm", "s^-2" or "m3".
std::optional<Unit> unit_of_factor(std::string_view factor) {
  if (factor == "1") return Unit{};
  std::size_t end = factor.size();
  while (end > 0 && is_digit(factor[end - 1])) --end;
  if (end > 0 && end < factor.size() && factor[end - 1] == '-') --end;
  int power = 1;
  if (end < factor.size()) {
    const std::string_view digits = factor.substr(end);
    const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), power);
    if (error != std::errc() || rest != digits.data() + digits.size() || power == 0 || std::abs(power) > 4)
      return std::nullopt;
  }
  if (end > 0 && factor[end - 1] == '^') {
    if (end == factor.size()) return std::nullopt;
    --end;
  }
  std::optional<Unit> unit = unit_of_symbol(factor.substr(0, end));
  if (!unit) return std::nullopt;
  for (int& exponent : unit->dimension) exponent *= power;
  unit->ten *= power;
  return unit;
}

struct ParsedUnit {
  std::optional<Unit> unit;
  std::string_view unknown;  // the first factor that is none
};

ParsedUnit parse_unit(std::string_view text) {
  Unit whole;
  bool divides = false, expects = true;
  while (!text.empty()) {
    constexpr std::string_view dot = "·";
    const std::size_t operator_size = text.starts_with(dot) ? dot.size() : text.find_first_of(" */") == 0 ? 1 : 0;
    if (operator_size > 0) {
      if (text.front() != ' ') {
        if (expects) return {{}, text};
        expects = true;
        divides = text.front() == '/';
      }
      text.remove_prefix(operator_size);
      continue;
    }
    const std::size_t size = std::min({text.find_first_of(" */"), text.find(dot), text.size()});
    const std::optional<Unit> factor = unit_of_factor(text.substr(0, size));
    if (!factor) return {{}, text.substr(0, size)};
    const int sign = divides ? -1 : 1;
    for (std::size_t k = 0; k < whole.dimension.size(); ++k) whole.dimension[k] += sign * factor->dimension[k];
    whole.ten += sign * factor->ten;
    divides = expects = false;
    text.remove_prefix(size);
  }
  if (expects) return {{}, ""};
  return {whole, ""};
}

// How much of the text is a decimal number.
std::size_t number_size(std::string_view text) {
  const std::size_t start = text.starts_with('+') ? 1 : 0;
  double ignored = 0;
  const auto [end, error] = std::from_chars(text.data() + start, text.data() + text.size(), ignored);
  const auto size = static_cast<std::size_t>(end - text.data());
  // "inf" and "nan" are letters.
  const bool has_digit = std::any_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(size), is_digit);
  return error == std::errc::invalid_argument || !has_digit ? 0 : size;
}

std::string_view without_spaces_before(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return text;
}

// number x 10^ten, rounded once.
std::optional<double> shifted(std::string_view number, int ten) {
  const std::size_t mark = number.find_first_of("eE");
  int exponent = 0;
  if (mark != std::string_view::npos) {
    std::string_view digits = number.substr(mark + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    if (std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec != std::errc()) return std::nullopt;
  }
  if (std::abs(exponent) > 10000) return std::nullopt;
  return parse_number(fmt::format("{}e{}", number.substr(0, std::min(mark, number.size())), exponent + ten));
}

}  // namespace

bool takes_units(std::string_view unit) {
  return parse_unit(unit).unit.has_value();
}

bool looks_like_quantity(std::string_view text) {
  const std::size_t size = number_size(text);
  return size > 0 && size < text.size();
}

Quantity parse_quantity(std::string_view text, std::string_view unit) {
  const std::optional<Unit> wanted = parse_unit(unit).unit;
  if (!wanted) return {{}, fmt::format("= {} takes a number without a unit", quoted(text))};
  const std::size_t size = number_size(text);
  const std::string_view unit_text = without_spaces_before(text.substr(size));
  const ParsedUnit given = parse_unit(unit_text);
  if (!given.unit)
    return {{},
            fmt::format("= {} has the unknown unit {}; write for example \"1 {}\", with prefixes n, u, m, c, k, M, G",
                        quoted(text), quoted(given.unknown.empty() ? unit_text : given.unknown), unit)};
  if (given.unit->dimension != wanted->dimension)
    return {{}, fmt::format("= {} is of another kind: a value in {} is wanted", quoted(text), unit)};
  const std::optional<double> value = shifted(text.substr(0, size), given.unit->ten - wanted->ten);
  if (!value) return {{}, fmt::format("= {} is too large or too small for a double-precision number", quoted(text))};
  return {value, ""};
}

}  // namespace sphdrop
