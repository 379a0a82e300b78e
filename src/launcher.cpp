// sphdrop as it is installed for several instruction sets: becomes the program for the best of them that the processor
// has.

#include <sys/platform/x86.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace {

constexpr int internal_error = 1;
constexpr int user_mistake = 2;

bool all_active(std::initializer_list<unsigned> features) {
  return std::all_of(features.begin(), features.end(), [](unsigned feature) { return x86_cpu_active(feature); });
}

/// By the levels of the x86-64 psABI (3.1.1); active is what the operating system saves too. Any processor of the kind
/// has the least instruction set.
bool processor_has(std::string_view arch) {
  const bool has_v3 = all_active({x86_cpu_CMPXCHG16B, x86_cpu_LAHF64_SAHF64, x86_cpu_POPCNT, x86_cpu_SSE3,
                                  x86_cpu_SSSE3, x86_cpu_SSE4_1, x86_cpu_SSE4_2, x86_cpu_AVX, x86_cpu_AVX2,
                                  x86_cpu_BMI1, x86_cpu_BMI2, x86_cpu_F16C, x86_cpu_FMA, x86_cpu_LZCNT, x86_cpu_MOVBE});
  if (arch == "x86-64-v3") return has_v3;
  if (arch == "x86-64-v4")
    return has_v3 &&
           all_active({x86_cpu_AVX512F, x86_cpu_AVX512BW, x86_cpu_AVX512CD, x86_cpu_AVX512DQ, x86_cpu_AVX512VL});
  return true;
}

std::vector<std::string> installed_archs() {
  std::istringstream names(SPHDROP_ARCHS);
  return {std::istream_iterator<std::string>(names), {}};
}

/// What the environment asks for, or the best; empty if that cannot be, which has been said.
std::string chosen_arch() {
  const std::vector<std::string> archs = installed_archs();
  if (const char* wanted = std::getenv("SPHDROP_ARCH"); wanted != nullptr && *wanted != '\0') {
    if (std::find(archs.begin(), archs.end(), wanted) == archs.end()) {
      std::fprintf(stderr, "sphdrop: SPHDROP_ARCH=%s: installed for %s\n", wanted, SPHDROP_ARCHS);
      return {};
    }
    if (!processor_has(wanted)) {
      std::fprintf(stderr, "sphdrop: SPHDROP_ARCH=%s: the processor does not have all of these instructions\n", wanted);
      return {};
    }
    return wanted;
  }
  return *std::find_if(archs.rbegin(), archs.rend(), processor_has);
}

}  // namespace

int main(int, char** argv) {
  const std::string arch = chosen_arch();
  if (arch.empty()) return user_mistake;
  std::error_code error;
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  const std::filesystem::path program = here / SPHDROP_PROGRAMS / arch / "sphdrop";
  if (!error) {
    ::execv(program.c_str(), argv);
    error.assign(errno, std::generic_category());
  }
  std::fprintf(stderr, "sphdrop: cannot start %s: %s\n", program.c_str(), error.message().c_str());
  return internal_error;
}
