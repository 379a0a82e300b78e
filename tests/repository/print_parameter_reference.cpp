// Prints the reference of all parameters, as it stands in cases/README.md.
#include <cstdio>

#include "config/parameter_listing.hpp"

int main() {
  return std::fputs(sphdrop::parameter_reference_markdown().c_str(), stdout) < 0 ? 1 : 0;
}
