#include "config/toml_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <toml.hpp>

#include "config/case_error.hpp"
#include "config/utf8.hpp"

namespace sphdrop {
namespace {

using TomlValue = toml::basic_value<toml::discard_comments, std::map, std::vector>;

// Far beyond any real case. They keep hostile or mistaken files from exhausting the stack in the recursive parser.
constexpr std::size_t largest_file = 1 << 20;
constexpr std::size_t longest_line = 4096;
constexpr std::ptrdiff_t most_brackets = 1000;

[[noreturn]] void fail(const std::string& mistake) {
  throw CaseError({mistake});
}

TomlNode::Kind kind_of(const TomlValue& value) {
  switch (value.type()) {
    case toml::value_t::boolean:
      return TomlNode::Kind::boolean;
    case toml::value_t::integer:
      return TomlNode::Kind::integer;
    case toml::value_t::floating:
      return TomlNode::Kind::real;
    case toml::value_t::string:
      return TomlNode::Kind::string;
    case toml::value_t::array:
      return TomlNode::Kind::array;
    case toml::value_t::table:
      return TomlNode::Kind::table;
    default:
      return TomlNode::Kind::date_or_time;
  }
}

TomlNode convert(const TomlValue& value) {
  TomlNode node;
  node.kind = kind_of(value);
  const toml::source_location where = value.location();
  node.line = static_cast<int>(where.line());
  node.line_text = where.line_str();
  if (value.is_table()) {
    for (const auto& [name, member] : value.as_table()) {
      node.members.push_back(convert(member));
      node.members.back().name = name;
    }
  } else if (value.is_array()) {
    for (const auto& element : value.as_array()) node.elements.push_back(convert(element));
  } else if (value.is_string()) {
    node.text = value.as_string().str;
  } else {
    // The library reads numbers through the global locale and does not notice overflow, so take them as written.
    node.text = node.line_text.substr(where.column() - 1, where.region());
  }
  return node;
}

struct Line {
  int number = 1;
  std::string_view text;
};

Line line_at(std::string_view text, std::size_t offset) {
  const std::size_t newline_before = offset == 0 ? std::string_view::npos : text.rfind('\n', offset - 1);
  const std::size_t begin = newline_before == std::string_view::npos ? 0 : newline_before + 1;
  const std::size_t end = std::min(text.find('\n', offset), text.size());
  return {1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n')),
          text.substr(begin, end - begin)};
}

// An upper bound. Closing ones count where nothing but a comment can make them part of a text, so that a list of many
// points is no deep nesting.
std::ptrdiff_t brackets_open_at_most(std::string_view text) {
  const bool may_quote_lines =
      text.find("\"\"\"") != std::string_view::npos || text.find("'''") != std::string_view::npos;
  std::ptrdiff_t open = 0, most = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    const bool has_text = may_quote_lines || line.find_first_of("\"'") != std::string_view::npos;
    if (!has_text) line = line.substr(0, line.find('#'));
    for (const char c : line) {
      if (c == '[' || c == '{') most = std::max(most, ++open);
      if (!has_text && (c == ']' || c == '}')) open = std::max<std::ptrdiff_t>(0, open - 1);
    }
    begin = end + 1;
  }
  return most;
}

void check_is_text(std::string_view text, const std::string& source_name) {
  if (text.size() > largest_file) {
    fail(fmt::format("{}:1: the file has {} bytes; a case has at most {}", source_name, text.size(), largest_file));
  }
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_control(text[i]) || text[i] == '\n' || text[i] == '\r' || text[i] == '\t') continue;
    fail(fmt::format("{}:{}: the file holds the control character 0x{:02x}; a case is plain text (TOML), not binary",
                     source_name, line_at(text, i).number, static_cast<unsigned char>(text[i])));
  }
  if (const auto offset = first_invalid_utf8(text)) {
    const Line line = line_at(text, *offset);
    fail(fmt::format("{}:{}: byte {} of the line (0x{:02x}) is not UTF-8; save the file in UTF-8 encoding", source_name,
                     line.number, text.data() + *offset - line.text.data() + 1,
                     static_cast<unsigned char>(text[*offset])));
  }
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > longest_line) {
      fail(fmt::format("{}:{}: the line has {} bytes; a line of a case has at most {}", source_name,
                       line_at(text, begin).number, end - begin, longest_line));
    }
    begin = end + 1;
  }
  const std::ptrdiff_t brackets = brackets_open_at_most(text);
  if (brackets > most_brackets) {
    fail(fmt::format("{}:1: the file holds {} opening brackets, one within the other; a case has at most {}",
                     source_name, brackets, most_brackets));
  }
}

std::string without_last_point(std::string text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '.' || text.back() == ':')) text.pop_back();
  return text;
}

struct Marked {
  int line = 0;
  std::string text;
  std::string comment;
};

// The library's message is a drawing: lines " 12 | text of line 12", each followed by "    |   ^--- comment".
std::vector<Marked> marked_lines(const std::string& drawing) {
  std::vector<Marked> found;
  std::istringstream lines(drawing);
  for (std::string row; std::getline(lines, row);) {
    const std::size_t bar = row.find(" | ");
    if (bar == std::string::npos) continue;
    std::string digits;  // between them a locale may have put separators
    std::copy_if(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(bar), std::back_inserter(digits),
                 [](char c) { return c >= '0' && c <= '9'; });
    const std::string rest = row.substr(bar + 3);
    if (!digits.empty() && digits.size() < 9) {
      found.push_back({std::stoi(digits), rest, ""});
    } else if (!found.empty()) {
      const std::size_t mark = rest.find_last_of("^~");
      if (mark != std::string::npos) {
        const std::size_t comment = rest.find_first_not_of("-~ ", mark + 1);
        if (comment != std::string::npos) found.back().comment = without_last_point(rest.substr(comment));
      }
    }
  }
  return found;
}

