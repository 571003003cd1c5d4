// SPDX-License-Identifier: GPL-3.0-or-later
// What may come next in a script that is being written: modules and their functions, methods and fields of
// values, keys of a call's table that are not yet there, the words that a key or parameter accepts, units,
// names of materials, variables and Lua's own words. All of it comes from the registry and from the text
// alone (script_types.hpp); nothing is run. The script need not be finished; where nothing is known there
// are no candidates. Linear in the length of the text; any thread may call it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/editor/script_types.hpp"

namespace asperity::lua {

struct Candidate {
  std::string text;
  // "module"; "method" (functions too); "key" of a call's table; "value" (words of a string, constants,
  // fields); "keyword"; "global" (any variable).
  std::string kind;
  std::string detail;  // signature, or type, unit and default, on one line; may be empty
  std::string help;    // a sentence; may be empty
};

struct Completion {
  std::size_t from = 0;  // byte at which the word begins that a candidate replaces, up to `position`
  std::vector<Candidate> candidates;
};

// Candidates that go on with what stands before `position`, a number of bytes (beyond the end of the text
// it means the end). Names are compared by case unless nothing fits so.
Completion complete(std::string_view text, std::size_t position);
// The same at a prompt, where globals live that no text tells of.
Completion complete(std::string_view text, std::size_t position, const std::vector<LiveGlobal>& live);

}  // namespace asperity::lua
