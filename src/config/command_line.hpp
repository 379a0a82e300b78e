#pragma once
// sphdrop [options] case.cfg

#include <optional>
#include <string>
#include <vector>

namespace sphdrop {

struct CommandLine {
  enum class Action {
    run,
    print,    ///< read and check the case and print it with every parameter
    check,    ///< read and check the case, set it up, but take no step
    version,  ///< tell version and commit and leave
    finish    ///< print `text` and leave with `exit_code`: to standard output if that is 0, else to standard error
  };
  Action action = Action::run;
  std::string text;
  int exit_code = 0;

  std::string case_file;
  std::vector<std::string> overrides;           ///< "key=value", in the order given; for read_case_file
  std::optional<std::string> output_directory;  ///< instead of the case's output.directory
  std::optional<double> until;                  ///< simulated time to stop at, s, > 0; the case's time.end stays
  bool quiet = false;
  std::optional<std::string> restart;  ///< "latest", "auto" (latest if there is any) or a checkpoint's path
  bool fresh = false;                  ///< start anew, whatever checkpoints there are
  std::optional<double> max_walltime;  ///< s, > 0
};

/// Prints nothing and does not throw for mistakes of the user: they come back as Action::finish with exit code 2.
CommandLine parse_command_line(int argc, const char* const* argv);

/// "0.1.0"
std::string version_text();

}  // namespace sphdrop
