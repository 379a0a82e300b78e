#pragma once
// What a mode chooses for parameters that the case leaves to themselves.

#include <optional>
#include <span>
#include <string_view>

#include "config/case.hpp"

namespace sphdrop {

struct Preset {
  Mode mode;  ///< of this mode and those after it; of several presets of a parameter the last one holds
  std::string_view key;
  std::string_view value;        ///< as TOML
  std::string_view restriction;  ///< in words, after the value; "" where it holds for whatever the parameter is of
  bool (*applies)(const Case&);  ///< of the case without presets; where it does not, the common default stays
};

/// Of mode "modern" (method.md, 2b, 3c, 5) and of mode "fast", which adds the longest steps (method.md, 4); mode
/// "paper" is made of the common defaults.
std::span<const Preset> mode_presets();

}  // namespace sphdrop
