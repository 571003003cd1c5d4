// SPDX-License-Identifier: GPL-3.0-or-later
// X3P, the XML container of ISO 25178-72 (formerly ISO 5436-2): a zip archive of main.xml and heights, in a
// binary file or in main.xml. x runs fastest; z = raw * Increment + Offset, in metres. Data types: I, L
// (signed 16 and 32 bits), F, D. An absolute x or y axis must be evenly spaced. Holes: NaN, an infinite
// height (Alicona), an empty datum, a cleared bit of the valid-points file. A wrong MD5 of data is an
// error, of main.xml a warning: people edit main.xml, and some programs write another sum. Offsets of x and
// y and rotation are ignored.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <pugixml.hpp>
#include <span>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/archive.hpp"
#include "engine/surface/io/format.hpp"

namespace asperity {

namespace {

pugi::xml_node child(pugi::xml_node parent, std::string_view name) {
  for (const pugi::xml_node node : parent.children()) {
    const std::string_view whole = node.name();
    const std::size_t colon = whole.find(':');
    if ((colon == std::string_view::npos ? whole : whole.substr(colon + 1)) == name) return node;
  }
  return {};
}

std::string_view text_of(pugi::xml_node node) {
  std::string_view text = node.child_value();
  while (!text.empty() && std::string_view(" \t\r\n").find(text.front()) != std::string_view::npos)
    text.remove_prefix(1);
  while (!text.empty() && std::string_view(" \t\r\n").find(text.back()) != std::string_view::npos)
    text.remove_suffix(1);
  return text;
}

// Extra digits: increment times count must round to the intended size.
std::optional<long double> number_of(pugi::xml_node node) {
  std::string_view text = text_of(node);
  if (text.starts_with('+')) text.remove_prefix(1);
  long double value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || failure != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    return {};
  return value;
}

struct X3pAxis {
  bool absolute = false;  // coordinate stored with every point
  char type = 'D';        // I, L, F, D
  long double increment = 1, offset = 0;
  bool has_increment = false;
  std::size_t width() const { return type == 'I' ? 2 : type == 'D' ? 8 : 4; }
};

X3pAxis axis_of(const SourceFile& file, pugi::xml_node axes, const std::string& name) {
  const pugi::xml_node node = child(axes, name);
  if (!node) refuse_file(file, "has no axis " + name + " in its main.xml");
  X3pAxis axis;
  const std::string_view kind = text_of(child(node, "AxisType"));
  if (kind != "A" && kind != "I")
    refuse_file(file, "has an axis " + name + " of type " + shown(kind), "axis types I and A are read");
  axis.absolute = kind == "A" || name == "CZ";
  const std::string_view type = text_of(child(node, "DataType"));
  if (axis.absolute) {
    if (type != "I" && type != "L" && type != "F" && type != "D")
      refuse_file(file, "has data of type " + shown(type) + " on axis " + name,
                  "types I, L, F and D are read");
    axis.type = type[0];
  }
  if (const pugi::xml_node increment = child(node, "Increment"); increment && !text_of(increment).empty()) {
    const auto value = number_of(increment);
    if (!value)
      refuse_file(file, "has an Increment of axis " + name + " that is " + shown(text_of(increment)));
    axis.increment = *value;
    axis.has_increment = true;
  }
  if (const auto offset = number_of(child(node, "Offset"))) axis.offset = *offset;
  if (!axis.absolute && !(axis.has_increment && axis.increment > 0))
    refuse_file(file, "has no Increment above zero on its axis " + name);
  return axis;
}

std::uint64_t count_of(const SourceFile& file, pugi::xml_node dimension, const char* name) {
  const std::string_view text = text_of(child(dimension, name));
  const std::optional<std::uint64_t> count = count_in(text);
  if (!count || *count < 1 || *count > static_cast<std::uint64_t>(max_cells))
    refuse_file(file, "has a matrix whose " + std::string(name) + " is " + shown(text),
                "it must be a whole number from 1 to " + std::to_string(max_cells));
  return *count;
}

struct Map {
  std::uint64_t nx = 0, ny = 0;
  std::array<X3pAxis, 3> axes;
  Array<double> x, y;  // coordinates, if absolute
  Field heights;

