#include <iostream>

#include "bad_cases.hpp"

int main() {
  for (const auto& bad : sphdrop::testing::bad_cases()) {
    std::cout << bad.kind << " ->\n";
    for (const std::string& message : sphdrop::testing::messages_for(bad)) std::cout << "  " << message << "\n";
  }
}
