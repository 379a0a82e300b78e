#include "config/parameter_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "config/nearest_name.hpp"
#include "config/overloaded.hpp"
#include "config/parameter_text.hpp"
#include "config/quantity.hpp"
#include "config/utf8.hpp"

namespace sphdrop {
namespace {

constexpr double automatic_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view automatic_word = "auto";

// A value taken from TOML, or what is wrong with it.
template <typename T>
struct Taken {
  std::optional<T> value;
  std::string mistake;
};

std::string what_it_is(const TomlNode& node) {
  switch (node.kind) {
    case TomlNode::Kind::integer:
    case TomlNode::Kind::real:
      return node.text;
    case TomlNode::Kind::boolean:
      return fmt::format("the truth value {}", node.text);
    case TomlNode::Kind::date_or_time:
      return fmt::format("the date or time {}", node.text);
    case TomlNode::Kind::string:
      return fmt::format("the text {}", quoted(node.text.substr(0, 80)));
    case TomlNode::Kind::array:
      return fmt::format("an array of {}", node.elements.size());
    case TomlNode::Kind::table:
      break;
  }
  return "a table of keys";
}

std::string digits_of(const TomlNode& node) {
  std::string text = node.text;
  std::erase(text, '_');
  if (text.starts_with('+')) text.erase(0, 1);
  return text;
}

Taken<std::int64_t> take_integer(const TomlNode& node) {
  if (node.kind == TomlNode::Kind::real)
    return {{}, fmt::format("must be an integer, written without point or exponent, but is {}", node.text)};
  if (node.kind != TomlNode::Kind::integer) return {{}, fmt::format("must be an integer, but is {}", what_it_is(node))};
  std::string digits = digits_of(node);
  int base = 10;
  if (digits.starts_with("0x")) base = 16;
  if (digits.starts_with("0o")) base = 8;
  if (digits.starts_with("0b")) base = 2;
  if (base != 10) digits.erase(0, 2);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    return {{}, fmt::format("= {} does not fit into a 64-bit integer", node.text)};
  }
  return {value, ""};
}

Taken<double> take_number(const TomlNode& node, std::string_view unit) {
  if (node.kind == TomlNode::Kind::string && looks_like_quantity(node.text)) {
    const Quantity quantity = parse_quantity(node.text, unit);
    return {quantity.value, quantity.mistake};
  }
  if (node.kind == TomlNode::Kind::string && parse_number(node.text)) {
    return {{}, fmt::format("must be a number, but is the text {} (leave the quotes out)", quoted(node.text))};
  }
  if (node.kind != TomlNode::Kind::real && node.kind != TomlNode::Kind::integer) {
    return {{}, fmt::format("must be a number, but is {}", what_it_is(node))};
  }
  const std::string digits = digits_of(node);
  if (digits.starts_with("0x") || digits.starts_with("0o") || digits.starts_with("0b")) {
    const Taken<std::int64_t> whole = take_integer(node);
    if (!whole.value) return {{}, whole.mistake};
    return {static_cast<double>(*whole.value), ""};
  }
  if (digits.ends_with("inf") || digits.ends_with("nan")) {
    return {{}, fmt::format("must be a finite number, but is {}", node.text)};
  }
  const std::optional<double> value = parse_number(digits);
  if (!value) return {{}, fmt::format("= {} is too large or too small for a double-precision number", node.text)};
  return {value, ""};
}

Taken<double> take_number_within(const TomlNode& node, const Range& range, std::string_view unit) {
  Taken<double> number = take_number(node, unit);
  if (number.value && !range.contains(*number.value)) return {{}, fmt::format("= {} is out of range", node.text)};
  return number;
}

bool is_automatic(const TomlNode& node) {
  return node.kind == TomlNode::Kind::string && node.text == automatic_word;
}

// Each takes a value of its type into the case and returns what is wrong, without the key; empty if nothing.
struct Storing {
  const Parameter& parameter;
  const TomlNode& node;
  Case& values;

  std::string allowed() const {
    return fmt::format("; allowed: {}{}", allowed_text(parameter),
                       parameter.unit == "-" ? "" : fmt::format(" {}", parameter.unit));
  }

  std::string operator()(const RealParameter& real) const {
    const bool has_automatic = std::holds_alternative<Automatic>(real.fallback);
    if (is_automatic(node) && has_automatic) {
      real.member(values) = automatic_number;
      return "";
    }
    const Taken<double> number = take_number_within(node, real.range, parameter.unit);
    if (!number.value) return number.mistake + allowed() + (has_automatic ? ", or \"auto\"" : "");
    real.member(values) = *number.value;
    return "";
  }

  std::string operator()(const IntegerParameter& integer) const {
    const Taken<std::int64_t> taken = take_integer(node);
    if (!taken.value) return taken.mistake + allowed();
    const std::int64_t value = *taken.value;
    const bool is_allowed = integer.choices.empty() ? value >= integer.lower && value <= integer.upper
                                                    : std::find(integer.choices.begin(), integer.choices.end(),
                                                                value) != integer.choices.end();
    if (!is_allowed) return fmt::format("= {} is out of range{}", node.text, allowed());
    integer.member(values) = value;
    return "";
  }

