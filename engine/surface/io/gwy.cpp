// SPDX-License-Identifier: GPL-3.0-or-later
// GWY, Gwyddion's own files: nested objects of named, typed components. A map is the GwyDataField "/N/data".
// Source: "Format of Gwyddion Files", Gwyddion user guide. A mask "/N/mask" is applied only if "/N/meta",
// written by this program, declares it; users mask arbitrary points. Masked heights are the mean.
#include <charconv>
#include <cmath>

#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/io/column_head.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

namespace {

constexpr std::string_view mark = "GWYP";

struct Component {
  std::string_view name;
  char type;
  std::string_view data;  // without the zero byte of a text, the count of an array
  std::size_t count = 1;
};

std::size_t width_of(char type) {
  for (const auto& [types, width] : {std::pair{"bcC", 1}, std::pair{"iI", 4}, std::pair{"qQdD", 8}})
    if (std::string_view(types).find(type) != std::string_view::npos) return static_cast<std::size_t>(width);
  return 0;
}

struct Object {
  std::string_view name, content;
};

Object take_object(BinaryCursor& cursor) {
  Object object;
  object.name = cursor.ended_text();
  const std::size_t length = cursor.number<std::uint32_t>();
  object.content = cursor.take(length);
  return object;
}

Component take_component(const SourceFile& file, BinaryCursor& cursor, std::string_view content) {
  Component component;
  component.name = cursor.ended_text();
  component.type = cursor.take(1)[0];
  const char type = component.type;
  const bool many = type >= 'A' && type <= 'Z';
  if (many) component.count = cursor.number<std::uint32_t>();
  const std::size_t before = cursor.position();
  if (const std::size_t width = width_of(type); width != 0) {
    // 32 bits, so the product cannot overflow.
    component.data = cursor.take(component.count * width);
  } else if (type == 's') {
    component.data = cursor.ended_text();
  } else if (type == 'S') {
    for (std::size_t k = 0; k < component.count; ++k) cursor.ended_text();
  } else if (type == 'o' || type == 'O') {
    for (std::size_t k = 0; k < component.count; ++k) take_object(cursor);
    component.data = content.substr(before, cursor.position() - before);
  } else {
    refuse_file(file, "has a component " + shown(component.name) + " of the unknown type " +
                          shown(std::string_view(&component.type, 1)));
  }
  return component;
}

template <class Visit>
void for_each(const SourceFile& file, std::string_view content, Visit&& visit) {
  BinaryCursor cursor(file, content, "an object");
  while (cursor.left() > 0) visit(take_component(file, cursor, content));
}

Object object_of(const SourceFile& file, const Component& component) {
  BinaryCursor cursor(file, component.data, "an object");
  return take_object(cursor);
}

struct DataField {
  std::int32_t nx = 0, ny = 0;
  double size_x = 0, size_y = 0;
  std::string_view unit_xy, unit_z;
  std::string_view data;
};

// "m"; empty for a plain number.
std::string_view unit_text(const SourceFile& file, const Component& component) {
  std::string_view text;
  for_each(file, object_of(file, component).content, [&](const Component& part) {
    if (part.type == 's' && part.name == "unitstr") text = part.data;
  });
  return text;
}

DataField read_field(const SourceFile& file, std::string_view content) {
  DataField field;
  for_each(file, content, [&](const Component& part) {
    const char* const at = part.data.data();
    if (part.type == 'i' && part.name == "xres") field.nx = little_endian<std::int32_t>(at);
    if (part.type == 'i' && part.name == "yres") field.ny = little_endian<std::int32_t>(at);
    if (part.type == 'd' && part.name == "xreal") field.size_x = little_endian<double>(at);
    if (part.type == 'd' && part.name == "yreal") field.size_y = little_endian<double>(at);
    if (part.type == 'D' && part.name == "data") field.data = part.data;
    if (part.type == 'o' && part.name == "si_unit_xy") field.unit_xy = unit_text(file, part);
    if (part.type == 'o' && part.name == "si_unit_z") field.unit_z = unit_text(file, part);
  });
  return field;
}

// Its value begins with the number of holes.
constexpr std::string_view hole_entry = "Not measured";

struct Channel {
  std::string_view field;  // null if missing
  std::string title;
  std::string_view mask;
  std::optional<std::string> holes;  // value of `hole_entry`
  bool masked() const { return mask.data() != nullptr; }
};

// The maps by number.
std::map<std::uint32_t, Channel> read_channels(const SourceFile& file, Monitor& monitor) {
  BinaryCursor cursor(file, file.bytes().substr(mark.size()), "its outermost object");
  const Object container = take_object(cursor);
  if (container.name != "GwyContainer")
    refuse_file(file, "holds an object " + shown(container.name) + " instead of a GwyContainer");
  warn_of_bytes_over(file, cursor.left(), monitor);
  std::map<std::uint32_t, Channel> channels;
  for_each(file, container.content, [&](const Component& part) {
    if (!part.name.starts_with('/')) return;
    std::uint32_t number = 0;
    const char* const end = part.name.data() + part.name.size();
    const auto [at, failure] = std::from_chars(part.name.data() + 1, end, number);
    if (failure != std::errc()) return;
    const std::string_view rest(at, static_cast<std::size_t>(end - at));
    if (rest == "/data" && part.type == 'o') {
      const Object object = object_of(file, part);
      if (object.name == "GwyDataField") channels[number].field = object.content;
    }
    if (rest == "/data/title" && part.type == 's')
      channels[number].title = plain_text(std::string(part.data));
    if (rest == "/mask" && part.type == 'o') channels[number].mask = object_of(file, part).content;
    if (rest == "/meta" && part.type == 'o')
      for_each(file, object_of(file, part).content, [&](const Component& entry) {
        if (entry.name == hole_entry && entry.type == 's')
          channels[number].holes = plain_text(std::string(entry.data));
      });
  });
  std::erase_if(channels, [](const auto& entry) { return entry.second.field.data() == nullptr; });
  return channels;
}

// `channel`: title or number. Default: the first map of lengths, else the first map.
std::map<std::uint32_t, Channel>::const_iterator chosen(const SourceFile& file,
                                                        const std::map<std::uint32_t, Channel>& channels,
                                                        const std::string& channel) {
  if (channels.empty()) refuse_file(file, "holds no map", "maps are the GwyDataFields of a Gwyddion file");
  if (channel.empty()) {
    for (auto found = channels.begin(); found != channels.end(); ++found)
      if (exact_unit(read_field(file, found->second.field).unit_z)) return found;
    return channels.begin();
  }
  std::vector<std::string> titles, listed;
  for (auto found = channels.begin(); found != channels.end(); ++found) {
    const auto& [number, entry] = *found;
    if (entry.title == channel || std::to_string(number) == channel) return found;
    titles.push_back(entry.title);
    listed.push_back(std::to_string(number) + (entry.title.empty() ? "" : " \"" + entry.title + "\""));
  }
  refuse_file(
      file,
      "holds no map " + quoted(channel) + did_you_mean(channel, titles) + " but " + joined(listed, " and "),
      "name one by its number or its title with `channel`");
}

// If mask and metadata disagree on the count, the user has changed the mask.
void take_out_holes(const SourceFile& file, const Channel& entry, const std::string& name, Field& heights) {
  const DataField mask = entry.masked() ? read_field(file, entry.mask) : DataField{};
  const std::size_t count = heights.size();
  if (entry.masked() &&
      (mask.nx != heights.nx() || mask.ny != heights.ny() || mask.data.size() != count * sizeof(double)))
    refuse_file(file, "has a mask of " + std::to_string(mask.nx) + " x " + std::to_string(mask.ny) +
                          " points over " + name + " of " + std::to_string(heights.nx()) + " x " +
                          std::to_string(heights.ny()));
  std::size_t holes = 0;
  for (std::size_t k = 0; entry.masked() && k < count; ++k) {
    if (!(little_endian<double>(mask.data.data() + k * sizeof(double)) > 0.5)) continue;
    heights[k] = std::numeric_limits<double>::quiet_NaN();
    ++holes;
  }
  if (!entry.holes->starts_with(std::to_string(holes) + " "))
    refuse_file(file,
                "holds " + name + " with " + std::to_string(holes) + " masked points, and its metadata say " +
                    shown(*entry.holes),
                "restore the mask, or delete \"" + std::string(hole_entry) +
                    "\" from its metadata to read every point");
}

HeightMap read_gwy_channel(const SourceFile& file, const std::string& channel, Monitor& monitor) {
  const auto channels = read_channels(file, monitor);
  const auto& [number, entry] = *chosen(file, channels, channel);
  const DataField field = read_field(file, entry.field);
  const auto side = [](std::int32_t count) { return count < 0 ? 0 : static_cast<std::uint64_t>(count); };
  const std::string name =
      "the map " + std::to_string(number) + (entry.title.empty() ? "" : " \"" + entry.title + "\"");
  HeightMap map;
  map.heights = exact_field(file, number_type<double>, field.data, side(field.nx), side(field.ny), monitor);
  map.unit = exact_unit(field.unit_z);
  if (!map.unit && !field.unit_z.empty())
    refuse_file(file, "holds " + name + " in " + shown(field.unit_z) + ", which is no unit of length",
                "name a map of heights by its number or its title with `channel`");
  map.trace = field.ny == 1;
  if (const auto unit = exact_unit(field.unit_xy)) {
    for (const double size : {field.size_x, field.size_y})
      if (!(size > 0) || !std::isfinite(size))
        refuse_file(file, "gives " + name + " a size of " + format_short(size));
    map.size_x = field.size_x * *unit;
    map.size_y = field.size_y * *unit;
  }
  if (entry.holes)
    take_out_holes(file, entry, name, map.heights);
  else if (entry.masked())
    monitor.warn(file_name(file.path()) + ": " + name +
                 " has a mask, which is not applied: all its points are read");
  return map;
}

// --- writing

std::string ended(std::string_view text) { return std::string(text) + '\0'; }
std::string object(std::string_view name, std::string_view content) {
  return ended(name) + raw_bytes(static_cast<std::uint32_t>(content.size())) + std::string(content);
}
std::string unit_object(std::string_view unit) {
  return object("GwySIUnit", ended("unitstr") + "s" + ended(unit));
}

}  // namespace

