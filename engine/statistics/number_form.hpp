// SPDX-License-Identifier: GPL-3.0-or-later
// How the numbers of a file are written: which sign is the decimal one, and whether one parts thousands.
// "1,250" is one and a quarter or a thousand and more; a file tells which where another of its numbers can be
// read in one way only, as "0,5" and "1.250,5" can.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/core/files/text_table.hpp"

namespace asperity {

struct NumberForm {
  char decimal = '.';
  char thousands = '\0';  // ' ' stands for all blanks that part digits
};

// The number of a cell that is written so; what else it holds as read_cell tells. Thousands are parted in
// groups of three throughout, or the cell is unreadable.
TextCell read_number(std::string_view text, const NumberForm& form);

// The same text with a decimal point and without what parts thousands; nothing where it is not written so.
std::optional<std::string> plain_number(std::string_view text, const NumberForm& form);

// What the numbers of a file tell of their form, one after another.
// The signs of a number in ASCII: blanks, apostrophes and the minus of typesetters.
std::string with_plain_signs(std::string_view text);

// Whether a cell is a finite number, whichever signs it has for decimals and thousands.
bool looks_like_a_number(std::string_view cell);

class NumberEvidence {
 public:
  // What is said of the form beforehand; '\0' for nothing.
  NumberEvidence(char decimal, char thousands) : decimal_(decimal), thousands_(thousands) {}
  // A cell, and where it stands. What is no number tells nothing.
  void add(std::string_view cell, const std::string& place);
  NumberForm form() const;
  // A sentence with the place of a number that can be read in two ways, or of one that is written otherwise
  // than one before it; nothing where all is clear.
  struct Doubt {
    std::string place, finding;
  };
  std::optional<Doubt> doubt() const;

 private:
  void prove(char& sign, char found, std::string_view text, const std::string& place);

  char decimal_, thousands_;
  Doubt unclear_comma_, unclear_point_, unclear_blank_, unclear_apostrophe_, contradiction_;
};

}  // namespace asperity
