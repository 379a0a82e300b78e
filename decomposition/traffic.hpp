#pragma once
// What a rank hands to MPI and gets from it, counted.

#include <array>
#include <cstddef>
#include <cstdint>

namespace sphdrop {

/// Calls of one kind on one rank, and the bytes of each that the rank hands in or is handed, whichever are more.
struct TrafficCount {
  std::int64_t calls = 0, bytes = 0;
  friend bool operator==(const TrafficCount&, const TrafficCount&) = default;
};

/// Messages between two ranks count once at either end. Of a gather its root is handed everyone's items, of one to all
/// every rank is; how many items each rank has is agreed on by a gather of its own, as are those of a broadcast by a
/// broadcast. Moves within a rank are no traffic.
enum class TrafficKind : std::size_t {
  message_sent,
  message_received,
  reduction,          ///< waited for at once
  pending_reduction,  ///< under way while the rank computes
  gather,             ///< to one rank or to all
  broadcast,
  all_to_all,
  barrier,
};

/// All that one rank has exchanged, by kind.
class Traffic {
 public:
  static constexpr std::size_t kinds = 8;

  TrafficCount of(TrafficKind kind) const { return counts_[static_cast<std::size_t>(kind)]; }
  void add(TrafficKind kind, std::size_t bytes) {
    TrafficCount& count = counts_[static_cast<std::size_t>(kind)];
    ++count.calls;
    count.bytes += static_cast<std::int64_t>(bytes);
  }

  /// Calls that all ranks make together, and their bytes.
  TrafficCount collective() const {
    TrafficCount sum;
    for (std::size_t k = static_cast<std::size_t>(TrafficKind::reduction); k < kinds; ++k) {
      sum.calls += counts_[k].calls;
      sum.bytes += counts_[k].bytes;
    }
    return sum;
  }

  Traffic& operator+=(const Traffic& other) { return combine(other, 1); }
  Traffic& operator-=(const Traffic& other) { return combine(other, -1); }
  friend Traffic operator-(Traffic a, const Traffic& b) { return a -= b; }
  friend bool operator==(const Traffic&, const Traffic&) = default;

 private:
  Traffic& combine(const Traffic& other, std::int64_t sign) {
    for (std::size_t k = 0; k < kinds; ++k) {
      counts_[k].calls += sign * other.counts_[k].calls;
      counts_[k].bytes += sign * other.counts_[k].bytes;
    }
    return *this;
  }

  std::array<TrafficCount, kinds> counts_{};
};

}  // namespace sphdrop
