#pragma once
// Signals that ask the program to stop in good order.

#include <string_view>

namespace sphdrop {

/// Catches SIGTERM, SIGINT, SIGUSR1 and SIGUSR2 from now on: the last one that came is remembered, nothing else
/// happens. Call before MPI_Init, which takes a while and leaves these alone, lest one that comes early ends the
/// program.
void catch_stop_signals();

/// The signal that came last; 0 if none did.
int caught_stop_signal();

/// "SIGTERM"; "a signal" for others than those caught here.
std::string_view signal_name(int signal);

}  // namespace sphdrop
