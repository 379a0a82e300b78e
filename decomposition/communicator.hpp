#pragma once
// MPI behind RAII, with the reductions and gathers the program uses.

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "decomposition/traffic.hpp"

namespace sphdrop {

/// MPI_Init on construction, MPI_Finalize on destruction; one per program. MPI's helper threads are started with the
/// signals of SignalBlock blocked, so that those always reach the main thread.
class MpiEnvironment {
 public:
  MpiEnvironment(int& argc, char**& argv);
  ~MpiEnvironment();
  MpiEnvironment(const MpiEnvironment&) = delete;
  MpiEnvironment& operator=(const MpiEnvironment&) = delete;
};

/// A duplicate of an MPI communicator. Reductions here are exact (max, min, integer sums): their result does not depend
/// on the number of ranks or the order of arrival, so they may steer a run. Every member that communicates is
/// collective. What max and min make of a NaN is undefined: callers report it by a flag of its own. It counts what goes
/// through it, also by what is built on it; a call of MPI on handle() goes uncounted unless it is noted.
class Communicator {
 public:
  explicit Communicator(MPI_Comm parent);
  ~Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  MPI_Comm handle() const { return handle_; }

  /// What this rank has exchanged so far.
  const Traffic& traffic() const { return traffic_; }
  /// To be called with every call of MPI on handle().
  void note(TrafficKind kind, std::size_t bytes) const { traffic_.add(kind, bytes); }

  void barrier() const;
  double max(double value) const;
  double min(double value) const;
  std::int64_t max(std::int64_t value) const;
  std::int64_t min(std::int64_t value) const;
  std::int64_t sum(std::int64_t value) const;
  /// Modulo 2^64.
  std::uint64_t sum(std::uint64_t value) const;
  /// Element-wise over the ranks.
  void max_in_place(std::span<double> values) const;
  void sum_in_place(std::span<std::int64_t> values) const;

  /// Everyone's items on every rank, in rank order. Throws std::length_error on all ranks beyond 2^31 items.
  template <class T>
  std::vector<T> all_gather(std::span<const T> mine) const;
  /// Everyone's items on `root`, in rank order; empty elsewhere. Throws as all_gather does.
  template <class T>
  std::vector<T> gather(std::span<const T> mine, int root) const;
  /// `root`'s items on every rank. Throws as all_gather does.
  template <class T>
  void broadcast(std::vector<T>& items, int root) const;
  void broadcast(std::string& text, int root) const;

 private:
  /// How many items each rank contributes to a gather, and where they go.
  struct GatherLayout {
    std::vector<int> counts;
    std::vector<int> starts;
    std::size_t total = 0;
  };
  GatherLayout gather_layout(std::size_t mine) const;
  void all_gather_items(const void* mine, const GatherLayout& layout, void* all, std::size_t item_bytes) const;
  void gather_items(const void* mine, const GatherLayout& layout, void* all, std::size_t item_bytes, int root) const;
  std::size_t broadcast_count(std::size_t count, int root) const;
  void broadcast_items(void* items, std::size_t count, std::size_t item_bytes, int root) const;

  MPI_Comm handle_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
  mutable Traffic traffic_;  // counting leaves the communicator as it is
};

/// An element-wise maximum over all ranks that is under way while the caller computes. One at a time (asserted). The
/// communicator must outlive it.
class PendingMaximum {
 public:
  explicit PendingMaximum(const Communicator& communicator);
  ~PendingMaximum();
  PendingMaximum(const PendingMaximum&) = delete;
  PendingMaximum& operator=(const PendingMaximum&) = delete;

  /// Collective. Posts the reduction of `values`, as many as on every other rank.
  void start(std::span<const double> values);
  /// Waits for it; the maxima, valid until the next start().
  std::span<const double> finish();

 private:
  const Communicator* communicator_;
  MPI_Request request_ = MPI_REQUEST_NULL;
  bool under_way_ = false;
  std::vector<double> values_, maxima_;
};

/// An element-wise sum of integers over all ranks that is under way while the caller computes. One at a time
/// (asserted). The communicator must outlive it.
class PendingSum {
 public:
  explicit PendingSum(const Communicator& communicator);
  ~PendingSum();
  PendingSum(const PendingSum&) = delete;
  PendingSum& operator=(const PendingSum&) = delete;

  bool is_under_way() const { return under_way_; }
  /// Collective. Posts the reduction of `values`, as many as on every other rank.
  void start(std::span<const std::int64_t> values);
  /// Waits for it; the sums, valid until the next start().
  std::span<const std::int64_t> finish();

 private:
  const Communicator* communicator_;
  MPI_Request request_ = MPI_REQUEST_NULL;
  bool under_way_ = false;
  std::vector<std::int64_t> values_, sums_;
};

template <class T>
std::vector<T> Communicator::all_gather(std::span<const T> mine) const {
  static_assert(std::is_trivially_copyable_v<T>);
  const GatherLayout layout = gather_layout(mine.size());
  std::vector<T> all(layout.total);
  all_gather_items(mine.data(), layout, all.data(), sizeof(T));
  return all;
}

template <class T>
std::vector<T> Communicator::gather(std::span<const T> mine, int root) const {
  static_assert(std::is_trivially_copyable_v<T>);
  const GatherLayout layout = gather_layout(mine.size());
  std::vector<T> all(rank_ == root ? layout.total : 0);
  gather_items(mine.data(), layout, all.data(), sizeof(T), root);
  return all;
}

template <class T>
void Communicator::broadcast(std::vector<T>& items, int root) const {
  static_assert(std::is_trivially_copyable_v<T>);
  items.resize(broadcast_count(items.size(), root));
  broadcast_items(items.data(), items.size(), sizeof(T), root);
}

}  // namespace sphdrop
