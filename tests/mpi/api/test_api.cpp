// The library as programs use it, on every rank together.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

#include "api/sphdrop.hpp"

namespace sphdrop::v1 {
namespace {

namespace fs = std::filesystem;

constexpr const char* little = R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 10e-6
sound_cfl = 0.2
[drop]
diameter = 0.6e-3
velocity = [0.2, -3.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 2e-3
)";

Case little_case(const std::vector<std::string>& overrides = {}) {
  return Case::from_text(little, overrides, "little.cfg");
}

std::uint64_t hash_at_the_end(const Case& input) {
  Simulation simulation(MPI_COMM_WORLD, input);
  EXPECT_TRUE(simulation.run());
  return simulation.state_hash();
}

/// What `act` throws, which must be an Error of this kind.
template <class F>
std::string text_of_error(Error::Kind kind, F&& act) {
  try {
    act();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A folder of this number of ranks, empty at the start and gone at the end.
struct Folder {
  fs::path path;
  int rank = 0;
  explicit Folder(const std::string& name) {
    int ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    path = fs::path(testing::TempDir()) / (name + std::to_string(ranks));
    clear();
  }
  ~Folder() { clear(); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  void clear() const {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank == 0) fs::remove_all(path);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  std::string text_of(const std::string& name) const {
    std::ifstream file(path / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

TEST(ApiCase, TellsWhatIsInIt) {
  const Case input = little_case({"solid.length=3 mm"});
  EXPECT_EQ(input.number("solid.length"), 3e-3);
  EXPECT_EQ(input.number("drop.diameter"), 0.6e-3);
  EXPECT_EQ(input.value("drop.velocity"), "[0.2, -3]");
  EXPECT_EQ(input.value("solid.kind"), "\"cantilever\"");
  EXPECT_EQ(input.with({"drop.diameter=0.7 mm"}).number("drop.diameter"), 0.7e-3);
  EXPECT_EQ(input.with({"drop.diameter=0.7 mm"}).number("solid.length"), 3e-3);
  EXPECT_EQ(Case::from_text(input.text()).text(), input.text());
  EXPECT_EQ(little_case().warnings().size() + 1, little_case({"solid.thickness=0.3125 mm"}).warnings().size())
      << "five rows are odd";
}

TEST(ApiCase, MistakesAreThoseOfTheProgram) {
  const auto with = [](const char* override) {
    return text_of_error(Error::Kind::mistake, [&] { little_case({override}); });
  };
  EXPECT_TRUE(holds(with("solid.lenght=3e-3"), "did you mean"));
  EXPECT_TRUE(holds(with("solid.length=-3e-3"), "out of range"));
  EXPECT_TRUE(holds(text_of_error(Error::Kind::mistake, [] { little_case().number("solid.size"); }), "solid.size"));
  EXPECT_TRUE(holds(text_of_error(Error::Kind::mistake, [] { little_case().number("solid.kind"); }), "not one number"));
  EXPECT_TRUE(holds(text_of_error(Error::Kind::mistake, [] { Case::from_file(MPI_COMM_WORLD, "no_such.cfg"); }),
                    "no_such.cfg"));
}

TEST(ApiSimulation, StepsToTheEndAndNoFurther) {
  Simulation simulation(MPI_COMM_WORLD, little_case());
  EXPECT_EQ(simulation.time(), 0.0);
  EXPECT_EQ(simulation.steps(), 0);
  const double first_step = simulation.time_step();
  EXPECT_TRUE(simulation.step());
  EXPECT_EQ(simulation.time(), first_step);
  EXPECT_TRUE(simulation.run_until(5e-6));
  EXPECT_GE(simulation.time(), 5e-6);
  EXPECT_LT(simulation.time(), 5e-6 + 2 * first_step);
  EXPECT_TRUE(simulation.run());
  EXPECT_GE(simulation.time(), 10e-6);
  const std::int64_t steps = simulation.steps();
  EXPECT_FALSE(simulation.step());
  EXPECT_FALSE(simulation.run_until(1.0));
  EXPECT_EQ(simulation.steps(), steps);
  EXPECT_TRUE(simulation.summary().empty());
}

TEST(ApiSimulation, ObserversAreCalledWhenTheyAskAndChangeNothing) {
  Simulation simulation(MPI_COMM_WORLD, little_case());
  std::vector<double> every, now_and_then;
  double speed = 0;
  simulation.every_step([&](Simulation& s) { every.push_back(s.time()); });
  simulation.every(2.5e-6, [&](Simulation& s) {
    now_and_then.push_back(s.time());
    for (const char* name : {"stress_xx", "velocity_y", "pressure"})
      for (const double value : s.column(Material::solid, name)) EXPECT_TRUE(std::isfinite(value)) << name;
    speed = s.observed("drop_velocity_y");
  });
  EXPECT_TRUE(simulation.run());
  EXPECT_EQ(every.size(), static_cast<std::size_t>(simulation.steps()) + 1);
  EXPECT_TRUE(std::is_sorted(every.begin(), every.end()));
  ASSERT_EQ(now_and_then.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    const double due = 2.5e-6 * static_cast<double>(k);
    EXPECT_GE(now_and_then[k], due * (1 - 1e-9));
    EXPECT_LT(now_and_then[k], due + 2 * simulation.time_step());
  }
  EXPECT_LT(speed, -2.0);
  EXPECT_EQ(simulation.state_hash(), hash_at_the_end(little_case()));
}

TEST(ApiSimulation, ColumnsAreAllParticlesInTheSameOrderOnEveryRank) {
  Simulation simulation(MPI_COMM_WORLD, little_case());
  simulation.run_until(4e-6);
  const std::vector<double> mass = simulation.column(Material::drop, "mass");
  ASSERT_EQ(static_cast<std::int64_t>(mass.size()), simulation.particles(Material::drop));
  EXPECT_NEAR(std::accumulate(mass.begin(), mass.end(), 0.0), 1000 * 3.14159265 * 0.09e-6, 1e-10);
  // Those that lie here, at their places among all.
  const std::vector<double> x = simulation.column(Material::solid, "position_x");
  const std::vector<double> mine = simulation.own_column(Material::solid, "position_x");
  const std::vector<std::int64_t> ids = simulation.own_ids(Material::solid);
  ASSERT_EQ(mine.size(), ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k)
    EXPECT_EQ(mine[k], x[static_cast<std::size_t>(ids[k] - simulation.particles(Material::drop))]);
  std::int64_t owned = static_cast<std::int64_t>(ids.size()), all = 0;
  MPI_Allreduce(&owned, &all, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(all, simulation.particles(Material::solid));
  for (const Material material : {Material::drop, Material::solid})
    for (const Quantity& quantity : Simulation::columns(material)) {
      EXPECT_FALSE(quantity.unit.empty() || quantity.description.empty()) << quantity.name;
      EXPECT_EQ(static_cast<std::int64_t>(simulation.column(material, quantity.name).size()),
                simulation.particles(material));
    }
}

TEST(ApiSimulation, WhatIsNotThereIsNamed) {
  Simulation simulation(MPI_COMM_WORLD, little_case());
  const auto mistake = [&](auto&& act) { return text_of_error(Error::Kind::mistake, act); };
  EXPECT_TRUE(holds(mistake([&] { simulation.column(Material::drop, "stress_xx"); }), "they have mass, position_x"));
  EXPECT_TRUE(holds(mistake([&] { simulation.observed("drop_size"); }), "drop_size"));
  EXPECT_TRUE(holds(mistake([&] { simulation.every(0, [](Simulation&) {}); }), "must be > 0"));
  EXPECT_TRUE(holds(mistake([&] { simulation.every_step([](Simulation& s) { s.step(); }); }), "may look"));
}

TEST(ApiSimulation, AnUnsafeStateIsThrownOnAllRanks) {
  Simulation simulation(MPI_COMM_WORLD, little_case({"safety.speed_limit=3.005"}));
  EXPECT_TRUE(holds(text_of_error(Error::Kind::unsafe_state, [&] { simulation.run(); }), "faster than"));
}

TEST(ApiResults, AreThoseOfTheProgramAndDoNotChangeTheState) {
  const Folder folder("sphdrop_api_results");
  Simulation simulation(MPI_COMM_WORLD, little_case(), Results{.folder = folder.path.string()});
  EXPECT_TRUE(simulation.run());
  EXPECT_TRUE(holds(simulation.summary(), "state hash"));
  EXPECT_TRUE(holds(simulation.summary(), "largest Mach number"));
  EXPECT_EQ(simulation.state_hash(), hash_at_the_end(little_case()));
  EXPECT_TRUE(holds(folder.text_of("run.json"), "\"status\": \"completed\""));
  EXPECT_TRUE(holds(folder.text_of("run.json"), "\"largest_mach_number\": 0."));
  EXPECT_TRUE(fs::exists(folder.path / "history.csv"));
  EXPECT_TRUE(holds(folder.text_of("case.cfg"), "youngs_modulus"));
}

TEST(ApiResults, CanBeEndedEarly) {
  const Folder folder("sphdrop_api_early");
  Simulation simulation(MPI_COMM_WORLD, little_case(), Results{.folder = folder.path.string()});
  simulation.every_step([](Simulation& s) {
    if (s.time() >= 3e-6) s.finish();
  });
  EXPECT_FALSE(simulation.run());
  EXPECT_LT(simulation.time(), 4e-6);
  EXPECT_TRUE(holds(folder.text_of("run.json"), "\"status\": \"completed\""));
  EXPECT_TRUE(holds(simulation.summary(), "state hash"));
}

TEST(ApiResults, StopForTheWallTimeAndGoOnToTheSameBits) {
  const Folder folder("sphdrop_api_restart");
  {
    Simulation simulation(MPI_COMM_WORLD, little_case(), Results{.folder = folder.path.string(), .max_walltime = 0.1});
    EXPECT_FALSE(simulation.run());
    EXPECT_EQ(simulation.stopped(), "the wall time runs out");
    EXPECT_FALSE(simulation.step());
    EXPECT_TRUE(holds(text_of_error(Error::Kind::mistake, [&] { simulation.state_hash(); }), "has stopped"));
  }
  EXPECT_TRUE(holds(
      text_of_error(Error::Kind::mistake,
                    [&] { Simulation again(MPI_COMM_WORLD, little_case(), Results{.folder = folder.path.string()}); }),
      "not finished"));
  Simulation simulation(MPI_COMM_WORLD, little_case(), Results{.folder = folder.path.string(), .restart = "latest"});
  EXPECT_GT(simulation.time(), 0.0);
  EXPECT_TRUE(simulation.run());
  EXPECT_EQ(simulation.state_hash(), hash_at_the_end(little_case()));
}

}  // namespace
}  // namespace sphdrop::v1
