#include "simulation/saved_simulation.hpp"

#include "diagnostics/number_reader.hpp"

namespace sphdrop {

CheckpointNumbers clock_numbers(const Clock& clock) {
  return {"clock",
          "-",
          "time (s), steps so far, length of the last step (s)",
          {clock.time, static_cast<double>(clock.step), clock.previous_step}};
}

Clock clock_of(std::span<const double> numbers) {
  NumberReader reader(numbers, "clock");
  Clock clock;
  clock.time = reader.number();
  clock.step = static_cast<std::int64_t>(reader.number());
  clock.previous_step = reader.number();
  reader.expect_end();
  return clock;
}

}  // namespace sphdrop
