#include "config/case_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "config/consistency.hpp"
#include "config/derived_defaults.hpp"
#include "config/key_suggestion.hpp"
#include "config/override.hpp"
#include "config/parameter_store.hpp"
#include "config/parameter_table.hpp"
#include "config/parameter_text.hpp"
#include "config/toml_source.hpp"

namespace sphdrop {
namespace {

// A value that the file or an override gives to a known parameter.
struct Given {
  TomlNode node;
  std::string override_text;  // "" if from the file
};

class CaseReader {
 public:
  explicit CaseReader(std::string source_name) : source_name_(std::move(source_name)) {}

  void take_file(const TomlNode& root);
  void take_overrides(const std::vector<std::string>& overrides);
  ParsedCase finish();

 private:
  struct Mistake {
    int line;
    std::string text;
  };
  // After all the mistakes that have a line.
  static constexpr int no_line = std::numeric_limits<int>::max();

  void mistake_in_file(const TomlNode& node, const std::string& message) {
    mistakes_.push_back({node.line, mistake_at(source_name_, node.line, node.line_text, message)});
  }
  void mistake_in_override(const std::string& override_text, const std::string& message) {
    mistakes_.push_back({no_line, fmt::format("--set {}: {}", printable(override_text), message)});
  }

  void take_section(const TomlNode& section);
  void store_values();
  void report_missing(const Parameter& parameter);
  std::string located(const Finding& finding) const;
  std::string origins(const Finding& finding) const;

  std::string source_name_;
  std::map<std::string, Given, std::less<>> given_;
  std::map<std::string, TomlNode, std::less<>> section_headers_;
  std::set<std::string_view> unusable_;
  std::vector<Mistake> mistakes_;
  Case values_;
};

bool is_section(std::string_view name) {
  const auto names = section_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

void CaseReader::take_file(const TomlNode& root) {
  for (const TomlNode& member : root.members) {
    const bool is_plain = member.name.find('.') == std::string::npos;
    if (is_plain && find_parameter(member.name) != nullptr) {
      given_[member.name] = {member, ""};
    } else if (is_section(member.name)) {
      if (member.kind == TomlNode::Kind::table) {
        take_section(member);
      } else {
        mistake_in_file(member,
                        fmt::format("{0} is a section, not a key: write [{0}] and its keys below", member.name));
      }
    } else if (member.kind == TomlNode::Kind::table) {
      mistake_in_file(member, unknown_section_message(member.name));
    } else {
      mistake_in_file(member, unknown_key_message("", member.name));
    }
  }
}

void CaseReader::take_section(const TomlNode& section) {
  section_headers_[section.name] = section;
  for (const TomlNode& member : section.members) {
    const std::string key = section.name + "." + member.name;
    if (find_parameter(key) != nullptr) {
      given_[key] = {member, ""};
    } else {
      mistake_in_file(member, unknown_key_message(section.name, member.name));
    }
  }
}

void CaseReader::take_overrides(const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) {
    Override parsed = parse_override(text);
    if (parsed.mistake.empty()) {
      given_[parsed.key] = {std::move(parsed.value), text};
    } else {
      mistake_in_override(text, parsed.mistake);
    }
  }
}

void CaseReader::report_missing(const Parameter& parameter) {
  const auto header = section_headers_.find(parameter.section());
  TomlNode place;
  if (header != section_headers_.end()) place = header->second;
  mistake_in_file(place, fmt::format("{} is missing and has no default; give the {}, {} {}", parameter.key,
                                     parameter.description, allowed_text(parameter), parameter.unit));
}

void CaseReader::store_values() {
  for (const Parameter& parameter : parameter_table()) {
    store_default(parameter, values_);
    const auto found = given_.find(parameter.key);
    if (found == given_.end()) {
      if (!is_required(parameter)) continue;
      unusable_.insert(parameter.key);
      report_missing(parameter);
    } else if (const auto mistake = store(parameter, found->second.node, values_)) {
      unusable_.insert(parameter.key);
      if (found->second.override_text.empty()) {
        mistake_in_file(found->second.node, *mistake);
      } else {
        mistake_in_override(found->second.override_text, *mistake);
      }
    }
  }
}

// " (drop.diameter: line 7; resolution.spacing: --set; drop.shape: default)"
std::string CaseReader::origins(const Finding& finding) const {
  constexpr std::size_t few = 4;
  std::string text;
  for (const std::string_view key : finding.keys) {
    const auto found = given_.find(key);
    std::string origin = "default";
    if (found != given_.end()) {
      origin = found->second.override_text.empty() ? fmt::format("line {}", found->second.node.line) : "--set";
    } else if (finding.keys.size() > few) {
      continue;
    }
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", key, origin);
  }
  return text.empty() ? text : fmt::format(" ({})", text);
}

// At the line of the first parameter involved that the case gives.
std::string CaseReader::located(const Finding& finding) const {
  const std::string message = finding.message + origins(finding);
  for (const std::string_view key : finding.keys) {
    const auto found = given_.find(key);
    if (found == given_.end()) continue;
    const Given& given = found->second;
    if (!given.override_text.empty()) return fmt::format("--set {}: {}", printable(given.override_text), message);
    return mistake_at(source_name_, given.node.line, given.node.line_text, message);
  }
  return mistake_at(source_name_, 1, "", message);
}

ParsedCase CaseReader::finish() {
  store_values();
  fill_derived_defaults(values_, source_name_);
  const auto is_usable = [this](std::string_view key) { return !unusable_.contains(key); };
  for (const Finding& finding : contradictions(values_, is_usable)) mistakes_.push_back({no_line, located(finding)});
  if (!mistakes_.empty()) {
    std::stable_sort(mistakes_.begin(), mistakes_.end(),
                     [](const Mistake& a, const Mistake& b) { return a.line < b.line; });
    std::vector<std::string> texts;
    for (Mistake& mistake : mistakes_) texts.push_back(std::move(mistake.text));
    throw CaseError(std::move(texts));
  }
  ParsedCase parsed{values_, {}};
  for (const Finding& doubt : doubts(values_)) parsed.warnings.push_back(located(doubt));
  return parsed;
}

}  // namespace

ParsedCase parse_case_text(std::string_view text, const std::string& source_name,
                           const std::vector<std::string>& overrides) {
  const TomlNode root = parse_toml(text, source_name);
  if (root.members.empty() && overrides.empty()) {
    throw CaseError({fmt::format(
        "{}:1: the case is empty; it must at least say resolution.spacing and time.end, in TOML", source_name)});
  }
  CaseReader reader(source_name);
  reader.take_file(root);
  reader.take_overrides(overrides);
  return reader.finish();
}

ParsedCase read_case_file(const std::string& path, const std::vector<std::string>& overrides) {
  return parse_case_text(read_text_file(path), path, overrides);
}

}  // namespace sphdrop
