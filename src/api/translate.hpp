#pragma once
// From the exceptions inside to the one outside.

#include <exception>

#include "api/sphdrop.hpp"
#include "run/failure.hpp"

namespace sphdrop {

/// What f() returns; what it throws on all ranks together becomes an Error.
template <class F>
decltype(auto) translated(F&& f) {
  try {
    return f();
  } catch (const std::exception& error) {
    if (const std::optional<ExitCode> code = collective_failure(error))
      throw v1::Error(static_cast<v1::Error::Kind>(static_cast<int>(*code)), error.what());
    throw;
  }
}

}  // namespace sphdrop
