#include "config/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "config/key_suggestion.hpp"
#include "config/nearest_name.hpp"
#include "config/parameter_listing.hpp"
#include "config/parameter_store.hpp"

namespace sphdrop {
namespace {

constexpr int usage_exit_code = 2;

CommandLine finish(std::string text, int exit_code) {
  CommandLine result;
  result.action = CommandLine::Action::finish;
  result.text = std::move(text);
  result.exit_code = exit_code;
  return result;
}

CommandLine usage_mistake(const std::string& message) {
  return finish(fmt::format("sphdrop: {}\nUsage: sphdrop [options] case.cfg; sphdrop --help explains.\n", message),
                usage_exit_code);
}

// "90", "1:30" or "0:01:30", in s.
std::optional<double> parse_duration(const std::string& text) {
  double seconds = 0;
  std::size_t begin = 0;
  for (int part = 0; part < 3; ++part) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    const std::optional<double> value = parse_number(text.substr(begin, end - begin));
    if (!value || !(*value >= 0) || (part > 0 && *value >= 60)) return std::nullopt;
    seconds = 60 * seconds + *value;
    if (end == text.size()) return seconds;
    begin = end + 1;
  }
  return std::nullopt;
}

std::string unexpected_argument(const CLI::App& app, const std::string& argument) {
  if (!argument.starts_with('-')) {
    return fmt::format("{} is one argument too many: one case file at a time", printable(argument));
  }
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::vector<std::string_view> views(names.begin(), names.end());
  const auto nearest = nearest_name(std::string_view(argument).substr(0, argument.find('=')), views);
  return fmt::format("there is no option {}{}", printable(argument),
                     nearest ? fmt::format("; did you mean {}?", *nearest) : "");
}

}  // namespace

std::string version_text() {
  return SPHDROP_VERSION;
}

CommandLine parse_command_line(int argc, const char* const* argv) {
  CommandLine result;
  bool version = false;
  bool list_parameters = false;
  bool check = false;
  bool print_case = false;
  std::string output;
  std::string restart;
  std::string max_walltime;
  std::string until;  // read by parse_number, since the library's conversion heeds the locale

  CLI::App app("Droplet impact on elastic beams by smoothed particle hydrodynamics", "sphdrop");
  app.allow_extras();
  app.add_option("case", result.case_file, "the case file (TOML)")->option_text("case.cfg");
  app.add_flag("--version", version, "print version and commit and leave");
  app.add_flag("--list-parameters", list_parameters, "print all parameters of a case and leave");
  app.add_flag("--check", check, "read, check and set up the case, but do not run it");
  app.add_flag("--print-case", print_case, "print the case with every parameter, in SI units, and leave");
  app.add_option("--set", result.overrides, "use this value instead of the case file's; may be given several times")
      ->option_text("key=value")
      ->allow_extra_args(false);
  CLI::Option* output_option =
      app.add_option("--output", output, "folder of the results, instead of the case's output.directory")
          ->option_text("DIR");
  CLI::Option* until_option = app.add_option("--until", until, "stop at this simulated time, leaving time.end as it is")
                                  ->option_text("SECONDS");
  CLI::Option* restart_option =
      app.add_option(
             "--restart", restart,
             "go on from a checkpoint: 'latest' in the folder of the results, a file, or 'auto': latest if there "
             "is any, else from the beginning")
          ->option_text("latest|auto|FILE");
  app.add_flag("--fresh", result.fresh, "start from the beginning and remove the checkpoints of an unfinished run");
  CLI::Option* walltime_option =
      app.add_option("--max-walltime", max_walltime,
                     "write a checkpoint and stop in good time before this wall time is over, with exit code 5")
          ->option_text("SECONDS|H:MM:SS");
  app.add_flag("--quiet", result.quiet, "print warnings, errors and the final state hash only");

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return finish(app.help(), 0);
  } catch (const CLI::ParseError& error) {
    return usage_mistake(error.what());
  }

  const std::vector<std::string> extras = app.remaining();
  if (!extras.empty()) return usage_mistake(unexpected_argument(app, extras.front()));
  if (version) {
    result.action = CommandLine::Action::version;
    return result;
  }
  if (list_parameters) return finish(list_parameters_text(), 0);
  if (result.case_file.empty()) return usage_mistake("a case file is missing");
  if (print_case) result.action = CommandLine::Action::print;
  if (check) result.action = CommandLine::Action::check;
  if (output_option->count() > 0) {
    if (output.empty()) return usage_mistake("--output needs the name of a folder");
    result.output_directory = output;
  }
  if (until_option->count() > 0) {
    result.until = parse_number(until);
    if (!result.until || !(*result.until > 0)) {
      return usage_mistake(fmt::format("--until needs a simulated time > 0 in seconds; it is {}", printable(until)));
    }
  }
  if (restart_option->count() > 0) {
    if (restart.empty()) return usage_mistake("--restart needs latest, auto or a checkpoint's file");
    if (result.fresh) return usage_mistake("--restart and --fresh contradict each other");
    result.restart = restart;
  }
  if (walltime_option->count() > 0) {
    result.max_walltime = parse_duration(max_walltime);
    if (!result.max_walltime || !(*result.max_walltime > 0)) {
      return usage_mistake(fmt::format(
          "--max-walltime needs a time > 0 in seconds or as hours:minutes:seconds; it is {}", printable(max_walltime)));
    }
  }
  return result;
}

}  // namespace sphdrop
