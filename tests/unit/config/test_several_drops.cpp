// Cases of several drops: [[drop]] in the file, drop[2].key on the command line.
#include <gtest/gtest.h>

#include "config/case_error.hpp"
#include "config/case_file.hpp"
#include "config/effective_case.hpp"
#include "config/restart_changes.hpp"

namespace sphdrop {
namespace {

const std::string two_drops =
    "[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n"                                            // lines 1-4
    "[[drop]]\ndiameter = 1e-3\nvelocity = [0.5, 0]\n"                                                // 5-7
    "[[drop]]\ndiameter = 0.8e-3\nvelocity = [-0.5, 0]\ncentre_x = 1.2e-3\ncentre_y = \"0.1 mm\"\n";  // 8-12

Case read(const std::vector<std::string>& overrides = {}, const std::string& text = two_drops) {
  return parse_case_text(text, "pair.cfg", overrides).values;
}

std::string mistake_of(const std::vector<std::string>& overrides, const std::string& text = two_drops) {
  try {
    read(overrides, text);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "none";
}

TEST(SeveralDrops, AreReadInTheirOrder) {
  const Case c = read();
  ASSERT_EQ(c.drop_count(), 2u);
  EXPECT_EQ(c.drop.velocity_x, 0.5);
  const Case::Drop second = c.with_drop(1).drop;
  EXPECT_EQ(second.diameter, 0.8e-3);
  EXPECT_EQ(second.velocity_x, -0.5);
  EXPECT_EQ(second.centre_x, 1.2e-3);
  EXPECT_EQ(second.centre_y, 1e-4);
  EXPECT_EQ(second.density, c.fluid.density);  // derived for each
  EXPECT_TRUE(c.with_drop(1).more_drops.empty());
}

TEST(SeveralDrops, OverridesNameTheDrop) {
  const Case c = read({"drop.diameter=2 mm", "drop[2].diameter=0.6e-3", "drop[1].velocity=[1, 0]"});
  EXPECT_EQ(c.drop.diameter, 2e-3);
  EXPECT_EQ(c.drop.velocity_x, 1);
  EXPECT_EQ(c.with_drop(1).drop.diameter, 0.6e-3);
  EXPECT_NE(mistake_of({"drop[3].diameter=1e-3"}).find("the case has 2 drops; each further one is a section [[drop]]"),
            std::string::npos);
  EXPECT_NE(mistake_of({"drop[0].diameter=1e-3"}).find("not a known key"), std::string::npos);
}

TEST(SeveralDrops, TheFastestAndLargestCount) {
  const double margin = read().safety.domain_margin;
  EXPECT_GT(read({"drop[2].velocity=[-5, 0]"}).safety.domain_margin, margin);
  EXPECT_GT(read({"drop.velocity=[5, 0]"}).safety.domain_margin, margin);
}

TEST(SeveralDrops, AreOfTheModernLiquidInModeModernAsOneIs) {
  EXPECT_EQ(read({"mode=modern"}).fluid.viscosity_form, ViscosityForm::physical);
  EXPECT_EQ(read({"mode=modern"}).fluid.shifting, Switch::on);
  EXPECT_EQ(read({"mode=modern"}, two_drops.substr(0, two_drops.rfind("[[drop]]"))).fluid.viscosity_form,
            ViscosityForm::physical);
}

TEST(SeveralDrops, TheEffectiveCaseRepeatsThem) {
  const Case c = read();
  EXPECT_EQ(read({}, effective_case_text(c)), c);
}

TEST(SeveralDrops, MistakesNameTheDropAndItsLine) {
  EXPECT_EQ(mistake_of({}, two_drops + "seed = -1\n").find("pair.cfg:13: drop[2].seed = -1 is out of range"), 0u)
      << mistake_of({}, two_drops + "seed = -1\n");
  const std::string spinning = mistake_of({}, two_drops + "initial_spin = 3\n");
  EXPECT_EQ(spinning.find("pair.cfg:13: drop 2: drop.initial_spin needs"), 0u) << spinning;
  EXPECT_EQ(mistake_of({}, two_drops + "colour = 3\n").find("pair.cfg:13: drop.colour is not a known key"), 0u);
  EXPECT_NE(mistake_of({}, two_drops + "material = \"rigid\"\n")
                .find("several drops must all be liquid, and drop 2 is rigid"),
            std::string::npos);
  EXPECT_NE(mistake_of({"drop[2].relaxation_time=1e-3"}).find("relaxation_time of drop 2 must be 0"),
            std::string::npos);
}

TEST(SeveralDrops, ARestartComparesEach) {
  const auto changes = parameter_changes(read(), read({"drop[2].diameter=0.9e-3"}));
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].key, "drop[2].diameter");
  EXPECT_FALSE(may_change_on_restart(changes[0].key));
  const std::string one_drop = two_drops.substr(0, two_drops.rfind("[[drop]]"));
  const auto lost = parameter_changes(read(), read({"safety.domain_margin=1"}, one_drop));
  EXPECT_TRUE(std::any_of(lost.begin(), lost.end(), [](const auto& change) { return change.key == "drop"; }));
}

}  // namespace
}  // namespace sphdrop
