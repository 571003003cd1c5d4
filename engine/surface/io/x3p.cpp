// SPDX-License-Identifier: GPL-3.0-or-later
// X3P of ISO 25178-72 (formerly ISO 5436-2): a zip archive of main.xml and heights, in a binary file or in
// main.xml. z = raw * Increment + Offset, in metres. Data types: I, L (signed 16 and 32 bits), F, D. An
// absolute x or y axis must be evenly spaced. Holes: NaN, an infinite height (Alicona), an empty datum, a
// cleared bit of the valid-points file. A wrong MD5 of data is an error, of main.xml a warning: people edit
// main.xml. Offsets of x and y and rotation are ignored.
#include <zip.h>
#include <pugixml.hpp>

#include <bit>
#include <charconv>
#include <cmath>

#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/archive.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"
#include "engine/surface/surface.hpp"

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
  constexpr std::string_view blanks = " \t\r\n";
  const std::string_view text = node.child_value();
  const std::size_t first = std::min(text.find_first_not_of(blanks), text.size());
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

// Extra digits: increment times count must round to the size.
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
  NumberType type = number_type<double>;
  long double increment = 1, offset = 0;
  bool has_increment = false;
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
    const std::map<std::string_view, NumberType> types{{"I", number_type<std::int16_t>},
                                                       {"L", number_type<std::int32_t>},
                                                       {"F", number_type<float>},
                                                       {"D", number_type<double>}};
    const auto known = types.find(type);
    if (known == types.end())
      refuse_file(file, "has data of type " + shown(type) + " on axis " + name,
                  "types I, L, F and D are read");
    axis.type = known->second;
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

std::string md5_of(std::span<const char> bytes) {
  Md5 md5;
  md5.add(bytes);
  return md5.hex();
}

void compare_md5(const SourceFile& file, const std::string& found, std::string_view wanted,
                 const std::string& of) {
  if (wanted.empty() || found == lower_case(wanted)) return;
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

std::int64_t required_entry(const SourceFile& file, const Archive& archive, const std::string& folder,
                            std::string_view name) {
  const std::int64_t index = linked_entry(archive, folder, name);
  if (index < 0) refuse_file(file, "has no entry " + shown(name) + ", which its main.xml names");
  return index;
}

// `found`: MD5 of main.xml. Ignores a missing sum.
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
               "; main.xml may be altered, so check the size and the unit of height");
}

void read_binary(const SourceFile& file, const Archive& archive, const std::string& folder,
                 pugi::xml_node link, Map& map, Monitor& monitor) {
  const std::int64_t index = required_entry(file, archive, folder, text_of(child(link, "PointDataLink")));
  std::size_t record = 0;
  for (const X3pAxis& axis : map.axes) record += axis.absolute ? axis.type.width : 0;
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
        map.put(axis, j * map.nx + i, map.axes[axis].type.read(at));
        at += map.axes[axis].type.width;
      }
    }
    task.advance();
  }
  entry.expect_end();
  compare_md5(file, entry.md5().hex(), text_of(child(link, "MD5ChecksumPointData")),
              "data, " + archive.entry_text(index) + ",");

  const std::string_view valid = text_of(child(link, "ValidPointsLink"));
  if (valid.empty()) return;
  const std::int64_t mask_index = required_entry(file, archive, folder, valid);
  const std::uint64_t points = map.nx * map.ny;
  const Array<char> mask = archive.contents(mask_index, (points + 7) / 8 + 8);
  if (mask.size() < (points + 7) / 8) refuse_file(file, "has too few bits in its valid-points entry");
  compare_md5(file, md5_of(mask), text_of(child(link, "MD5ChecksumValidPoints")),
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
    const std::string where = "has an invalid point: number " + std::to_string(k + 1) + ", ";
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
  if (even_values(coordinates, 0.25) < count)
    refuse_file(file,
                std::string("is not on a regular grid: its ") + name + " coordinates are not evenly spaced");
  const double spacing = (coordinates.back() - coordinates.front()) / static_cast<double>(count - 1);
  return spacing * static_cast<double>(count);
}

// Upper bound of pugixml's memory: two nodes per tag, one attribute per equals sign.
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
  const std::string xml_md5 = md5_of(xml);  // before parsing in place
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

// To 21 digits.
std::string increment(double size, int count) {
  std::array<char, 64> buffer;
  const auto [end, failure] = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                            static_cast<long double>(size) / static_cast<long double>(count),
                                            std::chars_format::scientific, 20);
  if (failure != std::errc{}) throw Error(ErrorCode::internal, "an increment was not written");
  return {buffer.data(), end};
}

