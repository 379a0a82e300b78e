#include "run/shared_case.hpp"

#include <fmt/format.h>

#include <vector>

#include "config/case_error.hpp"
#include "config/toml_source.hpp"

namespace sphdrop {

std::string shared_case_text(const Communicator& communicator, const std::string& path) {
  std::string text;
  std::vector<std::string> mistakes;
  if (communicator.rank() == 0) {
    try {
      text = read_text_file(path);
    } catch (const CaseError& error) {
      mistakes = error.mistakes();
    }
  }
  std::string joined = fmt::format("{}", fmt::join(mistakes, "\n"));
  communicator.broadcast(joined, 0);
  if (!joined.empty()) throw CaseError({joined});
  communicator.broadcast(text, 0);
  return text;
}

}  // namespace sphdrop
