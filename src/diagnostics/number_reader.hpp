#pragma once
// Reads back what a to_numbers() has written.

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace sphdrop {

/// Takes numbers off the front of a list one by one. Throws std::invalid_argument when they run out, when a count is
/// not one, or when some are left at the end.
class NumberReader {
 public:
  NumberReader(std::span<const double> numbers, std::string what) : numbers_(numbers), what_(std::move(what)) {}

  double number() {
    if (next_ == numbers_.size()) fail("ends too early");
    return numbers_[next_++];
  }

  bool flag() {
    const double value = number();
    if (value != 0.0 && value != 1.0) fail("holds a flag that is neither 0 nor 1");
    return value == 1.0;
  }

  /// A number of entries that each take numbers_each of the numbers still to come.
  std::size_t count(std::size_t numbers_each) {
    const double value = number();
    const std::size_t room = (numbers_.size() - next_) / numbers_each;
    if (!(value >= 0.0 && value <= static_cast<double>(room))) fail("holds an impossible count");
    const auto whole = static_cast<std::size_t>(value);
    if (static_cast<double>(whole) != value) fail("holds a count that is not a whole number");
    return whole;
  }

  void expect_end() const {
    if (next_ != numbers_.size()) fail("has numbers left over");
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw std::invalid_argument("the stored " + what_ + " " + why + ": it was not written by this version");
  }

 private:
  std::span<const double> numbers_;
  std::string what_;
  std::size_t next_ = 0;
};

}  // namespace sphdrop
