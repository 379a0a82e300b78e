#pragma once
// What a case file's author is told when the file cannot be used.

#include <stdexcept>
#include <string>
#include <vector>

namespace sphdrop {

/// All mistakes found in a case. Each starts with where it is, `file:line: ` or `--set key=value: `, and is followed by
/// the offending line where there is one. what() joins them by newlines.
class CaseError : public std::runtime_error {
 public:
  explicit CaseError(std::vector<std::string> mistakes)
      : std::runtime_error(joined(mistakes)), mistakes_(std::move(mistakes)) {}

  const std::vector<std::string>& mistakes() const { return mistakes_; }

 private:
  static std::string joined(const std::vector<std::string>& mistakes) {
    std::string text;
    for (const std::string& mistake : mistakes) {
      if (!text.empty()) text += '\n';
      text += mistake;
    }
    return text;
  }

  std::vector<std::string> mistakes_;
};

}  // namespace sphdrop
