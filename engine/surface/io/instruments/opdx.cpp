// SPDX-License-Identifier: GPL-3.0-or-later
// OPDx of Bruker's Vision64 (Dektak stylus profilometers): nested items of name, type and value. A profile
// is the container /1D_Data/NAME; `Extent` spans the first to the last sample. Non-finite numbers are
// missing samples. Layout: SurfaceTopography's reader. Maps (`2D_Data`) are refused for lack of a test file.
#include <initializer_list>

#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view opdx_mark("VCA DATA\x01\0\0\x55", 12);
constexpr const char* opdx_piece = "its items";

enum class OpdxType : std::uint8_t {
  matrix = 0x00,
  boolean = 0x01,
  int16 = 0x04,
  uint16 = 0x05,
  int32 = 0x06,
  uint32 = 0x07,
  int64 = 0x0A,
  uint64 = 0x0B,
  single_number = 0x0C,
  double_number = 0x0D,
  type_id = 0x0E,
  text = 0x12,
  quantity = 0x13,
  time_stamp = 0x15,
  unit = 0x18,
  array = 0x40,
  names = 0x42,
  raw_profile = 0x46,
  raw_map = 0x47,
  positions = 0x7C,
  container = 0x7D,
  end = 0x7F
};

struct OpdxItem {
  OpdxType type{};
  std::string_view value;
};
using OpdxItems = std::map<std::string, OpdxItem>;

std::string_view opdx_name(BinaryCursor& cursor) { return cursor.take(cursor.number<std::uint32_t>()); }

std::size_t opdx_length(const SourceFile& file, BinaryCursor& cursor) {
  const int width = cursor.number<std::uint8_t>();
  if (width == 1) return cursor.number<std::uint8_t>();
  if (width == 2) return cursor.number<std::uint16_t>();
  if (width == 4) return cursor.number<std::uint32_t>();
  refuse_file(
      file, "is an OPDx file of Bruker with a length of " + std::to_string(width) + " bytes among its items",
      "the file is damaged");
}

std::string_view opdx_value(const SourceFile& file, BinaryCursor& cursor, OpdxType type,
                            const std::string& path) {
  using enum OpdxType;
  const auto is_one_of = [&](std::initializer_list<OpdxType> types) {
    return std::ranges::find(types, type) != types.end();
  };
  if (type == boolean) return cursor.take(1);
  if (is_one_of({int16, uint16})) return cursor.take(2);
  if (is_one_of({int32, uint32, single_number})) return cursor.take(4);
  if (is_one_of({int64, uint64, double_number})) return cursor.take(8);
  if (type == time_stamp) return cursor.take(9);
  if (type == matrix) {
    opdx_name(cursor);
    cursor.skip(4);
  }
  if (is_one_of({matrix, type_id, array, names, positions})) {
    opdx_name(cursor);
  } else if (!is_one_of({container, raw_profile, raw_map, text, quantity, unit})) {
    refuse_file(file, "has an item " + shown(path) + " of the unknown type " +
                          std::to_string(static_cast<int>(type)));
  }
  return cursor.take(opdx_length(file, cursor));
}

// Recursive; the path of an item starts with its container's path.
void read_opdx_items(const SourceFile& file, std::string_view bytes, const std::string& prefix, int depth,
                     OpdxItems& items) {
  constexpr int deepest = 8;
  if (depth > deepest) refuse_file(file, "has containers within containers without end");
  BinaryCursor cursor(file, bytes, opdx_piece);
  while (cursor.left() > 0) {
    const std::string_view name = opdx_name(cursor);
    const auto type = static_cast<OpdxType>(cursor.number<std::uint8_t>());
    if (type == OpdxType::end) return;
    // Longer paths indicate damage.
    constexpr std::size_t longest_path = 256;
    if (prefix.size() + name.size() >= longest_path)
      refuse_file(file, "has an item with a name of " + std::to_string(name.size()) + " bytes",
                  "the file is damaged");
    const std::string path = prefix + "/" + std::string(name);
    const std::string_view value = opdx_value(file, cursor, type, path);
    if (type == OpdxType::container || type == OpdxType::raw_profile || type == OpdxType::raw_map)
      read_opdx_items(file, value, path, depth + 1, items);
    items.emplace(path, OpdxItem{type, value});
  }
}

