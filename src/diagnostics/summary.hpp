#pragma once
// The text a run ends with.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "diagnostics/contact_record.hpp"
#include "diagnostics/extremes.hpp"
#include "particles/vector.hpp"

namespace sphdrop {

/// The drop's momentum balance, N s/m: change of momentum = gravity's impulse - impulse on the solid.
struct MomentumLedger {
  Vector initial_momentum, final_momentum;  ///< of the drop
  Vector impulse_on_solid;                  ///< by contact
  Vector gravity_impulse;                   ///< on the drop
};

/// One kind of energy at the start and the end of the run, J/m. What is dissipated counts up from 0.
struct EnergyTerm {
  std::string name;
  double initial = 0, final = 0;
};

struct PhaseTime {
  std::string name;
  double seconds = 0;
};

/// What ranks exchange whenever something happens, each number of one time.
struct RankTraffic {
  std::string occasion;            ///< "step"
  std::int64_t times = 0;          ///< how often it happened
  double messages = 0, bytes = 0;  ///< sent and received by a rank, mean over the ranks
  double most_messages = 0;        ///< of the rank with the most
  double most_bytes = 0;           ///< likewise
  double collectives = 0;          ///< calls that all ranks make together
  double collective_bytes = 0;     ///< of the rank with the most
};

/// Everything the summary tells, SI units; what a case does not have stays empty and its lines are left out.
struct RunSummary {
  double simulated_time = 0;    ///< s
  std::int64_t steps = 0;       ///< from the beginning, before a restart too
  std::int64_t first_step = 0;  ///< at which this part of the run began; wall_time and phases count from there

  struct Contact {
    std::optional<double> first, last;  ///< s; empty: never touched
    double gap_limit = 0;               ///< s
    std::vector<ContactRecord::Gap> gaps;
    std::optional<double> impulse_time;  ///< by which 99 % of the vertical impulse had been given, s
  };
  std::optional<Contact> contact;

  struct RigidMotion {
    Vector velocity;                          ///< at the end, m/s
    double angle = 0;                         ///< turned by, rad, counterclockwise
    double initial_spin = 0, final_spin = 0;  ///< rad/s, counterclockwise
  };

  struct Drop {
    double initial_diameter = 0;  ///< D0, m
    Peak largest_width;           ///< s, m
    std::optional<double> restitution;
    std::optional<Peak> largest_mach_number;  ///< of the liquid: s, speed of a particle over the speed of sound
    std::optional<RigidMotion> rigid_motion;  ///< of a rigid drop; its width goes unsaid
  };
  std::optional<Drop> drop;

  struct Beam {
    Peak largest_deflection;                  ///< s; depth in m, positive downwards
    double length = 0;                        ///< L, m
    std::optional<double> measured_period;    ///< s
    std::optional<double> theory_period;      ///< tau0, Eqs 43 and 44, s
    std::optional<double> theory_deflection;  ///< Eq 46, m
  };
  std::optional<Beam> beam;

  std::optional<MomentumLedger> momentum;
  std::vector<EnergyTerm> energy;
  double initial_kinetic_energy = 0;  ///< J/m, of drop and solid

  double wall_time = 0;  ///< s
  std::vector<PhaseTime> phases;
  std::int64_t particles = 0;
  int ranks = 1;
  std::string instructions;          ///< what the sweeps are compiled for; empty: unsaid
  double load_imbalance = 1;         ///< the busiest rank's computing time over the mean
  double partition_imbalance = 1;    ///< the largest share of the work over the mean, by the partition's weights
  std::int64_t repartitions = 0;     ///< how often the particles have been dealt out anew
  std::vector<RankTraffic> traffic;  ///< of what happened; shown where there are several ranks
  double peak_memory = 0;            ///< of the rank with the most, bytes; 0: unknown
  std::uint64_t state_hash = 0;
};

/// The contact part of a summary, taken from its record.
RunSummary::Contact contact_summary(const ContactRecord& record);

/// Sum of the final less the sum of the initial energies, J/m: zero if the ledger is complete.
double unaccounted_energy(const std::vector<EnergyTerm>& terms);

/// Final less initial momentum, less gravity's impulse, plus the impulse on the solid: zero if the ledger is complete.
Vector unaccounted_momentum(const MomentumLedger& ledger);

/// Aligned text of several lines that ends with "state hash 0123456789abcdef" and a newline.
std::string summary_text(const RunSummary& summary);

}  // namespace sphdrop