  std::size_t stored_axes() const {
    return static_cast<std::size_t>(axes[0].absolute) + static_cast<std::size_t>(axes[1].absolute) + 1;
  }
  void put(std::size_t axis, std::uint64_t k, double raw) {
    const X3pAxis& a = axes[axis];
    const double value =
        a.has_increment || a.offset != 0 ? static_cast<double>(raw * a.increment + a.offset) : raw;
    if (axis == 2) heights[k] = std::isinf(raw) ? std::numeric_limits<double>::quiet_NaN() : value;
    if (axis == 0 && k < nx) x[k] = value;
    if (axis == 1 && k % nx == 0) y[k / nx] = value;
  }
};

double raw_value(const char* at, char type) {
  static_assert(std::endian::native == std::endian::little, "X3P data are little-endian");
  std::array<char, 8> raw{};
  const std::size_t width = type == 'I' ? 2 : type == 'D' ? 8 : 4;
  std::memcpy(raw.data(), at, width);
  const auto as = [&]<class T>(T value) {
    std::memcpy(&value, raw.data(), sizeof value);
    return static_cast<double>(value);
  };
  switch (type) {
    case 'I':
      return as(std::int16_t{});
    case 'L':
      return as(std::int32_t{});
    case 'F':
      return as(float{});
    default:
      return as(double{});
  }
}

void compare_md5(const SourceFile& file, Md5& md5, std::string_view wanted, const std::string& of) {
  if (wanted.empty()) return;
  const std::string found = md5.hex();
  if (found == lower_case(wanted)) return;
  const bool digits = wanted.find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
  refuse_file(file,
              "is damaged: the MD5 of its " + of + " is " + found + ", not " +
                  (digits ? lower_case(wanted.substr(0, 32)) : shown(wanted)),
              "copy the file again from its source");
}

// Relative to the top or to the folder of main.xml.
std::int64_t linked_entry(const Archive& archive, const std::string& folder, std::string_view name) {
  const std::int64_t index = archive.find(folder + std::string(name));
  return index < 0 ? archive.find(name) : index;
}

// `found`: MD5 of main.xml. A missing entry or sum is ignored.
void compare_own_md5(const SourceFile& file, const Archive& archive, const std::string& folder,
                     std::string_view name, const std::string& found, Monitor& monitor) {
  constexpr std::uint64_t longest = 4096;
  const std::int64_t index = linked_entry(archive, folder, name.empty() ? "md5checksum.hex" : name);
  if (index < 0 || archive.claimed_size(index) > longest) return;
  const Array<char> text = archive.contents(index, longest);
  const std::string_view line = trimmed(std::string_view(text.data(), text.size()));
  const std::size_t digits = std::min(line.find_first_not_of("0123456789abcdefABCDEF"), line.size());
  if (digits != found.size() || lower_case(line.substr(0, digits)) == found) return;
  monitor.warn(file_name(file.path()) + ": the MD5 of its main.xml is " + found + ", and " +
               archive.entry_text(index) + " says " + lower_case(line.substr(0, digits)) +
               "; main.xml may have been altered: compare the size and the unit of height with those that "
               "were measured");
}

void read_binary(const SourceFile& file, const Archive& archive, const std::string& folder,
                 pugi::xml_node link, Map& map, Monitor& monitor) {
  const std::string name(text_of(child(link, "PointDataLink")));
  const std::int64_t index = linked_entry(archive, folder, name);
  if (index < 0) refuse_file(file, "has no entry " + shown(name) + ", which its main.xml names");
  std::size_t record = 0;
  for (const X3pAxis& axis : map.axes) record += axis.absolute ? axis.width() : 0;
  const std::uint64_t expected = map.nx * map.ny * record;
  if (const std::uint64_t claimed = archive.claimed_size(index); claimed != expected)
    refuse_file(file,
                "has a matrix of " + std::to_string(map.nx) + " x " + std::to_string(map.ny) + " points, " +
                    std::to_string(expected) + " bytes, but holds " + std::to_string(claimed),
                "the file is cut short or its main.xml is wrong");
  map.heights = Field(static_cast<int>(map.nx), static_cast<int>(map.ny));
  ArchiveEntry entry(archive, index);
  Array<char> row(map.nx * record);
  Task task(monitor, "reading", static_cast<std::int64_t>(map.ny));
  for (std::uint64_t j = 0; j < map.ny; ++j) {
    entry.read(row);
    const char* at = row.data();
    for (std::uint64_t i = 0; i < map.nx; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!map.axes[axis].absolute) continue;
        map.put(axis, j * map.nx + i, raw_value(at, map.axes[axis].type));
        at += map.axes[axis].width();
      }
    }
    task.advance();
  }
  entry.expect_end();
  compare_md5(file, entry.md5(), text_of(child(link, "MD5ChecksumPointData")),
              "data, " + archive.entry_text(index) + ",");

