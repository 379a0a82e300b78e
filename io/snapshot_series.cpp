#include "io/snapshot_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/collective_error.hpp"
#include "io/hdf5_file.hpp"
#include "io/json.hpp"
#include "io/posix_file.hpp"

namespace sphdrop {
namespace {

std::string index_text(std::span<const double> times) {
  std::string files;
  for (std::size_t number = 0; number < times.size(); ++number) {
    files +=
        fmt::format("{}\n    {{\"name\": {}, \"time\": {}}}", number == 0 ? "" : ",",
                    json_string(snapshot_file_name(static_cast<std::int64_t>(number))), json_number(times[number]));
  }
  return fmt::format("{{\n  \"file-series-version\": \"1.0\",\n  \"files\": [{}\n  ]\n}}\n", files);
}

/// Of the unbroken row of snapshots with ascending times.
std::vector<double> times_in(const std::filesystem::path& directory) {
  std::vector<double> times;
  while (true) {
    const auto path = directory / snapshot_file_name(static_cast<std::int64_t>(times.size()));
    if (!std::filesystem::exists(path)) return times;
    const double time = Hdf5File::open_to_read(path.string()).read_real_attribute("/", "time");
    if (!times.empty() && time <= times.back()) return times;
    times.push_back(time);
  }
}

}  // namespace

std::string snapshot_file_name(std::int64_t number) {
  return fmt::format("snapshot_{:06}.vtkhdf", number);
}

SnapshotSeries::SnapshotSeries(const Communicator& communicator, std::filesystem::path directory, double resume_time)
    : communicator_(communicator), directory_(std::move(directory)) {
  collectively<SnapshotError>(communicator_, [&] {
    if (communicator_.rank() == 0) times_ = times_in(directory_);
  });
  communicator_.broadcast(times_, 0);
  times_.erase(std::lower_bound(times_.begin(), times_.end(), resume_time), times_.end());
}

std::filesystem::path SnapshotSeries::last() const {
  return times_.empty() ? std::filesystem::path() : directory_ / snapshot_file_name(count() - 1);
}

std::filesystem::path SnapshotSeries::write(const SnapshotHeader& header, const SnapshotRows& rows,
                                            std::span<const SnapshotColumn> columns) {
  const auto later = std::lower_bound(times_.begin(), times_.end(), header.time);
  auto path = directory_ / snapshot_file_name(later - times_.begin());
  write_snapshot(communicator_, path, header, rows, columns);
  times_.erase(later, times_.end());
  times_.push_back(header.time);
  collectively<SnapshotError>(communicator_, [&] {
    if (communicator_.rank() == 0) write_file_atomically(directory_ / "snapshots.vtkhdf.series", index_text(times_));
  });
  return path;
}

}  // namespace sphdrop
