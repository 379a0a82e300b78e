#pragma once
// What the program says of itself. Speaks to no library, so that what is compiled for several instruction sets needs
// none.

#include <string>

namespace sphdrop {

/// How the program was built.
struct BuildInfo {
  std::string version;     ///< of the program
  std::string git_commit;  ///< at configure time, "+changes" behind it if the checkout had any; or "unknown"
  std::string compiler;
  std::string flags;
  std::string architecture;  ///< as for -march; empty: the compiler's choice
  int vector_width;          ///< doubles in a vector of the sweeps
};
const BuildInfo& build_info();

/// "x86-64-v3, vectors of 4 doubles": what the sweeps of particles are compiled for.
std::string instruction_text(const BuildInfo& build);

}  // namespace sphdrop
