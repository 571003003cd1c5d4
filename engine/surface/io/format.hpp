// SPDX-License-Identifier: GPL-3.0-or-later
// The formats of measured topographies: one record a format, one source file a record. A reader
// recognises a file by its content and takes its numbers out as they stand; what they mean in
// metres, and what becomes of holes, is decided in one place for all formats (read.cpp).
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

// The line of a map that a file stores first. Our maps have y upwards: j = 0 is the lowest line.
enum class FirstLine { bottom, top };
struct LineOrder {
  FirstLine first = FirstLine::bottom;
  std::string_view source;  // the specification or program that decides, a sentence
};

// What stands in a file.
struct HeightMap {
  Field heights;                         // the numbers, line by line as stored; NaN: a missing point
  std::optional<double> unit;            // m per number, if the file says
  std::optional<double> size_x, size_y;  // nodes times spacing; m, or numbers if size_in_units
  bool size_in_units = false;            // the file holds positions: lengths are in position_unit
  std::optional<double> position_unit;   // m per number of a position, if the file says
  bool named_columns = false;            // the units stand in the line that names the columns
  bool pairs = false;                    // two columns, position and height, as that line says
  bool trace = false;                    // one line of samples: ny = 1, and no size_y of its own
  std::optional<double> spacing;         // m between the samples of a trace, where a file states it
  std::optional<double> closed_radius;   // m, of a closed outline
  std::optional<FirstLine> first_line;   // where the file's head decides, and not its format (Format::lines)
};

// What the list of formats says of one (help, docs/reference.md): a short sentence each.
struct FormatAccount {
  std::string_view read;     // whose format it is, and what of it becomes a surface
  std::string_view refused;  // what of it is not read
  std::string_view checked;  // the public files or programs compared; where there were none, it says so
};

struct Format {
  std::string_view name;   // as in `format = "npy"`
  std::string_view marks;  // what it is known by, for errors
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

// Those that others name.
const Format& stylus_csv_format();
const Format& xyz_format();
const Format& text_format();

// Whether a text of three columns without any mark looks like x y z triples of a lattice with some
// points missing or given more than once, which a matrix of three columns could be as well.
bool almost_triples(const SourceFile& file);

// Whether such a text is so long, and its first two columns so rarely say the same again, that points are
// likelier than a map three columns wide.
bool many_triples(const SourceFile& file);

// Whether such a text could be what is left of a lattice after any of its points were taken out, by their
// places alone: no point is given twice, and the places are those of a small lattice, of which one is met
// again, or which come in the order of a scan. A single line could be a point too, or three heights: it is
// not asked here.
bool may_be_triples(const SourceFile& file);

// The first format with this extension (lower case, without dot); null if there is none.
const Format* format_of_extension(std::string_view extension);

// All of them, in the order in which they are tried: the most particular marks first.
std::span<const Format* const> formats();

// The format called `forced`, or else the first that recognises the content, or else the one of the
// extension, which decides for x y z where the content is a table. Throws Error{unknown_name} for a `format`
// that does not exist and Error{bad_file} when nothing fits, naming what the file is (foreign_format.hpp) or
// what was looked for, or when a table may be a matrix or almost_triples(), many_triples() or
// may_be_triples().
const Format& choose_format(const SourceFile& file, const std::string& forced);

}  // namespace asperity
