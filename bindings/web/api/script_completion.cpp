// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/api/script_completion.hpp"

#include <algorithm>

#include "bindings/lua/editor/completion.hpp"
#include "bindings/web/api/positions.hpp"

namespace asperity::web {

namespace {

// How deep brackets stand in brackets, whatever else the text is. What is read of a script goes down with
// them, and the stack of a thread is not without end.
std::size_t deepest_bracket(const std::string& text) {
  std::size_t depth = 0, deepest = 0;
  for (const char c : text) {
    if (c == '(' || c == '{' || c == '[') deepest = std::max(deepest, ++depth);
    if ((c == ')' || c == '}' || c == ']') && depth > 0) --depth;
  }
  return deepest;
}

}  // namespace

Json completion_of(const std::string& text, std::size_t unit) {
  std::size_t from = byte_of_unit(text, unit);
  Json::List candidates;
  // Nobody writes so long a script by hand.
  constexpr std::size_t longest = std::size_t{256} << 10;
  constexpr std::size_t deepest = 500;
  if (text.size() > longest || deepest_bracket(text) > deepest)
    return Json::object({{"from", unit}, {"candidates", candidates}});
  const lua::Completion completion = lua::complete(text, from);
  from = completion.from;
  for (const lua::Candidate& candidate : completion.candidates)
    candidates.push_back(Json::object({{"text", candidate.text},
                                       {"kind", candidate.kind},
                                       {"detail", candidate.detail},
                                       {"help", candidate.help}}));
  return Json::object({{"from", unit_of_byte(text, from)}, {"candidates", std::move(candidates)}});
}

}  // namespace asperity::web
