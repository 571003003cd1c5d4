// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/length_unit.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/quantity.hpp"

namespace asperity {

std::optional<double> length_unit(std::string_view text) {
  std::string plain = lower_case(trimmed(text));
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return c == '(' || c == ')' || c == '[' || c == ']'; }, ' ');
  const std::vector<std::string_view> words = cells_of(plain, Separator::blank);
  if (words.empty()) return {};
  std::string_view last = words.back();
  if (last.size() > 2 && last.ends_with('s')) last.remove_suffix(1);
  if (last == "micrometer" || last == "micrometre" || last == "micron" || last == "\xB5m") return 1e-6;
  if (last == "nanometer" || last == "nanometre") return 1e-9;
  if (last == "millimeter" || last == "millimetre") return 1e-3;
  if (last == "meter" || last == "metre") return 1.0;
  if (last == "angstrom" || last == "\xC5" || last == "a") return 1e-10;
  try {
    const Quantity unit = parse_unit(last);
    if (unit.dimension == dimension::length) return unit.value;
  } catch (const Error&) {  // unknown unit
  }
  return {};
}

}  // namespace asperity