OpdxItem opdx_item(const SourceFile& file, const OpdxItems& items, const std::string& path, OpdxType type) {
  const auto found = items.find(path);
  if (found == items.end() || found->second.type != type)
    refuse_file(file, "has no " + quoted(path) + " among its items, or one of another type",
                "profiles of Dektak profilometers are read");
  return found->second;
}

// Value, unit name, unit symbol.
double opdx_metres(const SourceFile& file, const OpdxItems& items, const std::string& path) {
  BinaryCursor cursor(file, opdx_item(file, items, path, OpdxType::quantity).value, path);
  const double value = cursor.number<double>();
  opdx_name(cursor);
  const std::string_view sign = opdx_name(cursor);
  const std::optional<double> unit = instrument_length_unit(sign);
  if (!unit)
    refuse_file(file, "gives " + quoted(path) + " in " + shown(sign) + ", which is no unit of length");
  return above_zero(file, value, "as " + quoted(path)) * *unit;
}

HeightMap read_opdx_channel(const SourceFile& file, const std::string& channel, Monitor& monitor) {
  OpdxItems items;
  read_opdx_items(file, file.bytes().substr(opdx_mark.size()), "", 0, items);
  const auto kind = items.find("/MetaData/DataKind");
  if (kind == items.end() || kind->second.value != "Surface Profile")
    refuse_file(
        file, "holds data of the kind " + shown(kind == items.end() ? "" : kind->second.value),
        "profiles (\"Surface Profile\") are read; save a map in Vision64 as Wyko OPD (.opd), X3P or SDF, or "
        "as .gwy in Gwyddion");
  const OpdxItem listed = opdx_item(file, items, "/MetaData/1D_Channels/Height", OpdxType::names);
  BinaryCursor names(file, listed.value, "its list of profiles");
  std::vector<NamedMap> maps;
  while (names.left() > 0) maps.push_back({plain_text(std::string(opdx_name(names))), true});
  tell_apart(maps);
  const std::string prefix = "/1D_Data/" + maps[chosen_map(file, maps, channel)].name;
  const OpdxItem points = opdx_item(file, items, prefix + "/NumPoints", OpdxType::uint64);
  const auto count = little_endian<std::uint64_t>(points.value.data());
  const std::string_view array = opdx_item(file, items, prefix + "/Array", OpdxType::array).value;
  // Number type and width precede the numbers.
  BinaryCursor cursor(file, array, "its heights");
  const int type = cursor.number<std::uint8_t>();
  const std::uint32_t width = cursor.number<std::uint32_t>();
  if (type != static_cast<int>(OpdxType::double_number) || width != sizeof(double))
    refuse_file(file,
                "holds heights of type " + std::to_string(type) + " and " + std::to_string(width) + " bytes",
                "doubles are read");
  const std::string_view data = array.substr(cursor.position());
  HeightMap map;
  map.heights = exact_field(file, number_type<double>, data, count, 1, monitor, not_finite);
  if (count < 2) refuse_file(file, "holds one sample, which is no profile");
  map.unit = opdx_metres(file, items, prefix + "/DataScale");
  map.spacing = opdx_metres(file, items, prefix + "/Extent") / static_cast<double>(count - 1);
  map.size_x = *map.spacing * static_cast<double>(count);
  map.trace = true;
  return map;
}

}  // namespace

extern constexpr Format opdx_format{
    "opdx",
    "VCA DATA at the start",
    {"OPDx of Bruker's Vision64 and Dektak profilometers: a profile.",
     "Maps, of which no file could be compared.",
     "A file of the public test set of SurfaceTopography: heights and positions, "
     "with its maker's export as text."},
    {FirstLine::bottom, "Profiles only."},
    {"opdx"},
    begins_with<opdx_mark>,
    nullptr,
    read_opdx_channel};

}  // namespace asperity