extern constexpr Format gwy_format{
    "gwy",
    "GWYP at the start",
    {"Gwyddion's own files: any of their maps; a mask only where it says that points were not measured.",
     "Maps that are no lengths, unless named with `channel`, volumes and curves.",
     "The published layout, and files that this program writes; no instrument's file was compared."},
    {FirstLine::top, "Gwyddion's data fields begin at the top left."},
    {"gwy"},
    begins_with<mark>,
    nullptr,
    read_gwy_channel};

// Throws Error{bad_value} above 4 GiB including the mask, and Error{bad_file}.
void write_gwy(const Surface& surface, const std::string& path) {
  const Grid& grid = surface.grid();
  const auto heights = surface.measured_heights().values();
  const bool holes = !surface.complete();
  // Lengths include the text around heights and mask.
  constexpr std::uint64_t most = std::uint64_t{0xFFFFFFFF} - 65536;
  if ((holes ? 2 : 1) * heights.size_bytes() > most)
    refuse("a surface of " + std::to_string(heights.size()) + " heights" +
               (holes ? " and a mask of its holes do" : " does") + " not fit into a GWY file",
           "write .h5 or .npy");
  const auto field_head = [&](std::string_view key, std::string_view unit_z) {
    const std::string before = ended("xres") + "i" + raw_bytes(grid.nx) + ended("yres") + "i" +
                               raw_bytes(grid.ny) + ended("xreal") + "d" + raw_bytes(grid.size_x) +
                               ended("yreal") + "d" + raw_bytes(grid.size_y) + ended("si_unit_xy") + "o" +
                               unit_object("m") + ended("si_unit_z") + "o" + unit_object(unit_z) +
                               ended("data") + "D" + raw_bytes(static_cast<std::uint32_t>(heights.size()));
    return ended(key) + "o" + ended("GwyDataField") +
           raw_bytes(static_cast<std::uint32_t>(before.size() + heights.size_bytes())) + before;
  };
  const std::string first = ended("/0/data/title") + "s" + ended("height") + field_head("/0/data", "m");
  std::string second, last;
  if (holes) {
    second = field_head("/0/mask", "");
    last = ended("/0/meta") + "o" +
           object("GwyContainer", ended(hole_entry) + "s" +
                                      ended(std::to_string(grid.nodes() - surface.measured()) +
                                            " points, those under the mask"));
  }
  const std::uint64_t length =
      first.size() + second.size() + last.size() + (holes ? 2 : 1) * heights.size_bytes();
  AtomicFile file(path, FileWords::data);
  file.write(std::string(mark) + ended("GwyContainer") + raw_bytes(static_cast<std::uint32_t>(length)) +
             first);
  const double average = holes ? known_mean(heights) : 0;
  const auto write_rows = [&](auto&& value) {
    Array<double> row(static_cast<std::size_t>(grid.nx));
    for (int j = 0; j < grid.ny; ++j) {
      std::ranges::transform(surface.measured_heights().row(j), row.begin(), value);
      file.write({reinterpret_cast<const char*>(row.data()), row.size() * sizeof(double)});
    }
  };
  write_rows([&](double height) { return std::isnan(height) ? average : height; });
  if (holes) {
    file.write(second);
    write_rows([](double height) { return std::isnan(height) ? 1.0 : 0.0; });
    file.write(last);
  }
  file.commit();
}

}  // namespace asperity
