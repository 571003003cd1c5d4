// SPDX-License-Identifier: GPL-3.0-or-later
// The formats of measured topographies: one record a format, one source file a record. A reader recognises a
// file by its content and returns its numbers unchanged. For all formats, read.cpp converts them to metres
// and treats missing points.
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

// The first line of a map in a file. Our maps have y upwards: j = 0 is the lowest line.
enum class FirstLine { bottom, top };
struct LineOrder {
  FirstLine first = FirstLine::bottom;
  std::string_view source;  // the deciding specification or program, a sentence
};

// The content of a file.
struct HeightMap {
  Field heights;                         // the numbers, line by line as stored; NaN: a missing point
  std::optional<double> unit;            // m per number, if the file says
  std::optional<double> size_x, size_y;  // nodes times spacing; m, or numbers if size_in_units
  bool size_in_units = false;            // the file holds positions: lengths are in position_unit
  std::optional<double> position_unit;   // m per number of a position, if the file says
  bool named_columns = false;            // the units stand in the line that names the columns
  bool pairs = false;                    // two columns, position and height, as that line says
  bool trace = false;                    // one line of samples: ny = 1, without size_y
  std::optional<double> spacing;         // m between the samples of a trace, where a file states it
  std::optional<double> closed_radius;   // m, of a closed outline
  std::optional<FirstLine> first_line;   // where the file's head decides, and not its format (Format::lines)
};

// Description of a format for help and docs/reference.md: a short sentence each.
struct FormatAccount {
  std::string_view read;     // owner of the format, and its part that becomes a surface
  std::string_view refused;  // unread parts of the format
  std::string_view checked;  // the public files or programs compared; where there were none, it says so
};

struct Format {
  std::string_view name;   // as in `format = "npy"`
  std::string_view marks;  // its recognising marks, for errors
  FormatAccount account;
  LineOrder lines;
  std::vector<std::string_view> extensions;    // lower case, without dots
  bool (*recognises)(const SourceFile& file);  // by content alone; never throws but for a stop
  // Throws Error{bad_file} for whatever is not as the format wants it. Allocates no more than a
  // fixed multiple of the file's size.
  HeightMap (*read)(const SourceFile& file, Monitor& monitor);
  // Instead of it in a format whose files hold several maps: reads the map called `channel`, or the one that
  // the format's account names where that is empty; null for the others.
  HeightMap (*read_channel)(const SourceFile& file, const std::string& channel, Monitor& monitor) = nullptr;
};

// Puts the last line first.
void turn_over(Field& field);

// Formats named elsewhere by their function.
const Format& stylus_csv_format();
const Format& xyz_format();
const Format& text_format();

// Whether a text of three columns without any mark looks like x y z triples of a lattice with some
// points missing or given more than once, which a matrix of three columns could be as well.
bool almost_triples(const SourceFile& file);

// Whether such a text is so long, and its first two columns so rarely say the same again, that points are
// likelier than a map three columns wide.
bool many_triples(const SourceFile& file);

// Whether the places in such a text fit a lattice with missing points: no point is given twice, and the
// places are on a small lattice and either repeat a coordinate or follow the order of a scan. Not for a
// single line, which could be a point or three heights.
bool may_be_triples(const SourceFile& file);

// The first format with this extension (lower case, without dot); null if there is none.
const Format* format_of_extension(std::string_view extension);

// All formats in the order of trying: the most particular marks first.
std::span<const Format* const> formats();

// The format called `forced`, or else the first that recognises the content, or else the one of the
// extension, which decides for x y z where the content is a table. Throws Error{unknown_name} for a `format`
// that does not exist and Error{bad_file} when nothing fits, naming what the file is (foreign_format.hpp) or
// what was looked for, or when a table may be a matrix or almost_triples(), many_triples() or
// may_be_triples().
const Format& choose_format(const SourceFile& file, const std::string& forced);

}  // namespace asperity
