#include "config/parameter_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "config/mode_presets.hpp"
#include "config/overloaded.hpp"
#include "config/parameter_store.hpp"
#include "config/utf8.hpp"

namespace sphdrop {
namespace {

constexpr std::string_view automatic_word = "auto";

// A line of a case must not become too long.
constexpr std::size_t points_per_line = 8;

std::string points_text(const Points& points) {
  std::string text = "[";
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k > 0) text += k % points_per_line == 0 ? ",\n  " : ", ";
    text += fmt::format("[{}, {}]", number_text(points[k].x), number_text(points[k].y));
  }
  return text + "]";
}

std::string regions_text(const std::vector<Points>& regions) {
  std::string text = "[";
  for (std::size_t k = 0; k < regions.size(); ++k) text += (k > 0 ? ",\n  " : "") + points_text(regions[k]);
  return text + "]";
}

}  // namespace

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (is_control(c)) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string number_text(double value) {
  return fmt::format("{}", value);
}

std::string range_text(const Range& range) {
  return fmt::format("{} {} and {} {}", range.lower_included ? ">=" : ">", number_text(range.lower),
                     range.upper_included ? "<=" : "<", number_text(range.upper));
}

std::string words_text(std::span<const std::string_view> words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

bool is_required(const Parameter& parameter) {
  const RealParameter* real = std::get_if<RealParameter>(&parameter.value);
  return real != nullptr && std::holds_alternative<Required>(real->fallback);
}

std::string value_text(const Parameter& parameter, const Case& values) {
  Case copy = values;  // the table hands out references to members of a Case that may change
  const auto number_or_automatic = [](double value) {
    return std::isnan(value) ? quoted(automatic_word) : number_text(value);
  };
  return std::visit(
      Overloaded{[&](const RealParameter& real) { return number_or_automatic(real.member(copy)); },
                 [&](const IntegerParameter& integer) { return fmt::format("{}", integer.member(copy)); },
                 [&](const VectorParameter& vector) {
                   return fmt::format("[{}, {}]", number_text(vector.x(copy)), number_text(vector.y(copy)));
                 },
                 [&](const WordParameter& word) { return quoted(word.words[word.get(copy)]); },
                 [&](const TextParameter& text) {
                   const std::string& value = text.member(copy);
                   return quoted(value.empty() && !text.may_be_empty ? automatic_word : std::string_view(value));
                 },
                 [&](const PointsParameter& points) { return points_text(points.member(copy)); },
                 [&](const RegionsParameter& regions) { return regions_text(regions.member(copy)); }},
      parameter.value);
}

std::string type_text(const Parameter& parameter) {
  return std::visit(
      Overloaded{[](const RealParameter&) { return "number"; }, [](const IntegerParameter&) { return "integer"; },
                 [](const VectorParameter&) { return "[x, y]"; }, [](const WordParameter&) { return "word"; },
                 [](const TextParameter&) { return "text"; }, [](const PointsParameter&) { return "[[x, y], ...]"; },
                 [](const RegionsParameter&) { return "[[[x, y], ...], ...]"; }},
      parameter.value);
}

std::string default_text(const Parameter& parameter) {
  if (is_required(parameter)) return "required";
  const Automatic* automatic = nullptr;
  if (const auto* real = std::get_if<RealParameter>(&parameter.value))
    automatic = std::get_if<Automatic>(&real->fallback);
  if (const auto* text = std::get_if<TextParameter>(&parameter.value)) {
    if (text->may_be_empty) return fmt::format("\"\" ({})", text->fallback.meaning);
    automatic = &text->fallback;
  }
  if (automatic != nullptr) return fmt::format("{} ({})", quoted(automatic_word), automatic->meaning);
  if (const auto* points = std::get_if<PointsParameter>(&parameter.value); points != nullptr && !points->none.empty())
    return fmt::format("[] ({})", points->none);
  Case values;
  store_default(parameter, values);
  std::string text = value_text(parameter, values);
  for (const Preset& preset : mode_presets())
    if (preset.key == parameter.key)
      text += fmt::format(" (mode {}: {}{})", preset.mode == Mode::modern ? "modern" : "fast", preset.value,
                          preset.restriction.empty() ? "" : fmt::format(" {}", preset.restriction));
  return text;
}

std::string allowed_text(const Parameter& parameter) {
  return std::visit(Overloaded{[](const RealParameter& real) { return range_text(real.range); },
                               [](const IntegerParameter& integer) {
                                 std::string text;
                                 for (const std::int64_t choice : integer.choices) {
                                   text += fmt::format("{}{}", text.empty() ? "" : " or ", choice);
                                 }
                                 if (!text.empty()) return text;
                                 return fmt::format(">= {} and <= {}", integer.lower, integer.upper);
                               },
                               [](const VectorParameter& vector) { return "each " + range_text(vector.range); },
                               [](const WordParameter& word) { return words_text(word.words); },
                               [](const TextParameter&) { return std::string("any text without control characters"); },
                               [](const PointsParameter& points) { return "each " + range_text(points.range); },
                               [](const RegionsParameter& regions) { return "each " + range_text(regions.range); }},
                    parameter.value);
}

}  // namespace sphdrop
