#include "config/case_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "config/consistency.hpp"
#include "config/derived_defaults.hpp"
#include "config/key_suggestion.hpp"
#include "config/mode_presets.hpp"
#include "config/override.hpp"
#include "config/parameter_store.hpp"
#include "config/parameter_table.hpp"
#include "config/parameter_text.hpp"
#include "config/several_drops.hpp"
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
  CaseReader(std::string source_name, const ParticleReader& read_particles)
      : source_name_(std::move(source_name)), read_particles_(read_particles) {}

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

  void take_section(const TomlNode& section, std::size_t index = 0);
  void take_several(const TomlNode& array);
  void store_values();
  void store_given(const Parameter& parameter, Which which, Case& values);
  void take_particles();
  void take_particles(Case& one, Which which);
  void apply_presets();
  void report_missing(const Parameter& parameter);
  void find_contradictions();
  std::vector<std::string> find_doubts() const;
  std::string located(const Finding& finding, Which which) const;
  std::string origins(const Finding& finding, Which which) const;
  std::size_t count_of(std::string_view section) const {
    return section == "drop" ? drop_count_ : section == "solid" ? solid_count_ : 1;
  }

  std::string source_name_;
  const ParticleReader& read_particles_;
  std::map<std::string, Given, std::less<>> given_;
  std::map<std::string, TomlNode, std::less<>> section_headers_;
  std::set<std::string, std::less<>> unusable_;
  std::size_t drop_count_ = 1, solid_count_ = 1;
  std::vector<Mistake> mistakes_;
  Case values_;
};

