#include "simulation/rank_traffic.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace sphdrop {

namespace {

RankTraffic mean_traffic(const Communicator& communicator, const char* occasion, std::int64_t times,
                         const Traffic& mine) {
  const TrafficCount sent = mine.of(TrafficKind::message_sent), received = mine.of(TrafficKind::message_received);
  const TrafficCount collective = mine.collective();
  const std::int64_t messages = sent.calls + received.calls, bytes = sent.bytes + received.bytes;
  std::array<std::int64_t, 2> sums{messages, bytes};
  communicator.sum_in_place(sums);
  const auto number = static_cast<double>(times), ranks = static_cast<double>(communicator.size());
  return {occasion,
          times,
          static_cast<double>(sums[0]) / ranks / number,
          static_cast<double>(sums[1]) / ranks / number,
          static_cast<double>(communicator.max(messages)) / number,
          static_cast<double>(communicator.max(bytes)) / number,
          static_cast<double>(communicator.max(collective.calls)) / number,
          static_cast<double>(communicator.max(collective.bytes)) / number};
}

}  // namespace

std::vector<RankTraffic> traffic_of_ranks(const Simulation& simulation, std::int64_t steps) {
  const PhaseTimer& timer = simulation.timer();
  // Taken before the reductions below, which are traffic too.
  const Traffic of_steps = timer.traffic_of_steps(), of_detections = timer.traffic(Phase::detection),
                of_redistributions = timer.traffic(Phase::redistribution);
  std::vector<RankTraffic> traffic;
  const auto add = [&](const char* occasion, std::int64_t times, const Traffic& mine) {
    if (times > 0) traffic.push_back(mean_traffic(simulation.communicator(), occasion, times, mine));
  };
  add("step", steps, of_steps);
  add("detection", simulation.detections(), of_detections);
  add("redistribution", simulation.redistributions(), of_redistributions);
  return traffic;
}

}  // namespace sphdrop
