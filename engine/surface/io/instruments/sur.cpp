// SPDX-License-Identifier: GPL-3.0-or-later
// SUR of Digital Surf (MountainsMap): header, comment, private zone, then 16- or 32-bit integers, in several
// pieces of zlib if compressed. Height = number · spacing + offset in the unit of the z axis. A missing point
// is the least number minus 2. Only the first object is read. Layout: Gwyddion's, RosettaSciIO's and
// (compression) surfalize's readers.
#include "engine/core/require.hpp"
#include "engine/surface/io/column_head.hpp"
#include "engine/surface/io/instruments/instrument_header.hpp"
#include "engine/surface/io/write.hpp"

namespace asperity {

namespace {

constexpr std::string_view plain_mark = "DIGITAL SURF", compressed_mark = "DSCOMPRESSED";
constexpr std::size_t sur_header_bytes = 512;

struct SurAxis {
  double spacing;
  std::optional<double> unit;
  std::string word;  // as written
};

struct SurHeader {
  int objects = 0, type = 0, bits = 0;
  bool special = false;
  std::int32_t least = 0;
  std::int64_t nx = 0, ny = 0;
  std::array<SurAxis, 3> axes;
  double offset = 0;
  bool packed = false;
  std::size_t data_at = 0;
};

SurHeader read_header(const SourceFile& file) {
  SurHeader header;
  header.packed = file.bytes().starts_with(compressed_mark);
  BinaryCursor cursor(file, file.bytes(), "its header of 512 bytes");
  cursor.skip(plain_mark.size());
  const int order = cursor.number<std::int16_t>();
  if (order != 0)
    refuse_file(file, "is a SUR file of an Apple computer (format " + std::to_string(order) + ")",
                "save it again on another computer");
  header.objects = cursor.number<std::uint16_t>();
  cursor.skip(2);
  header.type = cursor.number<std::int16_t>();
  cursor.skip(30 + 30 + 2 + 2 + 2);
  header.special = cursor.number<std::int16_t>() != 0;
  cursor.skip(2 + 8);
  header.bits = cursor.number<std::int16_t>();
  header.least = cursor.number<std::int32_t>();
  cursor.skip(4);
  header.nx = cursor.number<std::int32_t>();
  header.ny = cursor.number<std::int32_t>();
  cursor.skip(4);
  for (SurAxis& axis : header.axes) axis.spacing = std::abs(static_cast<double>(cursor.number<float>()));
  cursor.skip(3 * 16);
  for (SurAxis& axis : header.axes) {
    axis.word = std::string(cursor.text(16));
    axis.unit = length_unit(axis.word);
  }
  cursor.skip(3 * 16 + 3 * 4 + 3 * 2 + 12 + 7 * 2 + 4 + 10);
  const std::size_t comment = cursor.number<std::uint16_t>(), own = cursor.number<std::uint16_t>();
  cursor.skip(128 + 2 * 4);
  header.offset = static_cast<double>(cursor.number<float>());
  cursor.skip(sur_header_bytes - cursor.position());
  cursor.skip(comment);
  cursor.skip(own);
  header.data_at = cursor.position();
  return header;
}

struct SurPieces {
  Array<char> bytes;
  std::string_view rest;
};

SurPieces unpack_pieces(const SourceFile& file, std::string_view data, std::uint64_t wanted) {
  BinaryCursor cursor(file, data, "the lengths of its compressed pieces");
  const std::size_t count = cursor.number<std::uint32_t>();
  constexpr std::size_t entry = 8;
  if (count == 0 || count > cursor.left() / entry)
    refuse_file(file, "says that its heights are compressed in " + std::to_string(count) + " pieces",
                "its header is wrong or the file is cut short");
  BinaryCursor pieces(file, data, "its compressed heights");
  pieces.skip(cursor.position() + count * entry);
  SurPieces found;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint64_t plain = cursor.number<std::uint32_t>(), packed = cursor.number<std::uint32_t>();
    const std::string_view piece = pieces.take(packed);
    if (plain > wanted - found.bytes.size())
      refuse_file(file, "holds more compressed heights than its header says",
                  "its header is wrong or the file is damaged");
    const Array<char> bytes = inflated(file, piece, plain, "its heights");
    if (count == 1) {
      found.bytes = bytes;
    } else {
      found.bytes.insert(found.bytes.end(), bytes.begin(), bytes.end());
    }
  }
  found.rest = data.substr(pieces.position());
  return found;
}

bool recognises_sur(const SourceFile& file) {
  return file.bytes().starts_with(plain_mark) || file.bytes().starts_with(compressed_mark);
}

std::uint64_t side(std::int64_t count) { return count < 0 ? 0 : static_cast<std::uint64_t>(count); }

// `rest`: bytes after the compressed heights.
void check_end(const SourceFile& file, const SurHeader& header, std::string_view data,
               std::string_view rest) {
  const std::uint64_t width = static_cast<std::uint64_t>(header.bits) / 8, nx = side(header.nx),
                      ny = side(header.ny);
  if (header.objects > 1) {
    require_numbers(file, nx, ny, width, data.size());
    const std::string_view next = header.packed ? rest : data.substr(nx * ny * width);
    if (!next.empty() && !next.starts_with(plain_mark) && !next.starts_with(compressed_mark))
      refuse_file(file,
                  "holds " + std::to_string(header.objects) + " objects, and no second one after the " +
                      std::to_string(header.nx) + " x " + std::to_string(header.ny) + " heights of the first",
                  "its header is wrong or the file is damaged");
  } else {
    require_exactly(file, nx, ny, width, data.size());
    if (!rest.empty())
      refuse_file(file, "has " + std::to_string(rest.size()) + " bytes after its compressed heights",
                  "its header is wrong or the file is damaged");
  }
}

HeightMap read_sur(const SourceFile& file, Monitor& monitor) {
  const SurHeader header = read_header(file);
  // 1: profile, 2: surface, 4 and 5: series.
  if (header.type == 3 || header.type < 1 || header.type > 5)
    refuse_file(file, "holds an object of type " + std::to_string(header.type) + ", which is no surface",
                "surfaces and profiles are read: types 1, 2, 4 and 5");
  if (header.bits != 16 && header.bits != 32)
    refuse_file(file, "holds points of " + std::to_string(header.bits) + " bits",
                "points of 16 and 32 bits are read");
  const std::uint64_t width = static_cast<std::uint64_t>(header.bits) / 8;
  std::string_view data = file.bytes().substr(header.data_at);
  SurPieces pieces;
  if (header.packed) {
    if (header.nx <= 0 || header.ny <= 0 ||
        side(header.nx) > data.size() * most_of_deflate / width / side(header.ny))
      refuse_file(file,
                  "says in its header that it holds " + std::to_string(header.nx) + " x " +
                      std::to_string(header.ny) + " heights, more than " + std::to_string(data.size()) +
                      " compressed bytes can hold",
                  "the file is cut short or its header is wrong");
    pieces = unpack_pieces(file, data, side(header.nx) * side(header.ny) * width);
    data = {pieces.bytes.data(), pieces.bytes.size()};
  }
  check_end(file, header, data, pieces.rest);
  const double missing = static_cast<double>(header.least) - 2;
  const auto is_missing = [&](double value) { return header.special && value == missing; };

  const auto& [x, y, z] = header.axes;
  if (!(z.spacing > 0) || !std::isfinite(z.spacing) || !std::isfinite(header.offset))
    refuse_file(file, "gives " + format_short(z.spacing) + " as the height of one step");
  HeightMap map;
  map.heights = field_of_numbers(width == 2 ? number_type<std::int16_t> : number_type<std::int32_t>, data,
                                 side(header.nx), side(header.ny), monitor, is_missing);
  const int nx = map.heights.nx(), ny = map.heights.ny();
  for (double& height : map.heights.values()) height = height * z.spacing + header.offset;
  if (!z.unit && !z.word.empty())
    monitor.warn(file_name(file.path()) + " gives its heights in " + shown(z.word) +
                 ", which is no unit of length");
  if (header.objects > 1)
    monitor.warn(file_name(file.path()) + " holds " + std::to_string(header.objects) +
                 " objects; the first is read");
  map.unit = z.unit;
  map.trace = ny == 1;
  if (x.unit && x.spacing > 0 && std::isfinite(x.spacing)) map.size_x = x.spacing * *x.unit * nx;
  if (!map.trace && y.unit && y.spacing > 0 && std::isfinite(y.spacing))
    map.size_y = y.spacing * *y.unit * ny;
  return map;
}

constexpr double millimetre = 1e-3;
// Half the range of 32 bits.
constexpr double sur_greatest = 1073741824.0;

// Height = number · step + offset, in millimetres.
struct SurSteps {
  float step = 1, offset = 0;
  std::int32_t number(double height) const {
    return static_cast<std::int32_t>(
        std::lround((height / millimetre - static_cast<double>(offset)) / static_cast<double>(step)));
  }
};

float single(double value, const std::string& path, const char* what) {
  const auto rounded = static_cast<float>(value);
  if (!std::isfinite(rounded))
    refuse(file_name(path) + " cannot be written: its " + what + " of " + format_short(value) +
               " mm is more than a SUR file holds",
           "write .x3p, .h5 or .npy");
  return rounded;
}

SurSteps steps_of(const Range& heights, const std::string& path) {
  // Used only for otherwise coarse steps: some readers ignore the offset.
  constexpr double far_from_zero = 1000;
  const double least = heights.min / millimetre, most = heights.max / millimetre;
  SurSteps steps;
  double reach = std::max(std::abs(least), std::abs(most));
  if (reach > far_from_zero * (most - least)) {
    steps.offset = single(0.5 * least + 0.5 * most, path, "height");
    reach = std::max(std::abs(least - static_cast<double>(steps.offset)),
                     std::abs(most - static_cast<double>(steps.offset)));
  }
  if (reach == 0) return steps;
  steps.step = std::max(single(reach / sur_greatest, path, "step"), std::numeric_limits<float>::min());
  return steps;
}

template <class T>
void put(std::string& bytes, T value) {
  bytes += raw_bytes(value);
}

void put_text(std::string& bytes, std::string_view text, std::size_t width, char pad) {
  bytes += text.substr(0, width);
  bytes.append(width - std::min(width, text.size()), pad);
}

std::string sur_header(const Surface& surface, const SurSteps& steps, std::int32_t least, std::int32_t most,
                       const std::string& path) {
  const Grid& grid = surface.grid();
  const bool holes = !surface.complete();
  std::string comment =
      "Heights are rounded to steps of " + format_short(static_cast<double>(steps.step)) + " mm.";
  if (holes)
    comment += " " + std::to_string(grid.nodes() - surface.measured()) + " of " +
               std::to_string(grid.nodes()) + " points were not measured.";
  std::string bytes = "DIGITAL SURF";
  // Little-endian, one object, version 1, surface.
  for (const int value : {0, 1, 1, 2}) put(bytes, static_cast<std::int16_t>(value));
  put_text(bytes, "height", 30, ' ');
  put_text(bytes, "Asperity", 30, ' ');
  // Material, kind of measurement, range, holes, absolute heights.
  for (const int value : {0, 0, 0, holes ? 1 : 0, 1}) put(bytes, static_cast<std::int16_t>(value));
  put_text(bytes, "", 8, '\0');
  put(bytes, std::int16_t{32});
  for (const std::int32_t value : {least, most, grid.nx, grid.ny, static_cast<std::int32_t>(grid.nodes())})
    put(bytes, value);
  put(bytes, single(grid.hx() / millimetre, path, "spacing"));
  put(bytes, single(grid.hy() / millimetre, path, "spacing"));
  put(bytes, steps.step);
  for (const char* const name : {"X", "Y", "Z"}) put_text(bytes, name, 16, ' ');
  for (int k = 0; k < 6; ++k) put_text(bytes, "mm", 16, ' ');  // units of spacing, then of length, per axis
  for (int k = 0; k < 3; ++k) put(bytes, 1.0F);                // unit ratios
  // Not a replica, not inverted, not levelled.
  for (const int value : {0, 0, 0}) put(bytes, static_cast<std::int16_t>(value));
  put_text(bytes, "", 12, '\0');
  // Fixed date, second to weekday: equal bytes.
  for (const int value : {0, 0, 0, 1, 1, 1970, 4}) put(bytes, static_cast<std::int16_t>(value));
  put(bytes, 0.0F);
  put_text(bytes, "", 10, '\0');
  put(bytes, static_cast<std::int16_t>(comment.size()));
  put(bytes, std::int16_t{0});
  put_text(bytes, "", 128, '\0');
  for (const float offset : {0.0F, 0.0F, steps.offset}) put(bytes, offset);
  put_text(bytes, "", 512 - bytes.size(), '\0');
  return bytes + comment;
}

}  // namespace

