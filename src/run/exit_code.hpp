#pragma once
// What the program tells whoever started it.

namespace sphdrop {

enum ExitCode : int {
  success = 0,
  internal_error = 1,
  user_error = 2,
  unsafe_state = 3,
  output_error = 4,
  interrupted = 5  // stopped in good order: go on with --restart latest
};

}  // namespace sphdrop
