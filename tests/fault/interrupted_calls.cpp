// Signals and clocks that jump at chosen moments, for LD_PRELOAD. On the rank INTERRUPT_RANK the signal
// INTERRUPT_SIGNAL is raised just before the calls number INTERRUPT_NUMBER (from 0 on; several with commas between) of
// the kind INTERRUPT_CALL: MPI_Init, partition (METIS), or write, fsync and rename of files whose path ends in
// INTERRUPT_FILE. With INTERRUPT_WAIT, in s, such a call then waits for a signal that the program handles, as long as
// that at most. With CLOCK_JUMP, in s, the clock that tells the time of day is that much ahead from such a call on.
#include <dlfcn.h>
#include <metis.h>
#include <mpi.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>

namespace {

std::atomic<long> calls = 0;
std::atomic<long> clock_jump = 0;

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool is_chosen(long call) {
  const std::string chosen = std::string(",") + setting("INTERRUPT_NUMBER") + ',';
  return chosen.find(',' + std::to_string(call) + ',') != std::string::npos;
}

void interrupt(std::string_view call) {
  if (call != setting("INTERRUPT_CALL") || !is_chosen(calls++)) return;
  clock_jump = std::atol(setting("CLOCK_JUMP"));
  if (const int signal = std::atoi(setting("INTERRUPT_SIGNAL")); signal != 0) ::kill(::getpid(), signal);
  // Stopping and continuing does not end a sleep; a handler does.
  ::sleep(static_cast<unsigned>(std::atoi(setting("INTERRUPT_WAIT"))));
}

bool is_on_its_rank() {
  return std::string_view(setting("INTERRUPT_RANK")) == setting("OMPI_COMM_WORLD_RANK");
}

void interrupt_on_file(std::string_view call, std::string_view path) {
  if (is_on_its_rank() && path.ends_with(setting("INTERRUPT_FILE"))) interrupt(call);
}

void interrupt_on_file(std::string_view call, int file) {
  if (!is_on_its_rank()) return;
  std::array<char, 4096> target = {};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t length = ::readlink(link.c_str(), target.data(), target.size());
  if (length > 0) interrupt_on_file(call, std::string_view(target.data(), static_cast<std::size_t>(length)));
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int MPI_Init(int* argc, char*** argv) {
  if (is_on_its_rank()) interrupt("MPI_Init");
  return real<decltype(MPI_Init)>("MPI_Init")(argc, argv);
}

int METIS_PartGraphRecursive(idx_t* vertices, idx_t* constraints, idx_t* starts, idx_t* targets, idx_t* weights,
                             idx_t* sizes, idx_t* edge_weights, idx_t* parts, real_t* shares, real_t* imbalances,
                             idx_t* options, idx_t* cut, idx_t* part) {
  if (is_on_its_rank()) interrupt("partition");
  return real<decltype(METIS_PartGraphRecursive)>("METIS_PartGraphRecursive")(vertices, constraints, starts, targets,
                                                                              weights, sizes, edge_weights, parts,
                                                                              shares, imbalances, options, cut, part);
}

int clock_gettime(clockid_t clock, timespec* time) noexcept {
  static const auto call = real<int(clockid_t, timespec*)>("clock_gettime");
  const int result = call(clock, time);
  if (result == 0 && clock == CLOCK_REALTIME) time->tv_sec += clock_jump;
  return result;
}

int rename(const char* from, const char* to) noexcept {
  interrupt_on_file("rename", std::string_view(from));
  return real<int(const char*, const char*)>("rename")(from, to);
}

int fsync(int file) {
  interrupt_on_file("fsync", file);
  return real<int(int)>("fsync")(file);
}

ssize_t write(int file, const void* data, size_t bytes) {
  interrupt_on_file("write", file);
  return real<ssize_t(int, const void*, size_t)>("write")(file, data, bytes);
}

ssize_t pwrite(int file, const void* data, size_t bytes, off_t at) {
  interrupt_on_file("write", file);
  return real<ssize_t(int, const void*, size_t, off_t)>("pwrite")(file, data, bytes, at);
}

ssize_t pwrite64(int file, const void* data, size_t bytes, off_t at) {
  return pwrite(file, data, bytes, at);
}

ssize_t writev(int file, const iovec* parts, int count) {
  interrupt_on_file("write", file);
  return real<ssize_t(int, const iovec*, int)>("writev")(file, parts, count);
}

ssize_t pwritev(int file, const iovec* parts, int count, off_t at) {
  interrupt_on_file("write", file);
  return real<ssize_t(int, const iovec*, int, off_t)>("pwritev")(file, parts, count, at);
}

ssize_t pwritev64(int file, const iovec* parts, int count, off_t at) {
  return pwritev(file, parts, count, at);
}
}
