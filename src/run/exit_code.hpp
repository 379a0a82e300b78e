#pragma once
// What the program tells whoever started it.

#include "io/collective_error.hpp"

namespace sphdrop {

enum ExitCode : int {
  success = 0,
  internal_error = 1,
  user_error = 2,
  unsafe_state = 3,
  output_error = unwritable_output_exit_code,
  interrupted = 5  // stopped in good order: go on with --restart latest
};

}  // namespace sphdrop
