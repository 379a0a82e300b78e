#include "decomposition/communicator.hpp"

#include <algorithm>
#include <cassert>
#include <exception>
#include <limits>
#include <list>
#include <stdexcept>
#include <utility>

#include "decomposition/signal_block.hpp"

namespace sphdrop {
namespace {

constexpr double longest_wait_for_others = 2;  // s

bool mpi_is_finalized() {
  int finalized = 0;
  MPI_Finalized(&finalized);
  return finalized != 0;
}

/// Counting in items instead of bytes keeps MPI's int counts from overflowing at 2 GiB.
class ItemType {
 public:
  explicit ItemType(std::size_t bytes) {
    MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~ItemType() { MPI_Type_free(&type_); }
  ItemType(const ItemType&) = delete;
  ItemType& operator=(const ItemType&) = delete;
  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

/// Every rank calls this with the same total, so all throw or none.
void check_item_count(std::uint64_t total) {
  if (total > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
    throw std::length_error("a collective message of " + std::to_string(total) +
                            " items is too long: MPI counts up to 2147483647; gather in several parts");
}

template <class T>
T all_reduce(T value, MPI_Datatype type, MPI_Op operation, const Communicator& communicator) {
  communicator.note(TrafficKind::reduction, sizeof(T));
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, type, operation, communicator.handle());
  return value;
}

}  // namespace

MpiEnvironment::MpiEnvironment(int& argc, char**& argv) {
  // A helper thread that took SIGTERM while METIS has its own handler installed would jump to another thread's stack.
  const SignalBlock block;
  MPI_Init(&argc, &argv);
}

MpiEnvironment::~MpiEnvironment() {
  MPI_Finalize();
}

Communicator::Communicator(MPI_Comm parent) {
  MPI_Comm_dup(parent, &handle_);
  MPI_Comm_rank(handle_, &rank_);
  MPI_Comm_size(handle_, &size_);
}

Communicator::~Communicator() {
  if (!mpi_is_finalized()) MPI_Comm_free(&handle_);
}

void Communicator::barrier() const {
  note(TrafficKind::barrier, 0);
  MPI_Barrier(handle_);
}

double Communicator::max(double value) const {
  return all_reduce(value, MPI_DOUBLE, MPI_MAX, *this);
}
double Communicator::min(double value) const {
  return all_reduce(value, MPI_DOUBLE, MPI_MIN, *this);
}
std::int64_t Communicator::max(std::int64_t value) const {
  return all_reduce(value, MPI_INT64_T, MPI_MAX, *this);
}
std::int64_t Communicator::min(std::int64_t value) const {
  return all_reduce(value, MPI_INT64_T, MPI_MIN, *this);
}
std::int64_t Communicator::sum(std::int64_t value) const {
  return all_reduce(value, MPI_INT64_T, MPI_SUM, *this);
}
std::uint64_t Communicator::sum(std::uint64_t value) const {
  return all_reduce(value, MPI_UINT64_T, MPI_SUM, *this);
}

void Communicator::max_in_place(std::span<double> values) const {
  note(TrafficKind::reduction, values.size_bytes());
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX, handle_);
}

void Communicator::sum_in_place(std::span<std::int64_t> values) const {
  note(TrafficKind::reduction, values.size_bytes());
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_INT64_T, MPI_SUM, handle_);
}

Communicator::GatherLayout Communicator::gather_layout(std::size_t mine) const {
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(size_));
  const std::uint64_t count = mine;
  note(TrafficKind::gather, counts.size() * sizeof(std::uint64_t));
  MPI_Allgather(&count, 1, MPI_UINT64_T, counts.data(), 1, MPI_UINT64_T, handle_);
  std::uint64_t total = 0;
  for (const std::uint64_t c : counts) total += c;
  check_item_count(total);
  GatherLayout layout;
  for (const std::uint64_t c : counts) {
    layout.counts.push_back(static_cast<int>(c));
    layout.starts.push_back(static_cast<int>(layout.total));
    layout.total += c;
  }
  return layout;
}

void Communicator::all_gather_items(const void* mine, const GatherLayout& layout, void* all,
                                    std::size_t item_bytes) const {
  note(TrafficKind::gather, layout.total * item_bytes);
  const ItemType type(item_bytes);
  MPI_Allgatherv(mine, layout.counts[static_cast<std::size_t>(rank_)], type.get(), all, layout.counts.data(),
                 layout.starts.data(), type.get(), handle_);
}