  std::string operator()(const VectorParameter& vector) const {
    if (node.kind != TomlNode::Kind::array) {
      return fmt::format("must be an array of two numbers, [x, y], but is {}", what_it_is(node));
    }
    if (node.elements.size() != 2) {
      return fmt::format("must hold two numbers, [x, y], but holds {}", node.elements.size());
    }
    const Taken<double> x = take_number_within(node.elements[0], vector.range, parameter.unit);
    if (!x.value) return "(x component) " + x.mistake + allowed();
    const Taken<double> y = take_number_within(node.elements[1], vector.range, parameter.unit);
    if (!y.value) return "(y component) " + y.mistake + allowed();
    vector.x(values) = *x.value;
    vector.y(values) = *y.value;
    return "";
  }

  // What is wrong with it, or "".
  std::string take_point(const TomlNode& point, const Range& range, Points& points) const {
    if (point.kind != TomlNode::Kind::array || point.elements.size() != 2)
      return fmt::format("must hold points, each [x, y], but point {} is {}", points.size() + 1, what_it_is(point));
    const Taken<double> x = take_number_within(point.elements[0], range, parameter.unit);
    if (!x.value) return fmt::format("(x of point {}) ", points.size() + 1) + x.mistake + allowed();
    const Taken<double> y = take_number_within(point.elements[1], range, parameter.unit);
    if (!y.value) return fmt::format("(y of point {}) ", points.size() + 1) + y.mistake + allowed();
    points.push_back({*x.value, *y.value});
    return "";
  }

  std::string operator()(const PointsParameter& parsed) const {
    if (node.kind != TomlNode::Kind::array)
      return fmt::format("must be an array of points, [[x, y], ...], but is {}", what_it_is(node));
    Points points;
    for (const TomlNode& element : node.elements)
      if (std::string mistake = take_point(element, parsed.range, points); !mistake.empty()) return mistake;
    parsed.member(values) = std::move(points);
    return "";
  }

  std::string operator()(const RegionsParameter& parsed) const {
    if (node.kind != TomlNode::Kind::array)
      return fmt::format("must be an array of regions, [[[x, y], ...], ...], but is {}", what_it_is(node));
    std::vector<Points> regions;
    for (const TomlNode& region : node.elements) {
      Points& points = regions.emplace_back();
      const std::string which = fmt::format("(region {}) ", regions.size());
      if (region.kind != TomlNode::Kind::array || region.elements.size() < 2)
        return which + fmt::format("must be a list of at least two points, but is {}", what_it_is(region));
      for (const TomlNode& element : region.elements)
        if (std::string mistake = take_point(element, parsed.range, points); !mistake.empty()) return which + mistake;
    }
    parsed.member(values) = std::move(regions);
    return "";
  }

  std::string operator()(const WordParameter& word) const {
    if (node.kind != TomlNode::Kind::string) {
      return fmt::format("must be a word in quotes, but is {}; allowed: {}", what_it_is(node), words_text(word.words));
    }
    const auto found = std::find(word.words.begin(), word.words.end(), node.text);
    if (found == word.words.end()) {
      const auto nearest = nearest_name(node.text, word.words);
      return fmt::format("= {} is not one of the words allowed: {}{}", quoted(node.text.substr(0, 80)),
                         words_text(word.words), nearest ? fmt::format("; did you mean \"{}\"?", *nearest) : "");
    }
    word.set(values, static_cast<std::size_t>(found - word.words.begin()));
    return "";
  }

  std::string operator()(const TextParameter& text) const {
    if (node.kind != TomlNode::Kind::string) {
      return fmt::format("must be text in quotes, but is {}", what_it_is(node));
    }
    if (node.text.empty() && !text.may_be_empty) return "must not be empty";
    if (std::any_of(node.text.begin(), node.text.end(), is_control) || first_invalid_utf8(node.text)) {
      return fmt::format("= {} holds characters that a file name must not have", quoted(node.text.substr(0, 80)));
    }
    text.member(values) = is_automatic(node) ? "" : node.text;
    return "";
  }
};

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::string> store(const Parameter& parameter, const TomlNode& value, Case& values) {
  const std::string mistake = std::visit(Storing{parameter, value, values}, parameter.value);
  if (mistake.empty()) return std::nullopt;
  return fmt::format("{} {}", parameter.key, mistake);
}

void store_default(const Parameter& parameter, Case& values) {
  std::visit(Overloaded{[&](const RealParameter& real) {
                          const double* number = std::get_if<double>(&real.fallback);
                          real.member(values) = number != nullptr ? *number : automatic_number;
                        },
                        [&](const IntegerParameter& integer) { integer.member(values) = integer.fallback; },
                        [&](const VectorParameter& vector) {
                          vector.x(values) = vector.fallback[0];
                          vector.y(values) = vector.fallback[1];
                        },
                        [&](const WordParameter& word) { word.set(values, word.fallback); },
                        [&](const TextParameter& text) { text.member(values).clear(); },
                        [&](const PointsParameter& points) { points.member(values).clear(); },
                        [&](const RegionsParameter& regions) { regions.member(values).clear(); }},
             parameter.value);
}

}  // namespace sphdrop
