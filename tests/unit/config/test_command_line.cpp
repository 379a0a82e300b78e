#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "config/command_line.hpp"
#include "config/parameter_listing.hpp"

namespace sphdrop {
namespace {

using Action = CommandLine::Action;

CommandLine parse(const std::vector<const char*>& arguments) {
  std::vector<const char*> argv = {"sphdrop"};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  return parse_command_line(static_cast<int>(argv.size()), argv.data());
}

void expect_usage_mistake(const std::vector<const char*>& arguments, const std::string& fragment) {
  const CommandLine line = parse(arguments);
  EXPECT_EQ(line.action, Action::finish);
  EXPECT_EQ(line.exit_code, 2);
  EXPECT_TRUE(line.text.starts_with("sphdrop: ")) << line.text;
  EXPECT_NE(line.text.find(fragment), std::string::npos) << line.text;
  EXPECT_NE(line.text.find("--help"), std::string::npos) << line.text;
}

TEST(CommandLineTest, RunsACase) {
  const CommandLine line = parse({"case.cfg"});
  EXPECT_EQ(line.action, Action::run);
  EXPECT_EQ(line.case_file, "case.cfg");
  EXPECT_TRUE(line.overrides.empty());
  EXPECT_FALSE(line.output_directory.has_value());
  EXPECT_FALSE(line.until.has_value());
  EXPECT_FALSE(line.quiet);
}

TEST(CommandLineTest, TakesOptionsInAnyOrder) {
  const CommandLine line =
      parse({"--set", "drop.velocity=[0, -1]", "case.cfg", "--set", "solid.initial_tip_velocity=-0.5", "--output",
             "-odd", "--until", "1e-3", "--quiet", "--set=drop.shape=none"});
  EXPECT_EQ(line.action, Action::run) << line.text;
  EXPECT_EQ(line.case_file, "case.cfg");
  EXPECT_EQ(line.overrides,
            (std::vector<std::string>{"drop.velocity=[0, -1]", "solid.initial_tip_velocity=-0.5", "drop.shape=none"}));
  EXPECT_EQ(line.output_directory, "-odd");
  EXPECT_EQ(line.until, 1e-3);
  EXPECT_TRUE(line.quiet);
}

TEST(CommandLineTest, SetTakesOneArgumentOnly) {
  const CommandLine line = parse({"--set", "drop.seed=2", "case.cfg"});
  EXPECT_EQ(line.case_file, "case.cfg");
  EXPECT_EQ(line.overrides.size(), 1u);
}

TEST(CommandLineTest, HandsValuesOnUnchanged) {
  for (const char* text :
       {"drop.gap=-1", "name=\"a b\"", "name='x'", "drop.velocity=[1,2]", "name=a,b", "name=[x]", "-1"}) {
    const CommandLine line = parse({"case.cfg", "--set", text});
    ASSERT_EQ(line.overrides.size(), 1u) << text << line.text;
    EXPECT_EQ(line.overrides[0], text);
  }
}

TEST(CommandLineTest, Checks) {
  EXPECT_EQ(parse({"--check", "case.cfg"}).action, Action::check);
  EXPECT_EQ(parse({"--print-case", "case.cfg"}).action, Action::print);
}

TEST(CommandLineTest, AnswersQuestionsWithoutACase) {
  const CommandLine help = parse({"--help"});
  EXPECT_EQ(help.action, Action::finish);
  EXPECT_EQ(help.exit_code, 0);
  for (const char* option : {"--help", "--version", "--list-parameters", "--check", "--print-case", "--set", "--output",
                             "--until", "--quiet", "--restart", "--fresh", "--max-walltime", "case.cfg"}) {
    EXPECT_NE(help.text.find(option), std::string::npos) << option;
  }
  EXPECT_EQ(parse({"-h"}).text, help.text);

  EXPECT_EQ(parse({"--version"}).action, Action::version);
  EXPECT_EQ(version_text(), EXPECTED_VERSION);

  const CommandLine listing = parse({"--list-parameters"});
  EXPECT_EQ(listing.exit_code, 0);
  EXPECT_EQ(listing.text, list_parameters_text());
}

TEST(CommandLineTest, ExplainsMistakes) {
  expect_usage_mistake({}, "a case file is missing");
  expect_usage_mistake({"--check"}, "a case file is missing");
  expect_usage_mistake({"--chekc", "case.cfg"}, "no option --chekc; did you mean --check?");
  expect_usage_mistake({"--outptu=x", "case.cfg"}, "no option --outptu=x; did you mean --output?");
  expect_usage_mistake({"--frobnicate", "case.cfg"}, "no option --frobnicate");
  expect_usage_mistake({"-x", "case.cfg"}, "no option -x");
  expect_usage_mistake({"one.cfg", "two.cfg"}, "two.cfg is one argument too many");
  expect_usage_mistake({"case.cfg", "--set"}, "--set");
  expect_usage_mistake({"case.cfg", "--output"}, "--output");
  expect_usage_mistake({"case.cfg", "--output", ""}, "--output");
  expect_usage_mistake({"case.cfg", "--until", "soon"}, "--until needs a simulated time > 0 in seconds; it is soon");
  expect_usage_mistake({"case.cfg", "--until", "-1e-3"}, "--until needs a simulated time > 0 in seconds; it is -1e-3");
  expect_usage_mistake({"case.cfg", "--until", "0"}, "--until");
  expect_usage_mistake({"case.cfg", "--until", "nan"}, "--until");
  expect_usage_mistake({"case.cfg", "--until", "1e999"}, "--until");
  expect_usage_mistake({"case.cfg", "--until", "1", "--until", "2"}, "--until");
  expect_usage_mistake({"case.cfg", "--restart", ""}, "--restart needs latest, auto or a checkpoint's file");
  expect_usage_mistake({"case.cfg", "--restart", "latest", "--fresh"}, "--restart and --fresh contradict each other");
  for (const char* duration : {"", "0", "-5", "soon", "1:60", "1:2:3:4", "1::2", "nan", "1:-2"})
    expect_usage_mistake({"case.cfg", "--max-walltime", duration}, "--max-walltime needs a time > 0 in seconds");
}

TEST(CommandLineTest, TakesUpRunsAndLimitsThem) {
  EXPECT_FALSE(parse({"case.cfg"}).restart);
  EXPECT_FALSE(parse({"case.cfg"}).fresh);
  EXPECT_FALSE(parse({"case.cfg"}).max_walltime);
  EXPECT_EQ(parse({"case.cfg", "--restart", "latest"}).restart, "latest");
  EXPECT_EQ(parse({"--restart=results/a/checkpoint_000000000042.h5", "case.cfg"}).restart,
            "results/a/checkpoint_000000000042.h5");
  EXPECT_TRUE(parse({"--fresh", "case.cfg"}).fresh);
  EXPECT_EQ(parse({"case.cfg", "--max-walltime", "90"}).max_walltime, 90.0);
  EXPECT_EQ(parse({"case.cfg", "--max-walltime", "1:30"}).max_walltime, 90.0);
  EXPECT_EQ(parse({"case.cfg", "--max-walltime", "24:00:01.5"}).max_walltime, 86401.5);
}

}  // namespace
}  // namespace sphdrop
