#pragma once
// Runs a case for a few steps and brings every particle's state together, to compare runs bit for bit.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "config/case_file.hpp"
#include "setup/initial_state.hpp"
#include "simulation/observation.hpp"
#include "simulation/simulation.hpp"

namespace sphdrop::test {

/// One particle's state columns, in the order of their declaration, as bits.
struct ParticleState {
  std::int64_t id;
  std::vector<std::uint64_t> bits;
  friend bool operator==(const ParticleState&, const ParticleState&) = default;
};

struct WholeState {
  std::vector<ParticleState> particles;  ///< on every rank, by ascending id
  std::uint64_t hash = 0;
  std::vector<Observation> observations;
  std::int64_t redistributions = 0, detections = 0;
};

template <class Set>
void gather_state(const Communicator& communicator, const Set& set, std::vector<ParticleState>& all) {
  std::vector<std::int64_t> ids;
  std::vector<std::uint64_t> words;
  std::size_t columns = 0;
  for (const Field* field : set.fields())
    if (has(field->roles, Role::state) && !field->is_left_out()) columns += static_cast<std::size_t>(field->components);
  set.for_each_owned([&](std::size_t row) {
    ids.push_back(set.id[row]);
    for (const Field* field : set.fields())
      if (has(field->roles, Role::state) && !field->is_left_out())
        for (int c = 0; c < field->components; ++c)
          words.push_back(std::bit_cast<std::uint64_t>(field->columns[static_cast<std::size_t>(c)][row]));
  });
  const auto all_ids = communicator.all_gather(std::span<const std::int64_t>(ids));
  const auto all_words = communicator.all_gather(std::span<const std::uint64_t>(words));
  for (std::size_t k = 0; k < all_ids.size(); ++k)
    all.push_back({all_ids[k],
                   {all_words.begin() + static_cast<std::ptrdiff_t>(k * columns),
                    all_words.begin() + static_cast<std::ptrdiff_t>((k + 1) * columns)}});
}

/// Collective over `communicator`.
inline WholeState run_steps(const Communicator& communicator, const Case& input, int steps) {
  const InitialState initial = build_initial_state(input, {communicator.rank(), communicator.size()});
  Simulation simulation(communicator, input, initial.fluid, initial.solid);
  WholeState state;
  for (int k = 0;; ++k) {
    simulation.evaluate();
    if (k % 50 == 0 || k == steps)
      state.observations.push_back(
          observe(simulation, state.observations.empty() ? 0.0 : state.observations.front().total));
    if (k == steps) break;
    simulation.move();
  }
  state.hash = state_hash(simulation);
  gather_state(communicator, simulation.fluid(), state.particles);
  gather_state(communicator, simulation.solid(), state.particles);
  std::sort(state.particles.begin(), state.particles.end(),
            [](const ParticleState& a, const ParticleState& b) { return a.id < b.id; });
  state.redistributions = simulation.redistributions();
  state.detections = simulation.detections();
  return state;
}

/// Collective likewise.
inline WholeState run_steps(const Communicator& communicator, const std::string& case_text, int steps,
                            const std::vector<std::string>& overrides = {}) {
  return run_steps(communicator, parse_case_text(case_text, "test.cfg", overrides).values, steps);
}

}  // namespace sphdrop::test
