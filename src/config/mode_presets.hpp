#pragma once
// What a mode chooses for parameters that the case leaves to themselves.

#include <optional>
#include <span>
#include <string_view>

#include "config/case.hpp"

namespace sphdrop {

struct Preset {
  std::string_view key;
  std::string_view value;        ///< as TOML
  std::string_view restriction;  ///< in words, after the value; "" where it holds for whatever the parameter is of
  bool (*applies)(const Case&);  ///< of the case without presets; where it does not, the common default stays
};

/// Of mode "modern" (method.md, 2b, 3c, 5); mode "paper" is made of the common defaults.
std::span<const Preset> modern_presets();

/// The preset of a parameter; nullptr if there is none.
const Preset* modern_preset(std::string_view key);

}  // namespace sphdrop
