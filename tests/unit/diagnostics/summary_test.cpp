#include "diagnostics/summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

namespace sphdrop {
namespace {

RunSummary full() {
  RunSummary run;
  run.simulated_time = 8e-3;
  run.steps = 1600000;
  run.contact = RunSummary::Contact{0.1e-3, 3.45e-3, 20e-6, {{3.1e-3, 3.15e-3}}, 2.82e-3};
  run.drop = RunSummary::Drop{1e-3, {1.22e-3, 1.846e-3}, 0.55, Peak{0.12e-3, 0.0432}, {}};
  run.beam = RunSummary::Beam{{1.254e-3, 0.2863e-3}, 8e-3, 2.80e-3, 2.76e-3, 0.243e-3};
  run.momentum = MomentumLedger{{0.0, -0.8e-3}, {1e-6, 0.3e-3}, {-1e-6, -1.2e-3}, {0.0, -0.1e-3}};
  run.energy = {{"kinetic, drop", 250e-6, 50e-6}, {"surface", 226e-6, 236e-6}, {"dissipated", 0.0, 185e-6}};
  run.initial_kinetic_energy = 250e-6;
  run.wall_time = 100.0;
  run.phases = {{"fluid sweep", 40.0}, {"solid sweep", 35.0}};
  run.particles = 5000;
  run.ranks = 2;
  run.instructions = "x86-64-v3, vectors of 4 doubles";
  run.load_imbalance = 1.07;
  run.partition_imbalance = 1.034;
  run.repartitions = 3;
  run.state_hash = 0x0123456789abcdefU;
  return run;
}

/// The rest of the one line that starts with the label, blanks stripped.
std::string value_of(const std::string& text, const std::string& label) {
  std::istringstream stream(text);
  std::string found;
  int count = 0;
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("  " + label + " ", 0) != 0) continue;
    ++count;
    found = line.substr(line.find_first_not_of(' ', label.size() + 2));
  }
  EXPECT_EQ(count, 1) << label << " in\n" << text;
  return found;
}

