#include <fmt/format.h>

#include "api/case_content.hpp"
#include "api/translate.hpp"
#include "config/command_line.hpp"
#include "config/effective_case.hpp"
#include "config/key_suggestion.hpp"
#include "config/parameter_store.hpp"
#include "config/parameter_table.hpp"
#include "config/parameter_text.hpp"
#include "run/shared_case.hpp"

namespace sphdrop::v1 {

Case Case::from_text(const std::string& text, const std::vector<std::string>& overrides,
                     const std::string& source_name) {
  return translated([&] {
    return Case(std::make_shared<const Content>(
        Content{text, source_name, overrides, parse_case_text(text, source_name, overrides)}));
  });
}

Case Case::from_file(MPI_Comm communicator, const std::string& path, const std::vector<std::string>& overrides) {
  return from_text(translated([&] { return shared_case_text(Communicator(communicator), path); }), overrides, path);
}

Case Case::with(const std::vector<std::string>& overrides) const {
  std::vector<std::string> all = content_->overrides;
  all.insert(all.end(), overrides.begin(), overrides.end());
  return from_text(content_->text, all, content_->source_name);
}

const std::vector<std::string>& Case::warnings() const {
  return content_->parsed.warnings;
}

std::string Case::value(const std::string& parameter) const {
  const Parameter* found = find_parameter(parameter);
  if (found == nullptr)
    throw Error(Error::Kind::mistake,
                fmt::format("a case has no parameter {}; sphdrop --list-parameters names them all", parameter));
  return value_text(*found, content_->parsed.values);
}

double Case::number(const std::string& parameter) const {
  const std::string text = value(parameter);
  if (const std::optional<double> number = parse_number(text)) return *number;
  throw Error(Error::Kind::mistake, fmt::format("{} = {} is not one number", parameter, text));
}

std::string Case::text() const {
  return effective_case_text(content_->parsed.values);
}

std::string version() {
  return version_text();
}

}  // namespace sphdrop::v1