bool is_section(std::string_view name) {
  const auto names = section_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_array_of_tables(const TomlNode& node) {
  return node.kind == TomlNode::Kind::array && !node.elements.empty() &&
         std::all_of(node.elements.begin(), node.elements.end(),
                     [](const TomlNode& element) { return element.kind == TomlNode::Kind::table; });
}

void CaseReader::take_file(const TomlNode& root) {
  for (const TomlNode& member : root.members) {
    const bool is_plain = member.name.find('.') == std::string::npos;
    if (is_plain && find_parameter(member.name) != nullptr) {
      given_[member.name] = {member, ""};
    } else if (is_section(member.name)) {
      if (member.kind == TomlNode::Kind::table) {
        take_section(member);
      } else if (may_repeat(member.name) && is_array_of_tables(member)) {
        take_several(member);
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

void CaseReader::take_section(const TomlNode& section, std::size_t index) {
  section_headers_[section.name] = section;
  for (const TomlNode& member : section.members) {
    const std::string key = section.name + "." + member.name;
    if (find_parameter(key) != nullptr) {
      given_[key_of(key, {section.name, index})] = {member, ""};
    } else {
      mistake_in_file(member, unknown_key_message(section.name, member.name));
    }
  }
}

void CaseReader::take_several(const TomlNode& array) {
  (array.name == "drop" ? drop_count_ : solid_count_) = array.elements.size();
  for (std::size_t k = 0; k < array.elements.size(); ++k) {
    TomlNode one = array.elements[k];
    one.name = array.name;
    take_section(one, k);
  }
}

void CaseReader::take_overrides(const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) {
    Override parsed = parse_override(text);
    const std::string section = parsed.key.substr(0, parsed.key.find('.'));
    if (parsed.mistake.empty() && parsed.index >= count_of(section)) {
      mistake_in_override(text,
                          fmt::format("the case has {0} {1}{2}; each further one is a section [[{1}]] of its file",
                                      count_of(section), section, count_of(section) == 1 ? "" : "s"));
    } else if (parsed.mistake.empty()) {
      given_[key_of(parsed.key, {section, parsed.index})] = {std::move(parsed.value), text};
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

void CaseReader::store_given(const Parameter& parameter, Which which, Case& values) {
  store_default(parameter, values);
  const std::string key = key_of(parameter.key, which);
  const auto found = given_.find(key);
  if (found == given_.end()) {
    if (!is_required(parameter)) return;
    unusable_.insert(key);
    report_missing(parameter);
  } else if (auto mistake = store(parameter, found->second.node, values)) {
    unusable_.insert(key);
    if (which.index > 0) mistake->replace(0, parameter.key.size(), key);
    if (found->second.override_text.empty()) {
      mistake_in_file(found->second.node, *mistake);
    } else {
      mistake_in_override(found->second.override_text, *mistake);
    }
  }
}

void CaseReader::store_values() {
  for (const Parameter& parameter : parameter_table()) store_given(parameter, {}, values_);
  for (std::size_t k = 1; k < drop_count_; ++k) {
    Case scratch;
    for (const Parameter& parameter : parameter_table())
      if (parameter.section() == "drop") store_given(parameter, {"drop", k}, scratch);
    values_.more_drops.push_back(scratch.drop);
  }
  for (std::size_t k = 1; k < solid_count_; ++k) {
    Case scratch;
    for (const Parameter& parameter : parameter_table())
      if (parameter.section() == "solid") store_given(parameter, {"solid", k}, scratch);
    values_.more_solids.push_back(scratch.solid);
  }
}

void CaseReader::take_particles(Case& one, Which which) {
  const auto is_given = [&](std::string_view key) { return given_.contains(key_of(key, which)); };
  take_shape(one.drop, is_given);
  if (one.drop.particles_file.empty() || one.drop.shape != DropShape::particles || !read_particles_) return;
  const std::string key = key_of("drop.particles_file", which);
  const Given& named = given_.find(key)->second;
  const bool is_override = !named.override_text.empty();
  const auto mistake = [&](const std::string& message) {
    // What follows from the particles is not there.
    for (const char* spoilt : {"drop.particles_file", "drop.diameter", "drop.placement"})
      unusable_.insert(key_of(spoilt, which));
    if (is_override) {
      mistake_in_override(named.override_text, message);
    } else {
      mistake_in_file(named.node, message);
    }
  };
  const std::string path = particle_file_path(one.drop.particles_file, source_name_);
  try {
    const std::string wrong =
        take_given_particles(one, is_given, read_particles_({path, values_.output.directory, which.index}));
    if (!wrong.empty()) mistake(wrong);
  } catch (const ParticleFileError& error) {
    mistake(fmt::format("{} = {} {}", key, quoted(one.drop.particles_file), error.what()));
    if (!error.is_located) return;
    const std::string origin = is_override ? fmt::format("--set {}", printable(named.override_text))
                                           : fmt::format("{}:{}", source_name_, named.node.line);
    mistakes_.back().text = fmt::format("{} ({}: {})", error.what(), key, origin);
  }
}

void CaseReader::take_particles() {
  for (std::size_t k = 0; k < drop_count_; ++k) {
    Case one = values_.with_drop(k);
    take_particles(one, {"drop", k});
    (k == 0 ? values_.drop : values_.more_drops[k - 1]) = std::move(one.drop);
  }
}

// " (drop.diameter: line 7; resolution.spacing: --set; drop.shape: not given)"
std::string CaseReader::origins(const Finding& finding, Which which) const {
  constexpr std::size_t few = 4;
  std::string text;
  for (const std::string_view parameter : finding.keys) {
    const std::string key = key_of(parameter, which);
    const auto found = given_.find(key);
    std::string origin = "not given";
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
std::string CaseReader::located(const Finding& finding, Which which) const {
  const std::string name = which.index > 0 ? fmt::format("{} {}: ", which.section, which.index + 1) : "";
  const std::string message = name + finding.message + origins(finding, which);
  for (const std::string_view key : finding.keys) {
    const auto found = given_.find(key_of(key, which));
    if (found == given_.end()) continue;
    const Given& given = found->second;
    if (!given.override_text.empty()) return fmt::format("--set {}: {}", printable(given.override_text), message);
    return mistake_at(source_name_, given.node.line, given.node.line_text, message);
  }
  return mistake_at(source_name_, 1, "", message);
}

bool concerns(const Finding& finding, std::string_view section) {
  return std::any_of(finding.keys.begin(), finding.keys.end(), [&](std::string_view key) {
    return key.starts_with(section) && key.substr(section.size()).starts_with('.');
  });
}

// Of the first drop and solid all that is wrong, of every further one what has to do with it.
void CaseReader::find_contradictions() {
  const auto find = [&](const Case& values, Which which) {
    const auto is_usable = [&](std::string_view key) { return !unusable_.contains(key_of(key, which)); };
    for (const Finding& finding : contradictions(values, is_usable))
      if (which.index == 0 || concerns(finding, which.section)) mistakes_.push_back({no_line, located(finding, which)});
  };
  find(values_, {});
  for (std::size_t k = 1; k < drop_count_; ++k) find(values_.with_drop(k), {"drop", k});
  for (std::size_t k = 1; k < solid_count_; ++k) find(values_.with_solid(k), {"solid", k});
}

std::vector<std::string> CaseReader::find_doubts() const {
  std::vector<std::string> warnings;
  const auto find = [&](const Case& values, Which which) {
    for (const Finding& doubt : doubts(values))
      if (which.index == 0 || concerns(doubt, which.section)) warnings.push_back(located(doubt, which));
  };
  find(values_.more_drops.empty() ? values_ : values_.with_drop(0), {});
  for (std::size_t k = 1; k < drop_count_; ++k) find(values_.with_drop(k), {"drop", k});
  for (std::size_t k = 1; k < solid_count_; ++k) find(values_.with_solid(k), {"solid", k});
  return warnings;
}

void CaseReader::apply_presets() {
  const Case plain = values_;
  for (const Preset& preset : mode_presets()) {
    if (values_.mode < preset.mode) continue;
    const Parameter& parameter = *find_parameter(preset.key);
    const TomlNode value = parse_toml("value = " + std::string(preset.value), "mode").members.front();
    if (!given_.contains(preset.key) && preset.applies(plain)) {
      [[maybe_unused]] const auto mistake = store(parameter, value, values_);
      assert(!mistake);
    }
    for (std::size_t k = 1; parameter.section() == "solid" && k < solid_count_; ++k) {
      Case one = plain.with_solid(k);
      if (given_.contains(key_of(preset.key, {"solid", k})) || !preset.applies(one)) continue;
      one.solid = values_.more_solids[k - 1];
      [[maybe_unused]] const auto mistake = store(parameter, value, one);
      assert(!mistake);
      values_.more_solids[k - 1] = one.solid;
    }
  }
}

ParsedCase CaseReader::finish() {
  store_values();
  fill_names(values_, source_name_);
  take_particles();
  apply_presets();
  fill_derived_defaults(values_);
  find_contradictions();
  if (!mistakes_.empty()) {
    std::stable_sort(mistakes_.begin(), mistakes_.end(),
                     [](const Mistake& a, const Mistake& b) { return a.line < b.line; });
    std::vector<std::string> texts;
    for (Mistake& mistake : mistakes_) texts.push_back(std::move(mistake.text));
    throw CaseError(std::move(texts));
  }
  return {values_, find_doubts()};
}

}  // namespace

ParsedCase parse_case_text(std::string_view text, const std::string& source_name,
                           const std::vector<std::string>& overrides, const ParticleReader& read_particles) {
  const TomlNode root = parse_toml(text, source_name);
  if (root.members.empty() && overrides.empty()) {
    throw CaseError({fmt::format(
        "{}:1: the case is empty; it must at least say resolution.spacing and time.end, in TOML", source_name)});
  }
  CaseReader reader(source_name, read_particles);
  reader.take_file(root);
  reader.take_overrides(overrides);
  return reader.finish();
}

ParsedCase read_case_file(const std::string& path, const std::vector<std::string>& overrides) {
  return parse_case_text(read_text_file(path), path, overrides);
}

}  // namespace sphdrop
