// What a restarted run may do differently.
#include <gtest/gtest.h>

#include "config/case_file.hpp"
#include "config/parameter_table.hpp"
#include "config/restart_changes.hpp"

namespace sphdrop {
namespace {

constexpr const char* case_text = R"(
[resolution]
spacing = 2.5e-5
[time]
end = 1e-3
[solid]
kind = "cantilever"
length = 8e-3
)";

Case parse(const std::vector<std::string>& overrides = {}) {
  return parse_case_text(case_text, "test.cfg", overrides).values;
}

TEST(RestartChanges, NamesWhatDiffersInTheTablesOrder) {
  EXPECT_TRUE(parameter_changes(parse(), parse()).empty());
  const auto changes = parameter_changes(
      parse(), parse({"surface_tension.form=curvature", "drop.arrangement=lattice", "time.step=1e-9"}));
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(changes[0].key, "time.step");
  EXPECT_EQ(changes[1].key, "drop.arrangement");
  EXPECT_EQ(changes[1].after, "\"lattice\"");
  EXPECT_EQ(changes[2].key, "surface_tension.form");
  EXPECT_EQ(changes[2].before, "\"conservative\"");
}

TEST(RestartChanges, TheFolderOfTheResultsDoesNotCount) {
  EXPECT_TRUE(parameter_changes(parse(), parse({"output.directory=elsewhere"})).empty());
}

TEST(RestartChanges, PhysicsMayNotChangeOutputAndEndMay) {
  int allowed = 0;
  for (const Parameter& parameter : parameter_table()) {
    const std::string_view section = parameter.section();
    const bool may = parameter.key == "time.end" || section == "output" || section == "checkpoint" ||
                     section == "parallel" || section == "safety";
    EXPECT_EQ(may_change_on_restart(parameter.key), may) << parameter.key;
    allowed += may;
  }
  EXPECT_GE(allowed, 10);
}

}  // namespace
}  // namespace sphdrop
