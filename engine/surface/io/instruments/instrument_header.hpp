// SPDX-License-Identifier: GPL-3.0-or-later
// Shared by readers of scanning-probe files: header numbers, with errors that name the key, and the choice
// among several maps.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/grid.hpp"

namespace asperity {

// The next three functions throw Error{bad_file} unless the text is a count from 0 on, a finite number, or a
// positive length such as "500 nm", "20\xB5m", "10 ~m"; a length is returned in m.
std::uint64_t instrument_count(const SourceFile& file, std::string_view key, std::string_view text);
double instrument_number(const SourceFile& file, std::string_view key, std::string_view text);
double instrument_length(const SourceFile& file, std::string_view key, std::string_view text);
// Metres per unit: length_unit(), plus "~m" for um, and um and angstrom in UTF-8 or Latin-1. None for other
// dimensions, "A" (ampere) and several words.
std::optional<double> instrument_length_unit(std::string_view text);

struct NamedMap {
  std::string name;
  bool heights = false;  // candidate if the call names no map
};

// Appends " (2)", " (3)" to repeated names. O(n log n).
void tell_apart(std::vector<NamedMap>& maps);
// First appends `more[k]` (Trace, Retrace) to shared names.
void tell_apart_by(std::vector<NamedMap>& maps, const std::vector<std::string>& more);

// Index of the map `channel`; if empty, of the only map of heights. Throws Error{bad_file}, listing the
// maps, if none or several match.
std::size_t chosen_map(const SourceFile& file, const std::vector<NamedMap>& maps, const std::string& channel);

[[noreturn]] void refuse_no_heights(const SourceFile& file, const NamedMap& map, const std::string& unit);

Field lines_reversed(const Field& heights);

}  // namespace asperity
