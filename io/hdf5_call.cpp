#include "io/hdf5_call.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace sphdrop {
namespace {

/// The innermost entry of HDF5's error stack says what went wrong; for I/O errors it holds dates, addresses and, what
/// is wanted, the system's message.
herr_t keep_innermost(unsigned, const H5E_error2_t* entry, void* kept) {
  std::string& text = *static_cast<std::string*>(kept);
  text = entry->desc != nullptr ? entry->desc : "no reason given";
  constexpr std::string_view label = "error message = '";
  const std::size_t message = text.find(label);
  if (message != std::string::npos) {
    const std::size_t start = message + label.size();
    text = text.substr(start, text.find('\'', start) - start);
  }
  text += fmt::format(" (in {})", entry->func_name);
  return 0;
}

}  // namespace

std::string hdf5_error_text() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &text);
  H5Eclear2(H5E_DEFAULT);
  return text.empty() ? "no reason given" : text;
}

Hdf5Handle dataspace(std::int64_t rows, int components, const std::string& what) {
  const std::array<hsize_t, 2> sizes = {static_cast<hsize_t>(rows), static_cast<hsize_t>(components)};
  return {checked(H5Screate_simple(components == 1 ? 1 : 2, sizes.data(), nullptr), "H5Screate_simple", what),
          H5Sclose};
}

PaddedText::PaddedText(std::string_view text, const std::string& what)
    // HDF5 has no strings of length zero; a single null byte reads back as the empty one.
    : text_(text.empty() ? std::string(1, '\0') : std::string(text)),
      type_(checked(H5Tcopy(H5T_C_S1), "H5Tcopy", what), H5Tclose) {
  checked(H5Tset_size(type_.get(), text_.size()), "H5Tset_size", what);
  checked(H5Tset_strpad(type_.get(), H5T_STR_NULLPAD), "H5Tset_strpad", what);
  if (std::any_of(text_.begin(), text_.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; })) {
    checked(H5Tset_cset(type_.get(), H5T_CSET_UTF8), "H5Tset_cset", what);
  }
}

std::size_t fixed_text_size(hid_t type, const std::string& what) {
  if (H5Tget_class(type) != H5T_STRING || checked(H5Tis_variable_str(type), "H5Tis_variable_str", what) > 0) {
    throw Hdf5Error(what + ": not a string of fixed length");
  }
  return H5Tget_size(type);
}

}  // namespace sphdrop