/// Columns of a row of a table, blanks between them made one.
std::string row_of(const std::string& text, const std::string& label) {
  std::istringstream stream(value_of(text, label));
  std::string joined;
  for (std::string word; stream >> word;) joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

TEST(Summary, ContactDropAndBeam) {
  const std::string text = summary_text(full());
  EXPECT_EQ(value_of(text, "simulated time"), "8.0000 ms in 1600000 steps");
  EXPECT_EQ(value_of(text, "first contact"), "0.1000 ms");
  EXPECT_EQ(value_of(text, "last contact"), "3.4500 ms");
  EXPECT_EQ(value_of(text, "contact time"), "3.3500 ms");
  EXPECT_EQ(value_of(text, "gaps over 20 us"), "1");
  EXPECT_NE(text.find(" 3.1000 to 3.1500 ms\n"), std::string::npos);
  EXPECT_EQ(value_of(text, "99 % of the impulse by"), "2.8200 ms, 2.7200 ms after first contact");
  EXPECT_EQ(value_of(text, "largest width"), "1.8460 mm = 1.846 D0 at 1.2200 ms");
  EXPECT_EQ(value_of(text, "largest Mach number"), "0.0432 at 0.1200 ms");
  EXPECT_EQ(value_of(text, "restitution"), "0.550");
  EXPECT_EQ(value_of(text, "largest deflection"), "0.2863 mm (Eq 46: 0.2430 mm, ratio 1.178)");
  EXPECT_EQ(value_of(text, "reached at"), "1.2540 ms");
  EXPECT_EQ(value_of(text, "deflection / length"), "0.0358 (Eq 47)");
  EXPECT_EQ(value_of(text, "period"), "2.8000 ms (Eqs 43-44: 2.7600 ms, ratio 1.014)");
}

TEST(Summary, RigidDrop) {
  RunSummary run = full();
  run.drop->rigid_motion = RunSummary::RigidMotion{{0.01, 0.25}, -0.05, 3.0, -12.5};
  const std::string text = summary_text(run);
  EXPECT_NE(text.find("\nrigid drop\n"), std::string::npos);
  EXPECT_EQ(text.find("largest width"), std::string::npos);
  EXPECT_EQ(value_of(text, "restitution"), "0.550");
  EXPECT_EQ(value_of(text, "velocity at the end"), "(0.0100, 0.2500) m/s");
  EXPECT_EQ(value_of(text, "spin"), "3.000 rad/s at the start, -12.500 at the end");
  EXPECT_EQ(value_of(text, "turned by"), "-2.8648 degrees");
}

TEST(Summary, MomentumLedger) {
  const std::string text = summary_text(full());
  EXPECT_EQ(row_of(text, "impulse on the solid"), "-0.001000 -1.200000");
  EXPECT_EQ(row_of(text, "change of the drop"), "0.001000 1.100000");
  EXPECT_EQ(row_of(text, "gravity on the drop"), "0.000000 -0.100000");
  const Vector rest = unaccounted_momentum(full().momentum.value());
  EXPECT_NEAR(rest.x, 0.0, 1e-18);
  EXPECT_NEAR(rest.y, 0.0, 1e-18);
}

TEST(Summary, MomentumThatIsMissingShows) {
  RunSummary run = full();
  run.momentum->final_momentum.y += 8e-6;
  EXPECT_NEAR(unaccounted_momentum(*run.momentum).y, 8e-6, 1e-18);
  EXPECT_NE(summary_text(run).find("8.000e-03   1.00e+00 % of the drop's at the start"), std::string::npos);
}

TEST(Summary, EnergyLedger) {
  RunSummary run = full();
  EXPECT_NEAR(unaccounted_energy(run.energy), -5e-6, 1e-18);
  run.momentum.reset();  // its row "unaccounted" aside
  const std::string text = summary_text(run);
  EXPECT_EQ(row_of(text, "kinetic, drop"), "250.0000 50.0000 -200.0000 -80.000");
  EXPECT_EQ(row_of(text, "surface"), "226.0000 236.0000 10.0000 4.000");
  EXPECT_EQ(row_of(text, "dissipated"), "0.0000 185.0000 185.0000 74.000");
  EXPECT_EQ(row_of(text, "sum"), "476.0000 471.0000 -5.0000 -2.000");
  EXPECT_EQ(row_of(text, "unaccounted"), "-5.0000 -2.000");
}

TEST(Summary, TrafficAndMemory) {
  RunSummary run = full();
  EXPECT_EQ(summary_text(run).find("traffic"), std::string::npos);
  EXPECT_EQ(summary_text(run).find("memory"), std::string::npos);
  run.traffic = {{"step", 1600001, 3.5, 6300.0, 5.0, 8567.0, 1.0, 128.0}};
  run.peak_memory = 34.04e6;
  EXPECT_EQ(row_of(summary_text(run), "a step"), "1600001 3.50 6.300 5.00 8.567 1.00 0.128");
  EXPECT_EQ(value_of(summary_text(run), "memory, most of a rank"), "34.0 MB");
  // One rank alone has nobody to write to.
  run.ranks = 1;
  EXPECT_EQ(summary_text(run).find("traffic"), std::string::npos);
}

TEST(Summary, WallTimeAndLoad) {
  const std::string text = summary_text(full());
  EXPECT_EQ(row_of(text, "fluid sweep"), "40.000 40.0");
  EXPECT_EQ(row_of(text, "solid sweep"), "35.000 35.0");
  EXPECT_EQ(row_of(text, "other"), "25.000 25.0");
  EXPECT_EQ(row_of(text, "total"), "100.000 100.0");
  EXPECT_EQ(value_of(text, "per particle and step"), "12.5 ns (5000 particles, 1600000 steps, 2 ranks)");
  EXPECT_EQ(value_of(text, "compiled for"), "x86-64-v3, vectors of 4 doubles");
  EXPECT_EQ(value_of(text, "load, largest / mean"), "1.070");
  EXPECT_EQ(value_of(text, "work, largest / mean"), "1.034 by the last of 3 partitions");
}

TEST(Summary, ARestartedPartCountsItsOwnStepsOnly) {
  RunSummary run = full();
  run.first_step = 800000;
  const std::string text = summary_text(run);
  EXPECT_EQ(value_of(text, "per particle and step"), "25.0 ns (5000 particles, 800000 steps, 2 ranks)");
  EXPECT_EQ(value_of(text, "simulated time"), "8.0000 ms in 1600000 steps");
}

TEST(Summary, EndsWithTheStateHash) {
  RunSummary run = full();
  EXPECT_TRUE(summary_text(run).ends_with("\nstate hash 0123456789abcdef\n"));
  run.state_hash = 0xfU;
  EXPECT_TRUE(summary_text(run).ends_with("\nstate hash 000000000000000f\n"));
}

/// Where the words of a line end, so that right-aligned columns compare equal.
std::vector<std::size_t> last_word_ends(const std::string& line, std::size_t words) {
  std::vector<std::size_t> ends;
  for (std::size_t i = line.size(); i > 0 && ends.size() < words; --i)
    if (line[i - 1] != ' ' && (i == line.size() || line[i] == ' ')) ends.push_back(i);
  return ends;
}

TEST(Summary, NumbersOfATableStandUnderEachOther) {
  std::istringstream stream(summary_text(full()));
  std::vector<std::size_t> wall, momentum;
  std::size_t energy = 0;
  int rows = 0;
  for (std::string line; std::getline(stream, line);) {
    EXPECT_LE(line.size(), 100u) << line;
    const auto starts_with_one_of = [&](std::initializer_list<const char*> names) {
      const bool found =
          std::any_of(names.begin(), names.end(), [&](const char* name) { return line.starts_with(name); });
      rows += found;
      return found;
    };
    if (line.starts_with("wall time")) wall = last_word_ends(line, 2);
    if (line.starts_with("momentum ledger")) momentum = last_word_ends(line, 2);
    if (line.starts_with("energy ledger")) energy = line.size();
    if (starts_with_one_of({"  fluid sweep", "  other", "  total"})) {
      EXPECT_EQ(last_word_ends(line, 2), wall) << line;
    }
    if (starts_with_one_of({"  impulse on the solid", "  change of the drop", "  gravity on the drop"})) {
      EXPECT_EQ(last_word_ends(line, 2), momentum) << line;
    }
    if (starts_with_one_of({"  kinetic, drop", "  surface", "  dissipated", "  sum"})) {
      EXPECT_EQ(line.size(), energy) << line;
    }
  }
  EXPECT_EQ(rows, 10);
}

TEST(Summary, WhatACaseLacksIsLeftOut) {
  const std::string text = summary_text({});
  for (const char* word : {"contact", "drop", "beam", "momentum", "energy", "nan", "inf", "per particle"})
    EXPECT_EQ(text.find(word), std::string::npos) << word << " in\n" << text;
  EXPECT_NE(text.find("state hash 0000000000000000"), std::string::npos);
  RunSummary fixed = full();
  fixed.beam->theory_deflection.reset();
  EXPECT_EQ(value_of(summary_text(fixed), "largest deflection"), "0.2863 mm");
  fixed.contact->first.reset();
  fixed.contact->last.reset();
  EXPECT_EQ(value_of(summary_text(fixed), "contact time"), "none: the drop never touched");
}

TEST(Summary, LongListsOfGapsAreCutShort) {
  RunSummary run = full();
  run.contact->gaps.assign(13, {1e-3, 2e-3});
  const std::string text = summary_text(run);
  EXPECT_EQ(value_of(text, "gaps over 20 us"), "13");
  EXPECT_NE(text.find("and 3 more\n"), std::string::npos);
}

TEST(Summary, ContactComesFromItsRecord) {
  ContactRecord record(1.0, 20.0);
  for (int step = 0; step < 200; ++step) record.add(step, 1.0, step >= 10 && step < 110 ? 1 : 0, {0.0, 2.0});
  record.add(200.0, 1.0, 1, {});
  const auto contact = contact_summary(record);
  EXPECT_EQ(contact.first, 10.0);
  EXPECT_EQ(contact.last, 200.0);
  EXPECT_EQ(contact.gap_limit, 20.0);
  EXPECT_EQ(contact.gaps, (std::vector<ContactRecord::Gap>{{109.0, 200.0}}));
  EXPECT_EQ(contact.impulse_time, record.impulse_time(0.99));
}

}  // namespace
}  // namespace sphdrop
