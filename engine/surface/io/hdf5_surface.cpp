// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/hdf5_surface.hpp"

#include "engine/core/files/atomic_file.hpp"
#include "engine/core/text.hpp"
#include "engine/statistics/table_head.hpp"
#include "engine/surface/io/format.hpp"

namespace asperity {

// XDMF orders axes slowest first: (z, y, x).

namespace {

// Escapes an XML attribute.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text)
    safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return safe;
}

std::string shape_text(const Hdf5Array& array) {
  std::string sides;
  for (const std::size_t side : array.shape) sides += (sides.empty() ? "" : " x ") + std::to_string(side);
  return quoted(array.name) + " (" + (sides.empty() ? "one number" : sides) + ")";
}

bool is_map(const Hdf5Array& array) {
  return array.shape.size() == 2 && array.shape[0] > 0 && array.shape[1] > 0;
}

std::string listed(const Hdf5Content& content) {
  std::vector<std::string> names;
  for (const Hdf5Array& array : content.arrays) names.push_back(shape_text(array));
  for (const std::string& other : content.unread) names.push_back(other);
  return names.empty() ? "nothing" : listed_up_to(12, std::move(names));
}

// Order: `channel`; `height`; the only map; the only row of numbers.
const Hdf5Array& heights_of(const SourceFile& file, const Hdf5Content& content, const std::string& channel) {
  if (!channel.empty()) {
    const Hdf5Array* const asked = content.array(channel);
    if (asked == nullptr || (!is_map(*asked) && asked->shape.size() != 1)) {
      std::vector<std::string> names;
      for (const Hdf5Array& array : content.arrays) names.push_back(array.name);
      refuse_file(
          file, "holds no map " + quoted(channel) + did_you_mean(channel, names) + " but " + listed(content),
          "name an array of two dimensions with `channel`");
    }
    return *asked;
  }
  for (const char* const name : {"height", "heights"})
    if (const Hdf5Array* const found = content.array(name); found != nullptr && is_map(*found)) return *found;
  const Hdf5Array* only = nullptr;
  for (const std::size_t dimensions : {2, 1}) {
    std::size_t count = 0;
    for (const Hdf5Array& array : content.arrays)
      if (array.name != "size" && array.shape.size() == dimensions && array.shape[0] > 0 &&
          (dimensions == 1 || array.shape[1] > 0)) {
        only = &array;
        ++count;
      }
    if (count == 1) return *only;
    if (count > 1)
      refuse_file(file, "holds several arrays, and none is called `height`: " + listed(content),
                  "name the one to read with `channel`");
  }
  refuse_file(file, "holds no map of heights but " + listed(content),
              "a surface is an array of numbers of shape (ny, nx)");
}

HeightMap read_hdf5_channel(const SourceFile& file, const std::string& channel, Monitor& monitor) {
  const Hdf5Content content = read_hdf5(file, monitor);
  const Hdf5Array& array = heights_of(file, content, channel);
  const std::size_t ny = array.shape.size() == 2 ? array.shape[0] : 1, nx = array.shape.back();
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (nx == 0 || nx > most || ny > most)
    refuse_file(file, "holds " + shape_text(array) + ", which is no map");
  HeightMap map;
  map.trace = array.shape.size() == 1;
  map.heights = Field(static_cast<int>(nx), static_cast<int>(ny));
  std::visit(
      [&](const auto& values) {
        for (std::size_t k = 0; k < values.size(); ++k) {
          const auto value = static_cast<double>(values[k]);
          map.heights[k] = value == array.missing ? std::numeric_limits<double>::quiet_NaN() : value;
        }
      },
      array.values);
  if (!array.unit.empty()) {
    const std::optional<Quantity> unit = known_unit(array.unit);
    if (!unit) return map;  // the call may give one
    if (unit->dimension != dimension::length)
      refuse_file(
          file,
          "holds " + quoted(array.name) + " in " + array.unit + ", which is " + describe(unit->dimension),
          "name an array of heights with `channel`");
    map.unit = unit->value;
  }
  const Hdf5Array* const size = content.array("size");
  const auto* const sides = size == nullptr ? nullptr : std::get_if<std::span<const double>>(&size->values);
  if (sides != nullptr && sides->size() == 2 && size->unit == "m") {
    for (const double side : *sides)
      if (!(side > 0 && side <= std::numeric_limits<double>::max()))
        refuse_file(
            file, "gives a size of " + format_short((*sides)[0]) + " x " + format_short((*sides)[1]) + " m");
    map.size_x = (*sides)[0];
    map.size_y = (*sides)[1];
  }
  return map;
}

}  // namespace