std::string headline(const std::string& drawing) {
  std::string text = drawing.substr(0, drawing.find('\n'));
  for (const std::string_view prefix : {"[error] ", "toml::"}) {
    if (text.starts_with(prefix)) {
      text.erase(0, prefix == "toml::" ? text.find(": ") + 2 : prefix.size());
    }
  }
  return without_last_point(text);
}

bool is_word(std::string_view text) {
  return !text.empty() && ((text[0] | 0x20) >= 'a' && (text[0] | 0x20) <= 'z') &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || ((c | 0x20) >= 'a' && (c | 0x20) <= 'z') || c == '_' || c == '-' ||
                  c == '.' || c == '/';
         });
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// What the author most likely meant, for the slips that TOML's rules make likely; "" if nothing comes to mind.
std::string likely_slip(std::string_view line) {
  line = trimmed(line);
  const std::size_t equals = line.find('=');
  if (line.starts_with('[') && equals == std::string_view::npos) {
    return line.find(']') == std::string_view::npos ? "the closing ] is missing" : "";
  }
  if (equals == std::string_view::npos) return "a line reads key = value, or [section]";
  const std::string_view value = trimmed(line.substr(equals + 1, line.find('#', equals) - equals - 1));
  if (value.empty()) return "a value must follow the =";
  if (value == "True" || value == "False") return "true and false are written in lower case";
  if (is_word(value)) return fmt::format("words need quotes: \"{}\"", value);
  if (value.front() == '"' && value.find('\\') != std::string_view::npos) {
    return "in \"...\" a backslash is written \\\\; in '...' it stands for itself";
  }
  if ((value.front() == '"' || value.front() == '\'') && value.find(value.front(), 1) == std::string_view::npos) {
    return "the closing quote is missing";
  }
  if (value.front() == '[' && value.find(']') == std::string_view::npos) return "the closing ] is missing";
  const std::size_t point = value.find('.');
  const auto is_digit = [&](std::size_t i) { return i < value.size() && value[i] >= '0' && value[i] <= '9'; };
  if (point != std::string_view::npos && (is_digit(point - 1) != is_digit(point + 1))) {
    return "a decimal point needs digits on both sides: 0.5, 1.0";
  }
  if (is_digit(0) && value.find(',') != std::string_view::npos) return "the decimal sign is a point: 0.5";
  if (is_digit(0) && value.find(' ') != std::string_view::npos) {
    return "a value with a unit stands in quotes (\"1 mm\"), and every value alone on its line";
  }
  return "";
}

// The name that the library puts as ("name") into a message.
std::string quoted_name(const std::string& message) {
  const std::size_t begin = message.find("(\"");
  const std::size_t end = message.find("\")", begin);
  if (begin == std::string::npos || end == std::string::npos) return "this";
  return message.substr(begin + 2, end - begin - 2);
}

[[noreturn]] void fail_in_our_words(const toml::exception& error, const std::string& source_name) {
  const std::vector<Marked> marks = marked_lines(error.what());
  std::string message = headline(error.what());
  if (marks.empty()) fail(fmt::format("{}:{}: not valid TOML: {}", source_name, error.location().line(), message));
  if (marks.size() > 1 && marks.front().comment.find("already") != std::string::npos) {
    const std::string_view together = message.starts_with("value") ? "" : ", or all its keys in one place";
    fail(mistake_at(source_name, marks.back().line, marks.back().text,
                    fmt::format("{} is given twice, first in line {}; keep one of them{}", quoted_name(message),
                                marks.front().line, together)));
  }
  const Marked& mark = marks.front();
  if (!mark.comment.empty() && mark.comment != "here") message += ", " + mark.comment;
  std::string slip = likely_slip(mark.text);
  if (slip.empty() && message.find("unknown value") != std::string::npos)
    slip = "behind the = a number (1e-3), a text in quotes or [x, y] is wanted";
  if (!slip.empty()) message = fmt::format("{} (the reader of TOML says: {})", slip, message);
  fail(mistake_at(source_name, mark.line, mark.text, "not valid TOML: " + message));
}

}  // namespace

std::string mistake_at(const std::string& source_name, int line, const std::string& line_text,
                       const std::string& message) {
  std::string text = fmt::format("{}:{}: {}", source_name, line, message);
  const std::string_view shown = trimmed(line_text);
  if (!shown.empty()) text += fmt::format("\n    {} | {}", line, shown);
  return text;
}

std::string read_text_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    fail(fmt::format("{}: there is no such file", path));
  }
  if (std::filesystem::is_directory(status)) {
    fail(fmt::format("{}: this is a folder; give the case file inside it", path));
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  std::string text(largest_file + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) fail(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > largest_file) {
    fail(fmt::format("{}: the file is larger than {} bytes, the most a case may have", path, largest_file));
  }
  return text;
}

TomlNode parse_toml(std::string_view text, const std::string& source_name) {
  check_is_text(text, source_name);
  std::istringstream stream{std::string(text)};
  try {
    return convert(toml::parse<toml::discard_comments, std::map, std::vector>(stream, ""));
  } catch (const toml::exception& error) {
    fail_in_our_words(error, source_name);
  } catch (const std::exception& error) {
    fail(fmt::format("{}:1: not valid TOML: {}", source_name, error.what()));
  }
}

}  // namespace sphdrop
