// SPDX-License-Identifier: GPL-3.0-or-later
// The formats of measured topographies. A reader recognises a file by content and returns its numbers
// unchanged; read.cpp converts them to metres.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/files/source_file.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// First line of a file. In our maps j = 0 is the lowest line.
enum class FirstLine { bottom, top };
struct LineOrder {
  FirstLine first = FirstLine::bottom;
  std::string_view source;  // specification or program, a sentence
};

struct HeightMap {
  Field heights{};                           // numbers as stored; NaN: missing
  std::optional<double> unit{};              // m per number
  std::optional<double> size_x{}, size_y{};  // nodes times spacing; m, or numbers if size_in_units
  bool size_in_units = false;                // lengths are in position_unit
  std::optional<double> position_unit{};     // m per number of a position
  bool named_columns = false;                // units from column names
  bool pairs = false;                        // columns position and height
  bool trace = false;                        // one line: ny = 1, without size_y
  std::optional<double> spacing{};           // m between samples
  std::optional<double> closed_radius{};     // m, of a closed outline
  std::optional<FirstLine> first_line{};     // overrides Format::lines
};

// For help and docs/reference.md.
struct FormatAccount {
  std::string_view read;     // owner and readable part
  std::string_view refused;  // unread parts
  std::string_view checked;  // files or programs compared
};

// Lower case, no dots.
struct Extensions {
  std::array<std::string_view, 5> names{};
  constexpr auto begin() const { return names.begin(); }
  constexpr auto end() const { return std::ranges::find(names, ""); }
};

struct Format {
  std::string_view name;   // as in `format = "npy"`
  std::string_view marks;  // as errors show them
  FormatAccount account;
  LineOrder lines;
  Extensions extensions;
  bool (*recognises)(const SourceFile& file);  // by content; throws only for a stop
  // Throws Error{bad_file}. Allocates at most a fixed multiple of the file's size.
  HeightMap (*read)(const SourceFile& file, Monitor& monitor);
  // Replaces `read` if files hold several maps; empty `channel`: the default.
  HeightMap (*read_channel)(const SourceFile& file, const std::string& channel, Monitor& monitor) = nullptr;
  bool reads_unrecognised = false;  // by request or extension
};

template <const std::string_view& mark>
bool begins_with(const SourceFile& file) {
  return file.bytes().starts_with(mark);
}

void turn_over(Field& field);

extern const Format stylus_csv_format, xyz_format, text_format;

// Throws Error{bad_file} if unmarked text of three columns may hold x y z points: a lattice with holes or
// duplicates, or scattered points on a hundred lines or more.
void refuse_uncertain_points(const SourceFile& file);

// Lower case, without dot; null if unknown.
const Format* format_of_extension(std::string_view extension);

// Most specific marks first.
std::span<const Format* const> formats();

// By `forced`, else by content, else by extension; for tables, the extension of x y z also decides. Throws
// Error{unknown_name} for an unknown `forced`, and Error{bad_file} if nothing fits, or if the file lacks the
// marks of a format other than `reads_unrecognised`.
const Format& choose_format(const SourceFile& file, const std::string& forced);

}  // namespace asperity
