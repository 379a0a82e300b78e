#include "config/parameter_listing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "config/parameter_table.hpp"
#include "config/parameter_text.hpp"

namespace sphdrop {
namespace {

constexpr std::size_t column_count = 7;
using Row = std::array<std::string, column_count>;
constexpr std::array<const char*, column_count> headings = {"key",     "type",   "unit",       "default",
                                                            "allowed", "symbol", "description"};

Row row_of(const Parameter& parameter) {
  return {std::string(parameter.key),        type_text(parameter),
          std::string(parameter.unit),       default_text(parameter),
          allowed_text(parameter),           std::string(parameter.symbol.empty() ? "-" : parameter.symbol),
          std::string(parameter.description)};
}

}  // namespace

std::string list_parameters_text() {
  std::vector<Row> rows(1);
  std::copy(headings.begin(), headings.end(), rows[0].begin());
  for (const Parameter& parameter : parameter_table()) rows.push_back(row_of(parameter));
  std::array<std::size_t, column_count> widths{};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < column_count; ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i + 1 < column_count; ++i) text += fmt::format("{:<{}}  ", row[i], widths[i]);
    text += row.back() + "\n";
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
