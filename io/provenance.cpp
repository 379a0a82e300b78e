#include "io/provenance.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <metis.h>
#include <mpi.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "io/posix_file.hpp"

namespace sphdrop {
namespace {

/// ISO 8601, UTC, to the second.
std::string utc_text(std::chrono::system_clock::time_point time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

std::string mpi_version() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text = {};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string_view whole(text.data(), static_cast<std::size_t>(length));
  return std::string(whole.substr(0, whole.find_first_of(",\n")));
}

std::string hdf5_version() {
  unsigned major = 0;
  unsigned minor = 0;
  unsigned release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

/// The host of every rank. Names differ in length, so each travels as a line.
std::vector<std::string> host_names(const Communicator& communicator) {
  std::array<char, 256> name = {};
  ::gethostname(name.data(), name.size() - 1);
  const std::string line = std::string(name.data()) + '\n';
  const std::vector<char> all = communicator.all_gather(std::span<const char>(line));
  std::vector<std::string> hosts(1);
  for (const char character : all) {
    if (character == '\n') {
      hosts.emplace_back();
    } else {
      hosts.back() += character;
    }
  }
  hosts.pop_back();
  return hosts;
}

/// Each host once, in the order of the ranks, with its number of ranks.
JsonObject ranks_by_host(const std::vector<std::string>& hosts) {
  std::vector<std::pair<std::string, int>> counts;
  for (const std::string& host : hosts) {
    auto entry = counts.begin();
    while (entry != counts.end() && entry->first != host) ++entry;
    if (entry == counts.end()) entry = counts.insert(entry, {host, 0});
    ++entry->second;
  }
  JsonObject object;
  for (const auto& [host, count] : counts) object.set(host, count);
  return object;
}

}  // namespace

RunRecord::RunRecord(const Communicator& communicator, std::vector<std::string> command_line)
    : ranks_(communicator.size()),
      hosts_(host_names(communicator)),
      command_line_(std::move(command_line)),
      start_(std::chrono::system_clock::now()),
      clock_start_(std::chrono::steady_clock::now()) {}

void RunRecord::finish(std::string_view status, std::uint64_t state_hash) {
  state_hash_ = fmt::format("{:016x}", state_hash);
  finish(status);
}

void RunRecord::finish(std::string_view status) {
  status_ = status;
  end_ = utc_text(std::chrono::system_clock::now());
  wall_time_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock_start_).count();
}

std::string RunRecord::json() const {
  const BuildInfo& build = build_info();
  JsonObject built;
  built.set("compiler", build.compiler);
  built.set("flags", build.flags);
  built.set("architecture", build.architecture);
  built.set("vector_width", build.vector_width);
  JsonObject libraries;
  libraries.set("mpi", mpi_version());
  libraries.set("hdf5", hdf5_version());
  libraries.set("metis", fmt::format("{}.{}.{}", METIS_VER_MAJOR, METIS_VER_MINOR, METIS_VER_SUBMINOR));

  JsonObject record;
  record.set("program", "sphdrop");
  record.set("version", build.version);
  record.set("git_commit", build.git_commit);
  record.set("build", built);
  record.set("libraries", libraries);
  record.set("command_line", std::span<const std::string>(command_line_));
  record.set("ranks", ranks_);
  record.set("ranks_by_host", ranks_by_host(hosts_));
  record.set("start", utc_text(start_));
  record.set("status", status_);
  if (!end_.empty()) {
    record.set("end", end_);
    record.set("wall_time_seconds", wall_time_);
  }
  if (!state_hash_.empty()) record.set("state_hash", state_hash_);
  if (!details_.empty()) record.set("details", details_);
  return record.text() + '\n';
}

void RunRecord::write(const Communicator& communicator, const std::filesystem::path& directory) const {
  collectively<RunRecordError>(communicator, [&] {
    if (communicator.rank() == 0) write_file_atomically(directory / "run.json", json());
  });
}

}  // namespace sphdrop
