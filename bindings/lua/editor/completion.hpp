// SPDX-License-Identifier: GPL-3.0-or-later
// Completion in an unfinished script: modules, functions, methods, fields, missing keys of a table, accepted
// words, units, materials, variables, keywords. Candidates come from the registry and the text
// (script_types.hpp); no code runs. Without type information there are no candidates. Linear in the length of
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
  // "module"; "method" (also functions); "key" of a call's table; "value" (words of a string, constants,
  // fields); "keyword"; "global" (any variable).
  std::string kind;
  std::string detail;  // signature, or type, unit and default, on one line; may be empty
  std::string help;    // a sentence; may be empty
};

struct Completion {
  std::size_t from = 0;  // first byte of the replaced word, which ends at `position`
  std::vector<Candidate> candidates;
};

// Candidates at byte `position`, at most the end of the text. Matching is case-sensitive unless nothing
// matches.
Completion complete(std::string_view text, std::size_t position);
// At a prompt: also globals that exist only in the Lua state.
Completion complete(std::string_view text, std::size_t position, const std::vector<LiveGlobal>& live);

}  // namespace asperity::lua
