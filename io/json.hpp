#pragma once
// As much JSON as the program writes: objects whose members keep the order in which they were added.

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sphdrop {

/// `text` as a JSON string, quotes included. Bytes that are not UTF-8 become U+FFFD, so that the result always is.
std::string json_string(std::string_view text);

/// The shortest number that reads back to the same bits; null where there is none (NaN, infinities).
std::string json_number(double value);

/// A JSON array of strings.
std::string json_array(std::span<const std::string> items);

/// A JSON object under construction. Setting a member again replaces its value and keeps its place.
class JsonObject {
 public:
  void set(std::string_view name, std::string_view value) { set_encoded(name, json_string(value)); }
  void set(std::string_view name, const char* value) { set_encoded(name, json_string(value)); }
  void set(std::string_view name, double value) { set_encoded(name, json_number(value)); }
  void set(std::string_view name, bool value) { set_encoded(name, value ? "true" : "false"); }
  template <std::integral Integer>
  void set(std::string_view name, Integer value) {
    set_encoded(name, std::to_string(value));
  }
  void set(std::string_view name, std::span<const std::string> values) { set_encoded(name, json_array(values)); }
  void set(std::string_view name, const JsonObject& value) { set_encoded(name, value.text()); }
  /// A value that is JSON already.
  void set_encoded(std::string_view name, std::string value);

  bool empty() const { return members_.empty(); }
  /// One member a line, indented by two spaces a level, without a newline at the end.
  std::string text() const;

 private:
  std::vector<std::pair<std::string, std::string>> members_;
};

}  // namespace sphdrop
