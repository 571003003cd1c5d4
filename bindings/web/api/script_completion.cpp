// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "bindings/lua/editor/completion.hpp"
#include "bindings/web/runs/answers.hpp"

namespace asperity::web {

namespace {

// UTF-16 units of the character at this byte; 0 for a continuation byte.
std::size_t units_of(char byte) {
  const auto bits = static_cast<unsigned char>(byte);
  return (bits & 0xC0) == 0x80 ? 0 : bits >= 0xF0 ? 2 : 1;
}

// Brackets in strings and comments count, too. The parser recurses with brackets, and a thread's stack is
// finite.
std::size_t deepest_bracket(const std::string& text) {
  std::size_t depth = 0, deepest = 0;
  for (const char c : text) {
    if (c == '(' || c == '{' || c == '[') deepest = std::max(deepest, ++depth);
    if ((c == ')' || c == '}' || c == ']') && depth > 0) --depth;
  }
  return deepest;
}

}  // namespace

std::size_t byte_of_unit(std::string_view text, std::size_t unit) {
  std::size_t before = 0, begin = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const std::size_t units = units_of(text[k]);
    if (units == 0) continue;
    begin = k;
    if (before + units > unit) return begin;
    before += units;
  }
  return text.size();
}

std::size_t unit_of_byte(std::string_view text, std::size_t byte) {
  std::size_t units = 0;
  for (std::size_t k = 0; k < std::min(byte, text.size()); ++k) units += units_of(text[k]);
  return units;
}

Json completion_of(const std::string& text, std::size_t unit) {
  std::size_t from = byte_of_unit(text, unit);
  Json::List candidates;
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
