#include "config/parameter_listing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "config/parameter_table.hpp"
#include "config/parameter_text.hpp"

namespace sphdrop {
namespace {

constexpr std::size_t column_count = 7, line_width = 100;
using Row = std::array<std::string, column_count>;

Row row_of(const Parameter& parameter) {
  return {std::string(parameter.key),        type_text(parameter),
          std::string(parameter.unit),       default_text(parameter),
          allowed_text(parameter),           std::string(parameter.symbol.empty() ? "-" : parameter.symbol),
          std::string(parameter.description)};
}

/// The words, indented by four, in lines of at most line_width (unless one word is longer), all but the first by eight.
std::string paragraph(const std::string& words) {
  std::string text, line = "   ";
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    const std::string_view word = std::string_view(words).substr(begin, end - begin);
    if (line.size() + 1 + word.size() > line_width) {
      text += line + "\n";
      line = "       ";
    }
    line += fmt::format(" {}", word);
    begin = end + 1;
  }
  return text + line + "\n";
}

}  // namespace

std::string list_parameters_text() {
  std::string text = "All parameters of a case: key, what it takes, what it is\n";
  for (const Parameter& parameter : parameter_table()) {
    const auto [key, type, unit, by_default, allowed, symbol, description] = row_of(parameter);
    text += fmt::format("{:<40} {}{}{}\n", key, type, unit == "-" ? "" : ", " + unit,
                        symbol == "-" ? "" : ", the paper's " + symbol);
    text += paragraph(description) + paragraph("allowed: " + allowed) + paragraph("default: " + by_default);
  }
  return text;
}

std::string parameter_reference_markdown() {
  std::string text;
  std::string_view section = "none yet";
  for (const Parameter& parameter : parameter_table()) {
    if (parameter.section() != section) {
      section = parameter.section();
      text += section.empty() ? "### Above all sections\n\n" : fmt::format("\n### [{}]\n\n", section);
      text += "| key | type | unit | default | allowed | paper's symbol | meaning |\n|---|---|---|---|---|---|---|\n";
    }
    const Row row = row_of(parameter);
    text += fmt::format("| `{}` | {} | {} | `{}` | {} | {} | {} |\n", row[0], row[1], row[2], row[3], row[4], row[5],
                        row[6]);
  }
  return text;
}

}  // namespace sphdrop