std::string main_xml(const Grid& grid, const std::string& md5) {
  return R"(<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://www.opengps.eu/2008/ISO5436_2 http://www.opengps.eu/2008/ISO5436_2/ISO5436_2.xsd">
  <Record1>
    <Revision>ISO5436 - 2000</Revision>
    <FeatureType>SUR</FeatureType>
    <Axes>
      <CX><AxisType>I</AxisType><DataType>D</DataType><Increment>)" +
         increment(grid.size_x, grid.nx) + R"(</Increment><Offset>0</Offset></CX>
      <CY><AxisType>I</AxisType><DataType>D</DataType><Increment>)" +
         increment(grid.size_y, grid.ny) + R"(</Increment><Offset>0</Offset></CY>
      <CZ><AxisType>A</AxisType><DataType>D</DataType></CZ>
    </Axes>
  </Record1>
  <Record2>
    <Date>1970-01-01T00:00:00</Date>
    <Instrument>
      <Manufacturer>Asperity</Manufacturer>
      <Model>Asperity</Model>
      <Serial>not available</Serial>
      <Version>1</Version>
    </Instrument>
    <CalibrationDate>1970-01-01T00:00:00</CalibrationDate>
    <ProbingSystem><Type>Software</Type><Identification>not available</Identification></ProbingSystem>
  </Record2>
  <Record3>
    <MatrixDimension><SizeX>)" +
         std::to_string(grid.nx) + "</SizeX><SizeY>" + std::to_string(grid.ny) +
         R"(</SizeY><SizeZ>1</SizeZ></MatrixDimension>
    <DataLink>
      <PointDataLink>bindata/data.bin</PointDataLink>
      <MD5ChecksumPointData>)" +
         md5 + R"(</MD5ChecksumPointData>
    </DataLink>
  </Record3>
  <Record4>
    <ChecksumFile>md5checksum.hex</ChecksumFile>
  </Record4>
</p:ISO5436_2>
)";
}

}  // namespace

extern constexpr Format x3p_format{
    "x3p",
    "a zip archive with main.xml",
    {"X3P of ISO 25178-72: surfaces and profiles on a grid, with their valid "
     "points, zipped in a folder or not.",
     "Point clouds, several layers, uneven spacing.",
     "A file of the public test set of SurfaceTopography, heights and sizes."},
    {FirstLine::bottom, "ISO 25178-72 gives coordinates: y is the row times its increment."},
    {"x3p"},
    recognises_x3p,
    read_x3p,
    nullptr,
    true};

// Writes incremental x and y, z in double precision, a fixed date. Missing points are NaN: the valid-points
// mask of the standard is for integers.
// Throws Error{bad_file}. Increments have more digits than a double: the size reads back exactly.
void write_x3p(const Surface& surface, const std::string& path) {
  static_assert(std::endian::native == std::endian::little, "X3P data are written as they lie in memory");
  const auto heights = surface.measured_heights().values();
  const std::span<const char> data{reinterpret_cast<const char*>(heights.data()), heights.size_bytes()};
  const std::string xml = main_xml(surface.grid(), md5_of(data));
  const std::string checksum = md5_of(xml) + " *main.xml\n";

  AtomicFile file(path, FileWords::data);
  // A temporary file of libzip would survive a killed process.
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* archive = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_t* zip = archive == nullptr ? nullptr : zip_open_from_source(archive, ZIP_TRUNCATE, &error);
  const auto refuse = [&](const std::string& reason) {
    if (zip != nullptr) zip_discard(zip);
    if (archive != nullptr) zip_source_free(archive);
    refuse_bad_file(file_name(path) + " cannot be written: " + reason,
                    "check permission and space on the disk");
  };
  if (zip == nullptr) refuse(zip_error_strerror(&error));
  zip_source_keep(archive);
  const auto add = [&](const char* name, std::span<const char> bytes) {
    zip_source_t* source = zip_source_buffer(zip, bytes.data(), bytes.size(), 0);
    const zip_int64_t index = source == nullptr ? -1 : zip_file_add(zip, name, source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      if (source != nullptr) zip_source_free(source);
      refuse(zip_strerror(zip));
    }
    constexpr zip_uint16_t first_of_january_1980 = (1 << 5) | 1;
    if (zip_file_set_dostime(zip, static_cast<zip_uint64_t>(index), 0, first_of_january_1980, 0) != 0)
      refuse(zip_strerror(zip));
  };
  add("main.xml", xml);
  add("bindata/data.bin", data);
  add("md5checksum.hex", checksum);
  if (zip_close(zip) != 0) refuse(zip_strerror(zip));
  zip = nullptr;
  zip_stat_t facts;
  if (zip_source_stat(archive, &facts) != 0 || zip_source_open(archive) != 0)
    refuse(zip_error_strerror(zip_source_error(archive)));
  std::string bytes(facts.size, '\0');
  const zip_int64_t taken = zip_source_read(archive, bytes.data(), bytes.size());
  zip_source_close(archive);
  if (taken != static_cast<zip_int64_t>(bytes.size())) refuse("the archive cannot be read back");
  zip_source_free(archive);
  file.write(bytes);
  file.commit();
}

}  // namespace asperity