  const std::string_view valid = text_of(child(link, "ValidPointsLink"));
  if (valid.empty()) return;
  const std::int64_t mask_index = linked_entry(archive, folder, valid);
  if (mask_index < 0) refuse_file(file, "has no entry " + shown(valid) + ", which its main.xml names");
  const std::uint64_t points = map.nx * map.ny;
  const Array<char> mask = archive.contents(mask_index, (points + 7) / 8 + 8);
  if (mask.size() < (points + 7) / 8) refuse_file(file, "has too few bits in its valid-points entry");
  Md5 md5;
  md5.add(mask);
  compare_md5(file, md5, text_of(child(link, "MD5ChecksumValidPoints")),
              "valid points, " + archive.entry_text(mask_index) + ",");
  for (std::uint64_t k = 0; k < points; ++k)
    if ((static_cast<unsigned char>(mask[k / 8]) >> (k % 8) & 1) == 0)
      map.heights[k] = std::numeric_limits<double>::quiet_NaN();
}

void read_inline(const SourceFile& file, pugi::xml_node list, Map& map) {
  std::uint64_t found = 0;
  for (const pugi::xml_node datum : list.children()) found += datum.type() == pugi::node_element ? 1 : 0;
  if (found != map.nx * map.ny)
    refuse_file(file,
                "has a matrix of " + std::to_string(map.nx) + " x " + std::to_string(map.ny) +
                    " points but " + std::to_string(found) + " in its list",
                "the file is cut short or its main.xml is wrong");
  map.heights =
      Field(static_cast<int>(map.nx), static_cast<int>(map.ny), std::numeric_limits<double>::quiet_NaN());
  std::uint64_t k = 0;
  for (const pugi::xml_node datum : list.children()) {
    if (datum.type() != pugi::node_element) continue;
    const std::string_view text = text_of(datum);
    const std::string where =
        "has a point that is not as its axes want it: number " + std::to_string(k + 1) + ", ";
    if (!text.empty()) {
      const std::vector<std::string_view> cells =
          cells_of(text, text.find(';') == std::string_view::npos ? Separator::blank : Separator::semicolon);
      if (cells.size() != map.stored_axes()) refuse_file(file, where + shown(text));
      std::size_t column = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!map.axes[axis].absolute) continue;
        const TextCell cell = read_cell(cells[column++], Separator::comma);
        if (cell.kind != CellKind::number && cell.kind != CellKind::hole)
          refuse_file(file, where + shown(text));
        map.put(axis, k, cell.value);
      }
    }
    ++k;
  }
}

// Nodes times spacing, m.
double size_of(const SourceFile& file, const X3pAxis& axis, std::span<const double> coordinates,
               std::uint64_t count, const char* name) {
  if (!axis.absolute) return static_cast<double>(axis.increment * static_cast<long double>(count));
  const double spacing =
      count > 1 ? (coordinates.back() - coordinates.front()) / static_cast<double>(count - 1) : 0.0;
  for (std::uint64_t k = 0; k < count; ++k)
    if (!(spacing > 0) || !(std::abs(coordinates[k] - (coordinates.front() +
                                                       static_cast<double>(k) * spacing)) <= 0.25 * spacing))
      refuse_file(
          file, std::string("is not on a regular grid: its ") + name + " coordinates are not evenly spaced");
  return spacing * static_cast<double>(count);
}

// Accounts an upper bound of pugixml's memory: two nodes per tag (element and text), one attribute per
// equals sign.
class TreeMemory {
 public:
  explicit TreeMemory(std::span<const char> xml) {
    constexpr std::int64_t node = 64, attribute = 40, page = 65536;
    const auto count = [&](char c) { return std::count(xml.begin(), xml.end(), c); };
    bytes_ = 2 * node * count('<') + attribute * count('=') + page;
    if (!memory::account(bytes_))
      throw Error(ErrorCode::out_of_memory,
                  "out of memory for a main.xml of " + std::to_string(xml.size()) + " bytes",
                  "pack the heights in binary");
  }
  ~TreeMemory() { memory::account(-bytes_); }
  TreeMemory(const TreeMemory&) = delete;
  TreeMemory& operator=(const TreeMemory&) = delete;

