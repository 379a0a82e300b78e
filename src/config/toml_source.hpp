#pragma once
// TOML text as a tree that remembers where everything stood. The only place that knows the TOML library.

#include <string>
#include <string_view>
#include <vector>

namespace sphdrop {

/// A value and where it stood.
struct TomlNode {
  enum class Kind { integer, real, boolean, date_or_time, string, array, table };
  Kind kind = Kind::table;
  std::string text;                ///< string: its contents; number: as written
  std::vector<TomlNode> elements;  ///< array
  std::vector<TomlNode> members;   ///< table, in ascending order of name
  std::string name;                ///< of a table's member
  int line = 1;
  std::string line_text;  ///< the whole line
};

/// "file:line: message" and below it the line itself.
std::string mistake_at(const std::string& source_name, int line, const std::string& line_text,
                       const std::string& message);

/// The whole file. Throws CaseError where it cannot be read, is no regular file, or is too large to be a case.
std::string read_text_file(const std::string& path);

/// Throws CaseError (one mistake) where the text is not UTF-8 text or not TOML. The answer does not depend on any
/// locale: numbers are handed on as written.
TomlNode parse_toml(std::string_view text, const std::string& source_name);

}  // namespace sphdrop
