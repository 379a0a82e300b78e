#include <fmt/format.h>

#include "api/case_content.hpp"
#include "api/translate.hpp"
#include "config/command_line.hpp"
#include "config/effective_case.hpp"
#include "config/key_suggestion.hpp"
#include "config/parameter_store.hpp"
#include "config/parameter_table.hpp"
#include "config/parameter_text.hpp"
#include "run/particle_file.hpp"
#include "run/shared_case.hpp"

namespace sphdrop::v1 {

namespace {

std::shared_ptr<const GivenParticles> read_alone(const ParticleRequest& request) {
  return read_particle_file(request.path, request.path);
}

}  // namespace

std::shared_ptr<const Case::Content> Case::Content::make(const std::string& text, const std::string& source_name,
                                                         const std::vector<std::string>& overrides,
                                                         ParticlesByPath particles, const ParticleReader& read) {
  ParsedCase parsed = parse_case_text(text, source_name, overrides, [&](const ParticleRequest& request) {
    auto found = particles.find(request.path);
    if (found == particles.end()) found = particles.emplace(request.path, read(request)).first;
    return found->second;
  });
  return std::make_shared<const Content>(
      Content{text, source_name, overrides, std::move(particles), std::move(parsed)});
}

Case Case::from_text(const std::string& text, const std::vector<std::string>& overrides,
                     const std::string& source_name) {
  return translated([&] { return Case(Content::make(text, source_name, overrides, {}, read_alone)); });
}

Case Case::from_file(MPI_Comm communicator, const std::string& path, const std::vector<std::string>& overrides) {
  return translated([&] {
    const Communicator all(communicator);
    return Case(Content::make(shared_case_text(all, path), path, overrides, {},
                              [&](const ParticleRequest& request) { return shared_particles(all, request, {}); }));
  });
}

Case Case::with(const std::vector<std::string>& overrides) const {
  return translated([&] {
    std::vector<std::string> all = content_->overrides;
    all.insert(all.end(), overrides.begin(), overrides.end());
    return Case(Content::make(content_->text, content_->source_name, all, content_->particles, read_alone));
  });
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