 private:
  std::int64_t bytes_;
};

constexpr std::string_view main_entry = "main.xml";

bool recognises_x3p(const SourceFile& file) {
  if (!file.bytes().starts_with(std::string_view("PK\x03\x04", 4))) return false;
  try {
    const Archive archive(file);
    return archive.find(archive.folder_of(main_entry) + std::string(main_entry)) >= 0;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_file) throw;
    return false;
  }
}

HeightMap read_x3p(const SourceFile& file, Monitor& monitor) {
  const Archive archive(file);
  const std::string folder = archive.folder_of(main_entry);
  const std::int64_t index = archive.find(folder + std::string(main_entry));
  if (index < 0) refuse_file(file, "is a zip archive without main.xml, so it is not X3P");
  // Text packs about twenty times at most.
  const std::uint64_t limit = (std::uint64_t{1} << 20) + 32 * static_cast<std::uint64_t>(file.bytes().size());
  Array<char> xml = archive.contents(index, limit);
  Md5 md5;
  md5.add(xml);
  const std::string xml_md5 = md5.hex();  // before parsing in place
  const TreeMemory tree(xml);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer_inplace(
      xml.data(), xml.size(), pugi::parse_minimal | pugi::parse_escapes | pugi::parse_cdata);
  if (parsed.status == pugi::status_out_of_memory)
    throw Error(ErrorCode::out_of_memory, "there is no memory for the main.xml of " + file_name(file.path()));
  if (!parsed) refuse_file(file, std::string("has a damaged main.xml (") + parsed.description() + ")");
  const pugi::xml_node root = document.document_element();
  const pugi::xml_node record1 = child(root, "Record1"), record3 = child(root, "Record3");
  if (!record1 || !record3) refuse_file(file, "has a main.xml without Record1 or Record3, so it is not X3P");
  const std::string_view feature = text_of(child(record1, "FeatureType"));
  if (feature == "PCL")
    refuse_file(file, "holds a point cloud", "only surfaces and profiles on a grid are read");

  Map map;
  const pugi::xml_node axes = child(record1, "Axes");
  map.axes = {axis_of(file, axes, "CX"), axis_of(file, axes, "CY"), axis_of(file, axes, "CZ")};
  const pugi::xml_node dimension = child(record3, "MatrixDimension");
  if (!dimension)
    refuse_file(file, "has no matrix dimension", "only surfaces and profiles on a grid are read");
  map.nx = count_of(file, dimension, "SizeX");
  map.ny = count_of(file, dimension, "SizeY");
  if (const std::uint64_t layers = count_of(file, dimension, "SizeZ"); layers != 1)
    refuse_file(file, "holds " + std::to_string(layers) + " layers", "files of one layer are read");
  map.x.resize(map.axes[0].absolute ? map.nx : 0);
  map.y.resize(map.axes[1].absolute ? map.ny : 0);
  if (const pugi::xml_node link = child(record3, "DataLink")) {
    read_binary(file, archive, folder, link, map, monitor);
  } else if (const pugi::xml_node list = child(record3, "DataList")) {
    read_inline(file, list, map);
  } else {
    refuse_file(file, "has neither a DataLink nor a DataList, so it holds no heights");
  }

  compare_own_md5(file, archive, folder, text_of(child(child(root, "Record4"), "ChecksumFile")), xml_md5,
                  monitor);

  HeightMap result;
  result.heights = std::move(map.heights);
  result.unit = 1.0;
  result.trace = map.ny == 1 && (feature == "PRF" || map.axes[1].absolute);
  result.size_x = size_of(file, map.axes[0], map.x, map.nx, "x");
  if (!result.trace) result.size_y = size_of(file, map.axes[1], map.y, map.ny, "y");
  return result;
}

}  // namespace

const Format& x3p_format() {
  static const Format format{
      "x3p",
      "a zip archive with main.xml",
      {"X3P of ISO 25178-72: surfaces and profiles on a grid, with their valid "
       "points, zipped in a folder or not.",
       "Point clouds, several layers, uneven spacing.",
       "A file of the public test set of SurfaceTopography, heights and sizes."},
      {FirstLine::bottom, "ISO 25178-72 gives coordinates: y is the row times its increment."},
      {"x3p"},
      recognises_x3p,
      read_x3p};
  return format;
}

}  // namespace asperity