void Communicator::gather_items(const void* mine, const GatherLayout& layout, void* all, std::size_t item_bytes,
                                int root) const {
  const auto own = static_cast<std::size_t>(layout.counts[static_cast<std::size_t>(rank_)]);
  note(TrafficKind::gather, (rank_ == root ? layout.total : own) * item_bytes);
  const ItemType type(item_bytes);
  MPI_Gatherv(mine, layout.counts[static_cast<std::size_t>(rank_)], type.get(), all, layout.counts.data(),
              layout.starts.data(), type.get(), root, handle_);
}

std::size_t Communicator::broadcast_count(std::size_t count, int root) const {
  std::uint64_t agreed = count;
  note(TrafficKind::broadcast, sizeof(agreed));
  MPI_Bcast(&agreed, 1, MPI_UINT64_T, root, handle_);
  check_item_count(agreed);
  return agreed;
}

void Communicator::broadcast_items(void* items, std::size_t count, std::size_t item_bytes, int root) const {
  note(TrafficKind::broadcast, count * item_bytes);
  const ItemType type(item_bytes);
  MPI_Bcast(items, static_cast<int>(count), type.get(), root, handle_);
}

void Communicator::broadcast(std::string& text, int root) const {
  text.resize(broadcast_count(text.size(), root));
  broadcast_items(text.data(), text.size(), 1, root);
}

PendingMaximum::PendingMaximum(const Communicator& communicator) : communicator_(&communicator) {}

PendingMaximum::~PendingMaximum() {
  if (!under_way_ || mpi_is_finalized()) return;
  if (std::uncaught_exceptions() == 0) {
    MPI_Wait(&request_, MPI_STATUS_IGNORE);
    return;
  }
  // Of an error that all ranks have together they all come here, and what is under way ends; left alone it would crash
  // MPI_Finalize. If the error is this rank's own, the others may never come, and waiting would hide it.
  int done = 0;
  for (const double limit = MPI_Wtime() + longest_wait_for_others; done == 0 && MPI_Wtime() < limit;)
    MPI_Test(&request_, &done, MPI_STATUS_IGNORE);
  if (done != 0) return;
  // MPI may still write.
  static std::list<std::vector<double>> abandoned;
  abandoned.push_back(std::move(values_));
  abandoned.push_back(std::move(maxima_));
}

void PendingMaximum::start(std::span<const double> values) {
  assert(!under_way_);
  values_.assign(values.begin(), values.end());
  maxima_.resize(values.size());
  communicator_->note(TrafficKind::pending_reduction, values.size_bytes());
  MPI_Iallreduce(values_.data(), maxima_.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX,
                 communicator_->handle(), &request_);
  under_way_ = true;
}

std::span<const double> PendingMaximum::finish() {
  assert(under_way_);
  MPI_Wait(&request_, MPI_STATUS_IGNORE);
  under_way_ = false;
  return maxima_;
}

PendingSum::PendingSum(const Communicator& communicator) : communicator_(&communicator) {}

PendingSum::~PendingSum() {
  if (!under_way_ || mpi_is_finalized()) return;
  if (std::uncaught_exceptions() == 0) {
    MPI_Wait(&request_, MPI_STATUS_IGNORE);
    return;
  }
  // As in PendingMaximum.
  static std::list<std::vector<std::int64_t>> abandoned;
  abandoned.push_back(std::move(values_));
  abandoned.push_back(std::move(sums_));
}

void PendingSum::start(std::span<const std::int64_t> values) {
  assert(!under_way_);
  values_.assign(values.begin(), values.end());
  sums_.resize(values.size());
  communicator_->note(TrafficKind::pending_reduction, values.size_bytes());
  MPI_Iallreduce(values_.data(), sums_.data(), static_cast<int>(values.size()), MPI_INT64_T, MPI_SUM,
                 communicator_->handle(), &request_);
  under_way_ = true;
}

std::span<const std::int64_t> PendingSum::finish() {
  assert(under_way_);
  MPI_Wait(&request_, MPI_STATUS_IGNORE);
  under_way_ = false;
  return sums_;
}

}  // namespace sphdrop