extern constexpr Format sur_format{
    "sur",
    "DIGITAL SURF at the start",
    {"SUR of Digital Surf (MountainsMap): the first surface or profile, of 16 or 32 bits, compressed or "
     "not.",
     "Files of Apple computers, binary images and other studiables.",
     "Three files of the public test sets of SurfaceTopography and surfalize, every height, size, missing "
     "points; compressed: files of surfalize's writer."},
    {FirstLine::top, "Gwyddion's reader shows the first line at the top."},
    {"sur", "pro"},
    recognises_sur,
    read_sur};

// Heights are rounded to steps of (greatest height) / 2^30, or range / 2^31 far from zero; sizes to single
// precision. A map of one line reads back as a trace.
// Throws Error{bad_value} if sizes or heights exceed single precision, Error{bad_file}.
void write_sur(const Surface& surface, const std::string& path, Monitor& monitor) {
  const Grid& grid = surface.grid();
  const Field& heights = surface.measured_heights();
  if (grid.nodes() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    refuse("a surface of " + std::to_string(grid.nodes()) + " heights does not fit into a SUR file",
           "write .h5 or .npy");
  const Range range = surface.height_range();
  const SurSteps steps = steps_of(range, path);
  const std::int32_t least = steps.number(range.min), most = steps.number(range.max);
  const auto append = [&](std::int64_t j, std::string& bytes) {
    for (const double height : heights.row(static_cast<int>(j)))
      put(bytes, std::isnan(height) ? least - 2 : steps.number(height));
  };
  write_rows(path, sur_header(surface, steps, least, most, path), grid.ny, append, monitor);
}

}  // namespace asperity
