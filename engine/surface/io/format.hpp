// SPDX-License-Identifier: GPL-3.0-or-later
// The formats of measured topographies: one record and one source file each. A reader recognises a file by
// content and returns its numbers unchanged. read.cpp converts them to metres and treats missing points.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

// Place of the first line of a file. In our maps y points up: j = 0 is the lowest line.
enum class FirstLine { bottom, top };
struct LineOrder {
  FirstLine first = FirstLine::bottom;
  std::string_view source;  // specification or program, a sentence
};

struct HeightMap {
  Field heights;                         // numbers as stored; NaN: missing
  std::optional<double> unit;            // m per number
  std::optional<double> size_x, size_y;  // nodes times spacing; m, or numbers if size_in_units
  bool size_in_units = false;            // lengths are in position_unit
  std::optional<double> position_unit;   // m per number of a position
  bool named_columns = false;            // units from the line of column names
  bool pairs = false;                    // columns position and height
  bool trace = false;                    // one line: ny = 1, without size_y
  std::optional<double> spacing;         // m between samples
  std::optional<double> closed_radius;   // m, of a closed outline
  std::optional<FirstLine> first_line;   // overrides Format::lines
};

// For help and docs/reference.md.
struct FormatAccount {
  std::string_view read;     // owner and readable part
  std::string_view refused;  // unread parts
  std::string_view checked;  // files or programs compared
};

struct Format {
  std::string_view name;   // as in `format = "npy"`
  std::string_view marks;  // as errors show them
  FormatAccount account;
  LineOrder lines;
  std::vector<std::string_view> extensions;    // lower case, no dots
  bool (*recognises)(const SourceFile& file);  // by content; throws only for a stop
  // Throws Error{bad_file} for violations of the format. Allocates at most a fixed multiple of the file's
  // size.
  HeightMap (*read)(const SourceFile& file, Monitor& monitor);
  // Replaces `read` if files hold several maps; reads the map `channel`, or the default if empty.
  HeightMap (*read_channel)(const SourceFile& file, const std::string& channel, Monitor& monitor) = nullptr;
};

void turn_over(Field& field);

const Format& stylus_csv_format();
const Format& xyz_format();
const Format& text_format();

// True if unmarked three-column text resembles x y z triples with missing or duplicate points.
bool almost_triples(const SourceFile& file);

// True for 100 lines or more with seldom repeated x and y: a map three columns wide is then unlikely.
bool many_triples(const SourceFile& file);

// True if such text fits a lattice with missing points: no duplicates, a small lattice, and a repeated
// coordinate or the order of a scan. False for a single line.
bool may_be_triples(const SourceFile& file);

// Throws Error{bad_file} with `finding` unless `recognised`.
void require_format(const SourceFile& file, bool recognised, const char* finding);

// Lower case, without dot; null if unknown.
const Format* format_of_extension(std::string_view extension);

// Most specific marks first.
std::span<const Format* const> formats();

// The format named `forced`, else by content, else by extension; for tables, the extension of x y z also
// decides. Throws Error{unknown_name} for an unknown `forced`, and Error{bad_file} if nothing fits or a
// table is ambiguous.
const Format& choose_format(const SourceFile& file, const std::string& forced);

}  // namespace asperity
