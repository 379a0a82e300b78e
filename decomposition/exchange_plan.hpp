#pragma once
// Who sends which rows to whom. One plan class carries migration, halo and interface gather; it moves 8-byte words and
// knows nothing of what they mean.

#include <cstdint>
#include <span>
#include <vector>

#include "decomposition/communicator.hpp"

namespace sphdrop {

/// Rows exchanged with one rank.
struct RankRows {
  int rank = 0;
  std::vector<std::int32_t> rows;
};

/// A fixed pattern of point-to-point messages between ranks. Every column moved through it is an array of 8-byte
/// elements (double, int64) addressed by row. Rows sent to the own rank are copied without a message.
///
/// start() packs and posts, finish() waits and unpacks; between the two the caller may compute on anything but the rows
/// to be received. At most one exchange of a plan is under way at a time (asserted). Buffers are kept between
/// exchanges: nothing is allocated as long as the number of columns does not grow. Every rank moves the same number of
/// columns. A plan may be moved at any time and copied while no exchange is under way (asserted). The communicator must
/// outlive the plan.
class ExchangePlan {
 public:
  ExchangePlan() = default;

  /// The rows each rank sends and receives, as already agreed on by all ranks: the k-th row that rank a sends to b is
  /// the k-th row that b receives from a. Ranks without rows are left out. `tag` keeps plans in flight apart.
  ExchangePlan(const Communicator& communicator, std::vector<RankRows> sends, std::vector<RankRows> receives, int tag);

  /// Collective. Builds the plan from the sending side alone: what is received is stored from row `first_received_row`
  /// on, in the order of the sending ranks and within a rank in the order sent.
  static ExchangePlan from_sends(const Communicator& communicator, std::vector<RankRows> sends,
                                 std::int32_t first_received_row, int tag);

  /// The same messages the other way round: what was received is sent back to where it came from.
  ExchangePlan reversed(int tag) const;

  /// Packs the send rows of every source column and posts all messages.
  void start(std::span<const void* const> source_columns);
  /// Waits for all messages and stores what arrived in the receive rows of the target columns, as many as were sent.
  void finish(std::span<void* const> target_columns);

  /// Applies new_row[old_row] to the receive (send) rows: for callers that reorder their arrays after the plan is made.
  void renumber_received_rows(std::span<const std::int32_t> new_row);
  void renumber_sent_rows(std::span<const std::int32_t> new_row);
  /// Stores what is received one behind the other from row 0 on, in the order of the ranks and of their rows.
  void number_received_rows();

  std::span<const RankRows> sends() const;
  std::span<const RankRows> receives() const;
  /// Rows received from all ranks, the own one included.
  std::size_t received_row_count() const;
  /// Messages to other ranks and rows in them, for the performance report.
  std::size_t message_count() const;
  std::size_t sent_row_count() const;

 private:
  /// An exchange under way: the messages and the buffers MPI works on.
  class Transfer {
   public:
    Transfer() = default;
    Transfer(const Transfer& other);  // copies nothing but the promise that nothing is under way
    Transfer(Transfer&& other) noexcept;
    Transfer& operator=(const Transfer& other);
    Transfer& operator=(Transfer&& other) noexcept;
    ~Transfer();

    std::vector<std::uint64_t> send_buffer;  ///< per rank, column after column
    std::vector<std::uint64_t> receive_buffer;
    std::vector<MPI_Request> requests;
    std::size_t columns = 0;
    bool under_way = false;

   private:
    void end();
  };

  void count_rows();

  const Communicator* communicator_ = nullptr;
  int own_rank_ = -1;
  int tag_ = 0;
  std::vector<RankRows> sends_, receives_;  // ascending ranks, none without rows
  std::size_t row_count_to_send_ = 0, row_count_to_receive_ = 0, rows_in_messages_ = 0, message_count_ = 0;
  Transfer transfer_;
};

}  // namespace sphdrop
