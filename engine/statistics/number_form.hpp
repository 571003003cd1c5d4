// SPDX-License-Identifier: GPL-3.0-or-later
// Decimal and thousands signs of a file. "1,250" is ambiguous; another number, such as "0,5" or "1.250,5",
// decides.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/files/text_table.hpp"

namespace asperity {

struct NumberForm {
  char decimal = '.';
  char thousands = '\0';  // ' ': any blank
};

// Otherwise like read_cell. Thousands must form groups of three throughout.
TextCell read_number(std::string_view text, const NumberForm& form);

// With decimal point, without thousands signs; nothing if not in this form.
std::optional<std::string> plain_number(std::string_view text, const NumberForm& form);

bool looks_like_a_number(std::string_view cell);

class NumberEvidence {
 public:
  // Known signs; '\0' for unknown.
  NumberEvidence(char decimal, char thousands) : decimal_(decimal), thousands_(thousands) {}
  // Ignores cells that are no numbers.
  void add(std::string_view cell, const std::string& place);
  NumberForm form() const;
  // An ambiguous or contradictory number, if any.
  struct Doubt {
    std::string place, finding;
  };
  std::optional<Doubt> doubt() const;

 private:
  void prove(char& sign, char found, std::string_view text, const std::string& place);

  char decimal_, thousands_;
  Doubt contradiction_;
  std::map<char, Doubt> unclear_;  // first number with this possible thousands sign
};

}  // namespace asperity
