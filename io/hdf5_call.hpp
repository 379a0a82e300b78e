#pragma once
// What hdf5_file.cpp and hdf5_attributes.cpp share.

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/hdf5_file.hpp"

namespace sphdrop {

/// What HDF5 says of the call that has just failed; clears its error stack.
std::string hdf5_error_text();

/// Passes on what an HDF5 call returned; negative values mean failure.
template <class Result>
Result checked(Result result, const char* call, const std::string& what) {
  if (result < 0) throw Hdf5Error(fmt::format("{}: {} failed: {}", what, call, hdf5_error_text()));
  return result;
}

/// Of shape [rows] or, with more than one component, [rows, components].
Hdf5Handle dataspace(std::int64_t rows, int components, const std::string& what);

/// A text as HDF5 files it: as a string of fixed length.
class PaddedText {
 public:
  PaddedText(std::string_view text, const std::string& what);
  hid_t type() const { return type_.get(); }
  const char* data() const { return text_.data(); }
  std::size_t size() const { return text_.size(); }

 private:
  std::string text_;
  Hdf5Handle type_;
};

/// The length of a string type; Hdf5Error if it is none of fixed length.
std::size_t fixed_text_size(hid_t type, const std::string& what);

}  // namespace sphdrop
