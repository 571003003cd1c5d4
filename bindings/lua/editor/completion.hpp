// SPDX-License-Identifier: GPL-3.0-or-later
// Completion in an unfinished script: names, fields, missing keys, accepted words, units, materials,
// keywords. Sources are the registry and the text (script_types.hpp); no code runs. Linear in the length of
// the text; thread-safe.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/editor/script_types.hpp"

namespace asperity::lua {

struct Candidate {
  std::string text;
  // "module"; "method" (also functions); "key"; "value" (words, constants, fields); "keyword"; "global" (any
  // variable).
  std::string kind;
  std::string detail;  // signature, or type, unit and default; may be empty
  std::string help;    // may be empty
};

struct Completion {
  std::size_t from = 0;  // start of the replaced word, which ends at `position`
  std::vector<Candidate> candidates;
};

// `position` in bytes, clamped to the end. Ignores case if nothing matches.
Completion complete(std::string_view text, std::size_t position);
// With globals of the Lua state of a prompt.
Completion complete(std::string_view text, std::size_t position, const std::vector<LiveGlobal>& live);

}  // namespace asperity::lua
