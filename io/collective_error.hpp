#pragma once
// Errors that one rank meets and all ranks must hear of.

#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>

#include "decomposition/communicator.hpp"

namespace sphdrop {

/// What the program returns if results cannot be written, also where all that is left is to end it by MPI_Abort.
inline constexpr int unwritable_output_exit_code = 4;

/// An error that has been thrown on all ranks, with one text: all of them stand at the same place when it is caught.
class CollectiveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Collective. Throws Error with the same text on every rank if `my_error` is not empty on any: the text of the lowest
/// such rank. Without this a rank that fails alone leaves the others waiting in the next collective call.
template <class Error>
void throw_if_any_failed(const Communicator& communicator, const std::string& my_error) {
  const std::int64_t none = communicator.size();
  const std::int64_t first = communicator.min(my_error.empty() ? none : std::int64_t{communicator.rank()});
  if (first == none) return;
  std::string text = my_error;
  communicator.broadcast(text, static_cast<int>(first));
  if (communicator.size() > 1) text = fmt::format("{} (rank {} of {})", text, first, communicator.size());
  throw Error(text);
}

/// Collective. Runs `action` on every rank; if it throws on any, throws Error with one text on all. `action` may make
/// at most one collective call, as its last: a rank that throws before it would keep the others waiting.
template <class Error, class Action>
void collectively(const Communicator& communicator, Action&& action) {
  std::string error;
  try {
    action();
  } catch (const std::exception& failure) {
    error = failure.what();
    if (error.empty()) error = "an error without a message";
  }
  throw_if_any_failed<Error>(communicator, error);
}

}  // namespace sphdrop
