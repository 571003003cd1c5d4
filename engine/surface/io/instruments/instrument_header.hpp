// SPDX-License-Identifier: GPL-3.0-or-later
// Shared by the readers of instrument files: numbers of text headers, and the choice among several maps.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/text_table.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"

namespace asperity {

// The next three functions throw Error{bad_file} unless the text is a count from 0 on, a finite number, or a
// positive length such as "500 nm", "10 ~m", in m.
std::uint64_t instrument_count(const SourceFile& file, std::string_view key, std::string_view text);
double instrument_number(const SourceFile& file, std::string_view key, std::string_view text);
double instrument_length(const SourceFile& file, std::string_view key, std::string_view text);
// length_unit(), plus "~m" for um, and um and angstrom in UTF-8 or Latin-1. None for "A" (ampere) and several
// words.
std::optional<double> instrument_length_unit(std::string_view text);

// Keys and values in text. The first of equal keys counts. text() to length() throw Error{bad_file} for a
// missing or unreadable entry.
class HeaderEntries {
 public:
  explicit HeaderEntries(const SourceFile& file) : file_(&file) {}
  void add(std::string_view key, std::string_view value) { entries_.emplace(key, value); }
  // The last of equal keys counts.
  void replace(std::string_view key, std::string_view value) { entries_[std::string(key)] = value; }
  std::optional<std::string_view> find(std::string_view key) const;
  const std::map<std::string, std::string, std::less<>>& all() const { return entries_; }

  std::string_view text(std::string_view key) const;
  std::uint64_t count(std::string_view key) const;
  double number(std::string_view key) const;
  double decimal(std::string_view key) const;  // also with a decimal comma; NaN for "nan", "bad" …
  // In m; `unit` follows the text.
  double length(std::string_view key, std::string_view unit = {}) const;

 private:
  const SourceFile* file_;
  std::map<std::string, std::string, std::less<>> entries_;
};

struct NamedMap {
  std::string name;
  bool heights = false;  // candidate if the call names no map
};

// Appends " (2)", " (3)" to repeated names. O(n log n).
void tell_apart(std::vector<NamedMap>& maps);
// First appends `more[k]` (Trace, Retrace) to shared names.
void tell_apart_by(std::vector<NamedMap>& maps, const std::vector<std::string>& more);

// Index of the map `channel`; if empty, of the only map of heights. Throws Error{bad_file} if none or several
// match.
std::size_t chosen_map(const SourceFile& file, const std::vector<NamedMap>& maps, const std::string& channel);

[[noreturn]] void refuse_no_heights(const SourceFile& file, const NamedMap& map, const std::string& unit);

}  // namespace asperity
