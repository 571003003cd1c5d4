// SPDX-License-Identifier: GPL-3.0-or-later
// OPD of Wyko, Veeco and Bruker interferometers: a directory of named blocks. The map, column by column, is
// in wavelengths (`Wavelength`, nm) or, as integers, in fractions of one (`Mult`). `Pixel_size` is in mm
// along x, `Aspect` times as much along y. Missing points: from 1e38 on; 32766 and 32767 in 16 bits.
// Layout: Gwyddion's and SurfaceTopography's readers.
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view opd_mark(
    "\x01\x00"
    "Directory",
    11);
constexpr std::size_t entry_bytes = 24, name_bytes = 16, start = 2;
// In order of preference.
constexpr std::array<std::string_view, 5> map_names{"RAW_DATA", "RAW DATA", "OPD", "SAMPLE_DATA", "Raw"};

struct Block {
  std::string name;
  int type = 0;
  std::string_view data;
};

std::vector<Block> read_directory(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  BinaryCursor head(file, bytes.substr(start), "its directory");
  head.skip(name_bytes + 2);
  const std::size_t length = head.number<std::uint32_t>();
  if (length < entry_bytes || length % entry_bytes != 0)
    refuse_file(file,
                "has a directory of " + std::to_string(length) + " bytes, which is no number of entries");
  BinaryCursor cursor(file, bytes.substr(start), "its directory");
  cursor.skip(entry_bytes);
  std::size_t at = start + length;
  std::vector<Block> blocks;
  for (std::size_t k = 1; k < length / entry_bytes; ++k) {
    Block block;
    block.name = std::string(cursor.text(name_bytes));
    block.type = cursor.number<std::int16_t>();
    const std::size_t size = cursor.number<std::uint32_t>();
    cursor.skip(2);
    if (size == 0) continue;
    block.data = bytes_at(file, at, size, "the block " + shown(block.name));
    at += size;
    blocks.push_back(std::move(block));
  }
  return blocks;
}

const Block* find(const std::vector<Block>& blocks, std::string_view name) {
  for (const Block& block : blocks)
    if (block.name == name) return &block;
  return nullptr;
}

// Accepts any number type.
std::optional<double> number_of(const SourceFile& file, const std::vector<Block>& blocks,
                                std::string_view name) {
  const Block* const block = find(blocks, name);
  if (block == nullptr) return {};
  BinaryCursor cursor(file, block->data, "its block " + std::string(name));
  const std::map<int, NumberType> types{{6, number_type<std::int16_t>},
                                        {7, number_type<float>},
                                        {8, number_type<double>},
                                        {12, number_type<std::int32_t>}};
  const auto type = types.find(block->type);
  if (type == types.end())
    refuse_file(file, "has a block " + std::string(name) + " of type " + std::to_string(block->type) +
                          ", which is no number");
  return above_zero(file, type->second.read(cursor.take(type->second.width).data()),
                    "as its " + std::string(name));
}

const Block& map_block(const SourceFile& file, const std::vector<Block>& blocks, const std::string& channel) {
  constexpr int array_type = 3;
  std::vector<const Block*> arrays;
  std::vector<NamedMap> maps;
  for (const Block& block : blocks)
    if (block.type == array_type) {
      arrays.push_back(&block);
      maps.push_back({plain_text(block.name)});
    }
  for (const auto& usual : map_names)
    if (const auto found = std::ranges::find(arrays, usual, &Block::name); found != arrays.end()) {
      maps[static_cast<std::size_t>(found - arrays.begin())].heights = true;
      break;
    }
  return *arrays[chosen_map(file, maps, channel)];
}

HeightMap read_opd_channel(const SourceFile& file, const std::string& channel, Monitor& monitor) {
  const std::vector<Block> blocks = read_directory(file);
  const Block& block = map_block(file, blocks, channel);
  BinaryCursor cursor(file, block.data, "its block " + plain_text(block.name));
  const int nx = cursor.number<std::uint16_t>(), ny = cursor.number<std::uint16_t>();
  const int width = cursor.number<std::uint16_t>();
  const std::string_view data = block.data.substr(cursor.position());
  if (width != 2 && width != 4)
    refuse_file(file, "holds heights of " + std::to_string(width) + (width == 1 ? " byte" : " bytes"),
                "integers of 2 bytes and floating-point numbers of 4 are read");
  require_exactly(file, static_cast<std::uint64_t>(nx), static_cast<std::uint64_t>(ny),
                  static_cast<std::uint64_t>(width), data.size());
  const auto is_missing = [&](double v) {
    constexpr double least_bad = 1e38F, least_bad_integer = 32766;
    return width == 4 ? !(std::abs(v) < least_bad) : v >= least_bad_integer || v == -32768;
  };
  const Field columns =
      field_of_numbers(width == 2 ? number_type<std::int16_t> : number_type<float>, data,
                       static_cast<std::uint64_t>(ny), static_cast<std::uint64_t>(nx), monitor, is_missing);
  HeightMap map;
  map.heights = Field(nx, ny);
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) map.heights(i, j) = columns(j, i);
  constexpr double nanometre = 1e-9, millimetre = 1e-3;
  if (const auto wavelength = number_of(file, blocks, "Wavelength"))
    map.unit = *wavelength * nanometre / number_of(file, blocks, "Mult").value_or(1);
  if (const auto pixel = number_of(file, blocks, "Pixel_size")) {
    map.size_x = *pixel * millimetre * nx;
    map.size_y = *pixel * millimetre * number_of(file, blocks, "Aspect").value_or(1) * ny;
  }
  return map;
}

}  // namespace

extern constexpr Format opd_format{
    "opd",
    "a directory of blocks",
    {"OPD of Wyko, Veeco and Bruker interferometers: the raw map, or another block with `channel`.",
     "Blocks that are no maps, heights of other than 2 or 4 bytes.",
     "Three files of the public test sets of SurfaceTopography and surfalize, every height, size, missing "
     "points."},
    {FirstLine::bottom, "Gwyddion's reader: y runs upwards along each stored column."},
    {"opd"},
    begins_with<opd_mark>,
    nullptr,
    read_opd_channel};

}  // namespace asperity
