#pragma once
// An energy to which every rank adds its part.

#include <cstdint>
#include <span>
#include <utility>

#include "decomposition/communicator.hpp"
#include "decomposition/quantised_sum.hpp"

namespace sphdrop {

/// Counted in quanta, so that the sum over the ranks is the same whoever has added what. It is made only where it is
/// asked for: no step waits for it.
class SharedEnergy {
 public:
  /// `quantum`, J/m: small against what a step adds. Nothing may be added if it is zero.
  SharedEnergy(const Communicator& communicator, double quantum)
      : communicator_(communicator), booked_(quantum > 0 ? quantum : 1.0), to_come_(booked_) {}

  /// Of the step under way, J/m: it counts from the next book() on.
  void add(double energy) { to_come_.add(energy); }
  void add(std::span<const double> energies) { to_come_.add(energies); }
  void book() { booked_.add(std::exchange(to_come_, QuantisedSum(booked_.quantum()))); }

  /// This rank's part of what has been booked, J/m.
  double part() const { return booked_.value(); }
  /// Collective: of all ranks.
  double total() const { return static_cast<double>(communicator_.sum(booked_.quanta())) * booked_.quantum(); }
  /// Takes a total() back, which one rank then has.
  void restore(double total) {
    restart();
    if (communicator_.rank() == 0) booked_.add(total);
  }
  /// Counts anew; what is to be booked stays.
  void restart() { booked_ = QuantisedSum(booked_.quantum()); }

 private:
  const Communicator& communicator_;
  QuantisedSum booked_, to_come_;
};

/// For what a surface gains and loses, J/m. In units of tension times spacing, a step gives a particle some 2^-17, many
/// quanta, and up to 2^17 add up without rounding: more than the energy of the surface of 10^8 particles.
inline double surface_energy_quantum(double tension, double spacing) {
  return 0x1p-34 * tension * spacing;
}

}  // namespace sphdrop
