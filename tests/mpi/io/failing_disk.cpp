// A disk that fails, for LD_PRELOAD: on the rank FAILING_RANK, writes to files whose path ends in FAILING_FILE work for
// FAILING_AFTER bytes and then return EIO (FAILING_MODE=error), do so once only (FAILING_MODE=transient), pretend
// success (FAILING_MODE=silent) or do so once only (FAILING_MODE=lost).
#include <dlfcn.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

std::atomic<long> written = 0;
std::atomic<bool> failed_once = false;

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool concerns(int file) {
  if (std::string_view(setting("FAILING_RANK")) != setting("OMPI_COMM_WORLD_RANK")) return false;
  std::array<char, 4096> target = {};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t length = ::readlink(link.c_str(), target.data(), target.size());
  return length > 0 &&
         std::string_view(target.data(), static_cast<std::size_t>(length)).ends_with(setting("FAILING_FILE"));
}

/// What a write of `bytes` returns if it fails; 0 if it is to go ahead.
ssize_t failure(int file, std::size_t bytes) {
  if (!concerns(file)) return 0;
  const long beyond = (written += static_cast<long>(bytes)) - std::atol(setting("FAILING_AFTER"));
  const std::string_view mode = setting("FAILING_MODE");
  const bool is_once = mode == "transient" || mode == "lost";
  if (beyond <= 0 || (is_once && failed_once.exchange(true))) return 0;
  if (mode == "silent" || mode == "lost") return static_cast<ssize_t>(bytes);
  errno = EIO;
  return -1;
}

std::size_t total(const iovec* parts, int count) {
  std::size_t bytes = 0;
  for (int k = 0; k < count; ++k) bytes += parts[k].iov_len;
  return bytes;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* data, size_t bytes) {
  static const auto call = real<ssize_t(int, const void*, size_t)>("write");
  const ssize_t failed = failure(file, bytes);
  return failed != 0 ? failed : call(file, data, bytes);
}

ssize_t pwrite(int file, const void* data, size_t bytes, off_t at) {
  static const auto call = real<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  const ssize_t failed = failure(file, bytes);
  return failed != 0 ? failed : call(file, data, bytes, at);
}

ssize_t pwrite64(int file, const void* data, size_t bytes, off_t at) {
  return pwrite(file, data, bytes, at);
}

ssize_t writev(int file, const iovec* parts, int count) {
  static const auto call = real<ssize_t(int, const iovec*, int)>("writev");
  const ssize_t failed = failure(file, total(parts, count));
  return failed != 0 ? failed : call(file, parts, count);
}

ssize_t pwritev(int file, const iovec* parts, int count, off_t at) {
  static const auto call = real<ssize_t(int, const iovec*, int, off_t)>("pwritev");
  const ssize_t failed = failure(file, total(parts, count));
  return failed != 0 ? failed : call(file, parts, count, at);
}

ssize_t pwritev64(int file, const iovec* parts, int count, off_t at) {
  return pwritev(file, parts, count, at);
}
}
