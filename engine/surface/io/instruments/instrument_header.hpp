// SPDX-License-Identifier: GPL-3.0-or-later
// What the readers of scanning probes' files share: numbers out of the texts of a header, each with the error
// that names its key, and the choice among the maps that one file holds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/grid.hpp"

namespace asperity {

// A whole number, zero or more. Throws Error{bad_file} for anything else.
std::uint64_t instrument_count(const SourceFile& file, std::string_view key, std::string_view text);
// A finite number. Throws Error{bad_file} for anything else.
double instrument_number(const SourceFile& file, std::string_view key, std::string_view text);
// A number above zero and, after a blank or directly, a unit of length: "500 nm", "20\xB5m", "10 ~m"; in m.
// Throws Error{bad_file} for anything else.
double instrument_length(const SourceFile& file, std::string_view key, std::string_view text);
// Metres in a unit of length as instruments write it: as length_unit(), "~m" for um, um and angstrom in UTF-8
// or Latin-1; none for another dimension, for "A", which is the ampere, and for several words.
std::optional<double> instrument_length_unit(std::string_view text);

// One map of several in a file, as its maker calls it.
struct NamedMap {
  std::string name;
  bool heights = false;  // taken where the call names none
};

// Adds " (2)", " (3)" to names that were there before, so that each is one. O(n log n).
void tell_apart(std::vector<NamedMap>& maps);
// The same, after `more[k]` is added to the names that several maps share: Trace, Retrace.
void tell_apart_by(std::vector<NamedMap>& maps, const std::vector<std::string>& more);

// The place of the map called `channel`; where that is empty, of the one that is of heights. Throws
// Error{bad_file} naming the maps where there is no such one, or where several are of heights.
std::size_t chosen_map(const SourceFile& file, const std::vector<NamedMap>& maps, const std::string& channel);

// Says that this map is in `unit`, as its file has it, which is no unit of length. Throws Error{bad_file}.
[[noreturn]] void refuse_no_heights(const SourceFile& file, const NamedMap& map, const std::string& unit);

// The same heights with each line from its other end.
Field lines_reversed(const Field& heights);

}  // namespace asperity
