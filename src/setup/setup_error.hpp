#pragma once

#include <stdexcept>

namespace sphdrop {

/// A case that cannot be set up; what() says what is wrong and what to do about it.
struct SetupError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace sphdrop
