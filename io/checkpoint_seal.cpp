#include "io/checkpoint_seal.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <vector>

#include "io/checkpoint.hpp"
#include "io/checkpoint_head.hpp"
#include "io/collective_error.hpp"
#include "io/file_checksum.hpp"
#include "io/posix_file.hpp"

namespace sphdrop {
namespace {

template <class Error>
std::string checksum_of_file(const Communicator& communicator, const std::filesystem::path& path,
                             std::int64_t file_bytes) {
  std::vector<Digest> own;
  collectively<Error>(communicator,
                      [&] { own = own_block_digests(communicator, path, checkpoint_head_bytes, file_bytes); });
  return hexadecimal(combined_digest(communicator, own));
}

CheckpointHead read_head(const std::filesystem::path& path) {
  // Opening a pipe would wait for its other end.
  const auto status = std::filesystem::status(path);
  if (!std::filesystem::exists(status)) throw CheckpointError("is not there");
  if (std::filesystem::is_directory(status)) throw CheckpointError("is a directory");
  if (!std::filesystem::is_regular_file(status)) throw CheckpointError("is no regular file");
  const FileDescriptor file(path, O_RDONLY);
  const std::int64_t file_bytes = file.size();
  std::string start(static_cast<std::size_t>(std::min(file_bytes, checkpoint_head_bytes)), '\0');
  file.read_at(0, std::as_writable_bytes(std::span(start)));
  return parse_head(start, file_bytes);
}

}  // namespace

void seal_checkpoint(const Communicator& communicator, const std::filesystem::path& path) {
  std::int64_t file_bytes = 0;
  collectively<CollectiveError>(communicator,
                                [&] { file_bytes = static_cast<std::int64_t>(std::filesystem::file_size(path)); });
  const std::string checksum = checksum_of_file<CollectiveError>(communicator, path, file_bytes);
  collectively<CollectiveError>(communicator, [&] {
    if (communicator.rank() != 0) return;
    FileDescriptor file(path, O_WRONLY);
    file.write_at(0, format_head({file_bytes, checksum}));
    file.close();
  });
}

void verify_checkpoint(const Communicator& communicator, const std::filesystem::path& path) {
  // Rank 0 judges the head, so that its text is not followed by which rank it was.
  CheckpointHead head;
  std::string problem;
  if (communicator.rank() == 0) {
    try {
      head = read_head(path);
    } catch (const CheckpointError& error) {
      problem = fmt::format("{} {}", path.string(), error.what());
    } catch (const std::exception& error) {
      problem = fmt::format("{} cannot be read: {}", path.string(), error.what());
    }
  }
  communicator.broadcast(problem, 0);
  if (!problem.empty()) throw CheckpointError(problem);
  communicator.broadcast(head.checksum, 0);
  head.file_bytes = communicator.max(head.file_bytes);
  const std::string checksum = checksum_of_file<CheckpointError>(communicator, path, head.file_bytes);
  if (checksum != head.checksum) {
    throw CheckpointError(
        fmt::format("{} is damaged: the checksum of its bytes is {}, not {}", path.string(), checksum, head.checksum));
  }
}

}  // namespace sphdrop
