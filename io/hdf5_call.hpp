#pragma once
// What hdf5_file.cpp and hdf5_attributes.cpp share.

#include <fmt/format.h>

#include <cstdint>
#include <string>

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

}  // namespace sphdrop