std::filesystem::path xdmf_path(const std::filesystem::path& hdf5) {
  std::filesystem::path path = hdf5;
  return path.replace_extension(".xdmf");
}

bool has_xdmf_beside(const std::filesystem::path& file) {
  const std::string extension = file_extension(file.string());
  return extension == "h5" || extension == "hdf5";
}

std::string xdmf_text(const Grid& grid, std::string_view name, const Hdf5Content& content,
                      const std::filesystem::path& hdf5) {
  const std::string dimensions = "1 " + std::to_string(grid.ny) + " " + std::to_string(grid.nx);
  const auto item = [](const std::string& numbers) {
    return "        <DataItem Format=\"XML\" Dimensions=\"3\" NumberType=\"Float\" Precision=\"8\">" +
           numbers + "</DataItem>\n";
  };
  std::string text =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<Xdmf Version=\"3.0\">\n"
      "  <Domain>\n"
      "    <Grid Name=\"" +
      escaped(name) +
      "\" GridType=\"Uniform\">\n"
      "      <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"" +
      dimensions +
      "\"/>\n"
      "      <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n";
  // The single layer needs any nonzero spacing.
  text += item("0 0 0") +
          item(format_exact(grid.hx()) + " " + format_exact(grid.hy()) + " " + format_exact(grid.hx()));
  text += "      </Geometry>\n";
  constexpr std::array types{std::pair{"Float", "8"}, std::pair{"Int", "8"}, std::pair{"UChar", "1"}};
  for (const Hdf5Array& array : content.arrays) {
    if (array.shape !=
        std::vector<std::size_t>{static_cast<std::size_t>(grid.ny), static_cast<std::size_t>(grid.nx)})
      continue;
    const auto& [type, bytes] = types[array.values.index()];
    const std::string shown = array.unit.empty() ? array.name : array.name + " [" + array.unit + "]";
    text += "      <Attribute Name=\"" + escaped(shown) + "\" AttributeType=\"Scalar\" Center=\"Node\">\n" +
            "        <DataItem Format=\"HDF\" Dimensions=\"" + dimensions + "\" NumberType=\"" + type +
            "\" Precision=\"" + bytes + "\">" + escaped(hdf5.filename().string()) + ":/" +
            escaped(array.name) + "</DataItem>\n      </Attribute>\n";
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

void write_hdf5_and_xdmf(const std::filesystem::path& hdf5, const Grid& grid, std::string_view name,
                         const Hdf5Content& content) {
  write_hdf5(hdf5, content);
  AtomicFile beside(xdmf_path(hdf5), FileWords::data);
  beside.write(xdmf_text(grid, name, content, hdf5));
  beside.commit();
}

Hdf5Array tile_size(const Grid& grid) {
  return owning_array<double>("size", {2}, {grid.size_x, grid.size_y}, "m");
}

void write_hdf5_surface(const Surface& surface, const std::filesystem::path& path) {
  const Grid& grid = surface.grid();
  Hdf5Content content;
  content.texts = {{"content", "asperity surface"}, {"digest", surface.digest()}};
  content.arrays.push_back({"height",
                            {static_cast<std::size_t>(grid.ny), static_cast<std::size_t>(grid.nx)},
                            surface.measured_heights().values(),
                            "m"});
  if (!surface.complete())
    content.numbers.emplace_back("not_measured", static_cast<double>(grid.nodes() - surface.measured()));
  content.arrays.push_back(tile_size(grid));
  write_hdf5_and_xdmf(path, grid, "surface", content);
}

extern constexpr Format hdf5_format{
    "hdf5",
    "\\x89HDF at the start",
    {"Arrays of two axes in HDF5, by name with `channel`, and surfaces that this program wrote.",
     "Packings other than deflate and shuffle, complex numbers and records.",
     "Files written by h5py and by this program."},
    {FirstLine::bottom, "A matrix: its first row is j = 0, as the .xdmf file beside it says."},
    {"h5", "hdf5", "he5"},
    looks_like_hdf5,
    nullptr,
    read_hdf5_channel,
    true};

}  // namespace asperity
