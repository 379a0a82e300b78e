#pragma once
// The 512 bytes of text at the start of a checkpoint, before HDF5's own: by them it is known, and known to be whole,
// before HDF5 sees any of it. io/FORMAT.md has the layout.

#include <cstdint>
#include <string>
#include <string_view>

namespace sphdrop {

constexpr std::int64_t checkpoint_head_bytes = 512;
constexpr std::int64_t checkpoint_format = 1;

struct CheckpointHead {
  std::int64_t file_bytes = 0;
  std::string checksum;  ///< of all bytes behind the head, 32 hexadecimal digits
};

/// checkpoint_head_bytes of text.
std::string format_head(const CheckpointHead& head);

/// `start`: the file's first checkpoint_head_bytes, or all it has; `file_bytes`: its size. Throws CheckpointError with
/// what is wrong ("is truncated: ..."): not a checkpoint, of another format, damaged, not as long as it should be.
CheckpointHead parse_head(std::string_view start, std::int64_t file_bytes);

}  // namespace sphdrop
