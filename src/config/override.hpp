#pragma once
// "key=value" from the command line.

#include <cstddef>
#include <string>

#include "config/toml_source.hpp"

namespace sphdrop {

struct Override {
  std::string key;        ///< "drop.diameter" for "drop[2].diameter" too
  std::size_t index = 0;  ///< which of several drops or solids: 0, 1, ...
  TomlNode value;
  std::string mistake;  ///< "" if the key is known and the value readable; its type and range are not checked here
};

/// The value is TOML; quotes round a word or a text may be left out, as shells take them away.
Override parse_override(const std::string& text);

}  // namespace sphdrop
