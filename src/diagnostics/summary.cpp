#include "diagnostics/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>

#include "diagnostics/theory.hpp"

namespace sphdrop {

namespace {

constexpr double to_milli = 1e3;
constexpr double to_micro = 1e6;

/// part of whole in per cent; 0 where there is no whole.
double percent(double part, double whole) {
  return whole == 0.0 ? 0.0 : 100.0 * part / whole;
}

class Text {
 public:
  void heading(std::string_view title) { fmt::format_to(std::back_inserter(text_), "{}\n", title); }

  void entry(std::string_view label, std::string_view value) {
    fmt::format_to(std::back_inserter(text_), "  {:<26}{}\n", label, value);
  }

  template <class... Values>
  void row(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    text_ += '\n';
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

std::string milliseconds(double seconds) {
  return fmt::format("{:.4f} ms", to_milli * seconds);
}

/// "0.2863 mm" with the theory's value and the ratio behind it where there is one.
std::string against_theory(double value, std::optional<double> theory, std::string_view unit,
                           std::string_view equations) {
  std::string text = fmt::format("{:.4f} {}", to_milli * value, unit);
  if (theory)
    fmt::format_to(std::back_inserter(text), " ({}: {:.4f} {}, ratio {:.3f})", equations, to_milli * *theory, unit,
                   value / *theory);
  return text;
}

void write_contact(Text& text, const RunSummary::Contact& contact) {
  text.heading("contact");
  if (!contact.first || !contact.last) {
    text.entry("contact time", "none: the drop never touched");
    return;
  }
  text.entry("first contact", milliseconds(*contact.first));
  text.entry("last contact", milliseconds(*contact.last));
  text.entry("contact time", milliseconds(*contact.last - *contact.first));
  text.entry(fmt::format("gaps over {:g} us", to_micro * contact.gap_limit), fmt::format("{}", contact.gaps.size()));
  constexpr std::size_t most_gaps = 10;
  for (std::size_t i = 0; i < std::min(contact.gaps.size(), most_gaps); ++i)
    text.entry("",
               fmt::format("{:.4f} to {:.4f} ms", to_milli * contact.gaps[i].start, to_milli * contact.gaps[i].end));
  if (contact.gaps.size() > most_gaps) text.entry("", fmt::format("and {} more", contact.gaps.size() - most_gaps));
  if (contact.impulse_time)
    text.entry("99 % of the impulse by", fmt::format("{}, {} after first contact", milliseconds(*contact.impulse_time),
                                                     milliseconds(*contact.impulse_time - *contact.first)));
}

void write_drop(Text& text, const RunSummary::Drop& drop) {
  text.heading(drop.rigid_motion ? "rigid drop" : "drop");
  if (!drop.rigid_motion)
    text.entry("largest width",
               fmt::format("{:.4f} mm = {:.3f} D0 at {}", to_milli * drop.largest_width.value,
                           drop.largest_width.value / drop.initial_diameter, milliseconds(drop.largest_width.time)));
  if (drop.largest_mach_number)
    text.entry("largest Mach number", fmt::format("{:.4f} at {}", drop.largest_mach_number->value,
                                                  milliseconds(drop.largest_mach_number->time)));
  if (drop.restitution) text.entry("restitution", fmt::format("{:.3f}", *drop.restitution));
  if (!drop.rigid_motion) return;
  const RunSummary::RigidMotion& motion = *drop.rigid_motion;
  text.entry("velocity at the end", fmt::format("({:.4f}, {:.4f}) m/s", motion.velocity.x, motion.velocity.y));
  text.entry("spin",
             fmt::format("{:.3f} rad/s at the start, {:.3f} at the end", motion.initial_spin, motion.final_spin));
  text.entry("turned by", fmt::format("{:.4f} degrees", motion.angle * 180.0 / std::numbers::pi));
}

void write_beam(Text& text, const RunSummary::Beam& beam) {
  text.heading("beam");
  text.entry("largest deflection",
             against_theory(beam.largest_deflection.value, beam.theory_deflection, "mm", "Eq 46"));
  text.entry("reached at", milliseconds(beam.largest_deflection.time));
  text.entry("deflection / length",
             fmt::format("{:.4f} (Eq 47)", relative_deflection(beam.largest_deflection.value, beam.length)));
  if (beam.measured_period)
    text.entry("period", against_theory(*beam.measured_period, beam.theory_period, "ms", "Eqs 43-44"));
  else if (beam.theory_period)
    text.entry("period", fmt::format("not measured (Eqs 43-44: {})", milliseconds(*beam.theory_period)));
}

void write_momentum(Text& text, const MomentumLedger& ledger) {
  const Vector change = ledger.final_momentum - ledger.initial_momentum;
  const Vector rest = unaccounted_momentum(ledger);
  const auto row = [&](std::string_view name, Vector value) {
    text.row("  {:<24}{:>14.6f}{:>14.6f}", name, to_milli * value.x, to_milli * value.y);
  };
  text.row("{:<26}{:>14}{:>14}", "momentum ledger, mN s/m", "x", "y");
  row("impulse on the solid", ledger.impulse_on_solid);
  row("change of the drop", change);
  row("gravity on the drop", ledger.gravity_impulse);
  const double scale = length(ledger.initial_momentum);
  text.row("  {:<24}{:>14.3e}{:>14.3e}   {:.2e} % of the drop's at the start", "unaccounted", to_milli * rest.x,
           to_milli * rest.y, percent(length(rest), scale));
}

void write_energy(Text& text, const std::vector<EnergyTerm>& terms, double initial_kinetic_energy) {
  text.row("{:<24}{:>14}{:>14}{:>14}{:>24}", "energy ledger, uJ/m", "start", "end", "change", "% of initial kinetic");
  const auto row = [&](std::string_view name, double initial, double final) {
    text.row("  {:<22}{:>14.4f}{:>14.4f}{:>14.4f}{:>24.3f}", name, to_micro * initial, to_micro * final,
             to_micro * (final - initial), percent(final - initial, initial_kinetic_energy));
  };
  double initial = 0, final = 0;
  for (const EnergyTerm& term : terms) {
    row(term.name, term.initial, term.final);
    initial += term.initial;
    final += term.final;
  }
  row("sum", initial, final);
  const double rest = unaccounted_energy(terms);
  text.row("  {:<22}{:>42.4f}{:>24.3f}", "unaccounted", to_micro * rest, percent(rest, initial_kinetic_energy));
}

void write_time(Text& text, const RunSummary& summary) {
  text.row("{:<22}{:>12}{:>8}", "wall time", "s", "%");
  double named = 0;
  const auto row = [&](std::string_view name, double seconds) {
    text.row("  {:<20}{:>12.3f}{:>8.1f}", name, seconds, percent(seconds, summary.wall_time));
  };
  for (const PhaseTime& phase : summary.phases) {
    row(phase.name, phase.seconds);
    named += phase.seconds;
  }
  if (!summary.phases.empty()) row("other", summary.wall_time - named);
  row("total", summary.wall_time);
  const std::int64_t steps = summary.steps - summary.first_step;
  const double updates = static_cast<double>(summary.particles) * static_cast<double>(steps);
  if (updates > 0.0)
    text.entry("per particle and step",
               fmt::format("{:.1f} ns ({} particles, {} steps, {} rank{})", 1e9 * summary.wall_time / updates,
                           summary.particles, steps, summary.ranks, summary.ranks == 1 ? "" : "s"));
  if (!summary.instructions.empty()) text.entry("compiled for", summary.instructions);
  text.entry("load, largest / mean", fmt::format("{:.3f}", summary.load_imbalance));
  if (summary.ranks > 1)
    text.entry("work, largest / mean", fmt::format("{:.3f} by the last of {} partition{}", summary.partition_imbalance,
                                                   summary.repartitions, summary.repartitions == 1 ? "" : "s"));
  if (summary.peak_memory > 0.0)
    text.entry("memory, most of a rank", fmt::format("{:.1f} MB", 1e-6 * summary.peak_memory));
}

void write_traffic(Text& text, const std::vector<RankTraffic>& traffic) {
  text.row("{:<22}{:>8}{:>10}{:>10}{:>12}{:>10}{:>13}{:>10}", "traffic of a rank", "times", "messages", "kB",
           "most mess.", "most kB", "collectives", "kB");
  for (const RankTraffic& t : traffic)
    text.row("  {:<20}{:>8}{:>10.2f}{:>10.3f}{:>12.2f}{:>10.3f}{:>13.2f}{:>10.3f}", "a " + t.occasion, t.times,
             t.messages, 1e-3 * t.bytes, t.most_messages, 1e-3 * t.most_bytes, t.collectives,
             1e-3 * t.collective_bytes);
}

}  // namespace

RunSummary::Contact contact_summary(const ContactRecord& record) {
  return {record.first_contact(), record.last_contact(), record.gap_limit(), record.gaps(), record.impulse_time(0.99)};
}

double unaccounted_energy(const std::vector<EnergyTerm>& terms) {
  double rest = 0;
  for (const EnergyTerm& term : terms) rest += term.final - term.initial;
  return rest;
}

Vector unaccounted_momentum(const MomentumLedger& ledger) {
  return ledger.final_momentum - ledger.initial_momentum - ledger.gravity_impulse + ledger.impulse_on_solid;
}

std::string summary_text(const RunSummary& summary) {
  Text text;
  text.heading("run");
  text.entry("simulated time", fmt::format("{} in {} steps", milliseconds(summary.simulated_time), summary.steps));
  if (summary.contact) write_contact(text, *summary.contact);
  if (summary.drop) write_drop(text, *summary.drop);
  if (summary.beam) write_beam(text, *summary.beam);
  if (summary.momentum) write_momentum(text, *summary.momentum);
  if (!summary.energy.empty()) write_energy(text, summary.energy, summary.initial_kinetic_energy);
  write_time(text, summary);
  if (summary.ranks > 1 && !summary.traffic.empty()) write_traffic(text, summary.traffic);
  text.row("state hash {:016x}", summary.state_hash);
  return text.take();
}

}  // namespace sphdrop
