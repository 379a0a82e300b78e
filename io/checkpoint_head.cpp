#include "io/checkpoint_head.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "io/checkpoint.hpp"
#include "io/file_checksum.hpp"

namespace sphdrop {
namespace {

constexpr std::string_view magic = "sphdrop checkpoint ";
constexpr std::string_view seal_label = "head_checksum ";

/// Everything that is sealed by the head's own checksum.
std::string sealed_text(const CheckpointHead& head) {
  return fmt::format(
      "{}{}\n"
      "Behind these {} bytes of text begins HDF5: h5dump and h5py read the file as it is.\n"
      "bytes {}\n"
      "block_bytes {}\n"
      "checksum {}\n",
      magic, checkpoint_format, checkpoint_head_bytes, head.file_bytes, checksum_block_bytes, head.checksum);
}

std::string seal_line(std::string_view sealed) {
  return fmt::format("{}{}\n", seal_label, hexadecimal(digest_of(sealed)));
}

std::optional<std::int64_t> number_at_start(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool ends_well = error == std::errc() && end != text.data() + text.size() && *end == '\n';
  return ends_well ? std::optional(number) : std::nullopt;
}

/// What follows "<label> " at the start of a line.
std::string_view value_of(std::string_view text, std::string_view label) {
  const std::size_t found = text.find(fmt::format("\n{} ", label));
  return found == std::string_view::npos ? std::string_view() : text.substr(found + label.size() + 2);
}

[[noreturn]] void refuse_damaged_head() {
  throw CheckpointError(
      fmt::format("is damaged: its first {} bytes do not match their own checksum", checkpoint_head_bytes));
}

}  // namespace

std::string format_head(const CheckpointHead& head) {
  std::string text = sealed_text(head);
  text += seal_line(text);
  text.resize(static_cast<std::size_t>(checkpoint_head_bytes), '\0');
  return text;
}

CheckpointHead parse_head(std::string_view start, std::int64_t file_bytes) {
  if (file_bytes == 0) throw CheckpointError("is empty");
  if (start.starts_with("\x89HDF\r\n")) {
    throw CheckpointError("is no checkpoint of sphdrop, but another HDF5 file (a snapshot?)");
  }
  const std::size_t compared = std::min(start.size(), magic.size());
  if (start.substr(0, compared) != magic.substr(0, compared)) throw CheckpointError("is no checkpoint of sphdrop");
  if (file_bytes < checkpoint_head_bytes) {
    throw CheckpointError(fmt::format("is truncated: {} bytes are there, too few for any checkpoint", file_bytes));
  }

  // The first and the last line of the text are the same in all formats.
  const std::size_t seal = start.find(fmt::format("\n{}", seal_label));
  if (seal == std::string_view::npos) refuse_damaged_head();
  const std::string_view sealed = start.substr(0, seal + 1);
  if (!start.substr(seal + 1).starts_with(seal_line(sealed))) refuse_damaged_head();
  const auto format = number_at_start(start.substr(magic.size()));
  if (!format) refuse_damaged_head();
  if (*format != checkpoint_format) {
    throw CheckpointError(
        fmt::format("is of format {}, which is {} than format {} that this program reads; go on with the version of "
                    "sphdrop that wrote it",
                    *format, *format > checkpoint_format ? "newer" : "older", checkpoint_format));
  }

  CheckpointHead head;
  head.file_bytes = number_at_start(value_of(sealed, "bytes")).value_or(-1);
  head.checksum = std::string(value_of(sealed, "checksum").substr(0, 2 * sizeof(Digest)));
  // Leaves no byte of the head unchecked, not even those behind its text.
  if (format_head(head) != start) refuse_damaged_head();
  if (file_bytes < head.file_bytes) {
    throw CheckpointError(fmt::format("is truncated: {} of {} bytes are there", file_bytes, head.file_bytes));
  }
  if (file_bytes > head.file_bytes) {
    throw CheckpointError(
        fmt::format("is damaged: there are {} bytes behind its {}", file_bytes - head.file_bytes, head.file_bytes));
  }
  return head;
}

}  // namespace sphdrop
