// SPDX-License-Identifier: GPL-3.0-or-later
// IBW, binary waves of Igor Pro 5 from Asylum Research's microscopes: two headers, numbers, note, units,
// labels. A third dimension holds several maps, named by its labels. Non-finite numbers are missing points.
// Source: WaveMetrics' technical note PTN003.
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::size_t ibw_binary_header = 64, ibw_headers = 384;
constexpr std::int16_t ibw_version = 5;

std::uint16_t ibw_sum(std::string_view bytes) {
  std::uint16_t sum = 0;
  for (std::size_t k = 0; k < ibw_headers; k += 2)
    sum = static_cast<std::uint16_t>(sum + little_endian<std::uint16_t>(bytes.data() + k));
  return sum;
}

bool recognises_ibw(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  return bytes.size() >= ibw_headers && little_endian<std::int16_t>(bytes.data()) == ibw_version &&
         ibw_sum(bytes) == 0;
}

struct IbwWave {
  std::array<std::uint32_t, 4> count{};
  std::array<double, 4> step{};
  std::string_view data_unit, x_unit, y_unit, data;
  NumberType type;
  std::vector<std::string> names;  // empty if unnamed
};

// Labels of 32 bytes; the first names the dimension.
std::vector<std::string> ibw_labels(const SourceFile& file, std::string_view bytes) {
  constexpr std::size_t label_bytes = 32;
  std::vector<std::string> labels;
  BinaryCursor cursor(file, bytes, "its labels");
  while (cursor.left() >= label_bytes) labels.push_back(plain_text(std::string(cursor.text(label_bytes))));
  if (!labels.empty()) labels.erase(labels.begin());
  return labels;
}

IbwWave ibw_wave(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  BinaryCursor head(file, bytes, "its header");
  head.skip(4);
  const std::uint64_t wave_bytes = head.number<std::uint32_t>();
  std::uint64_t before_labels = wave_bytes;
  // Formula, note, extended units, labels of rows and columns.
  for (int k = 0; k < 9; ++k) before_labels += head.number<std::uint32_t>();
  const std::uint64_t label_bytes = head.number<std::uint32_t>();
  BinaryCursor wave(file, bytes.substr(ibw_binary_header), "its header");
  wave.skip(12);
  const std::uint64_t points = wave.number<std::uint32_t>();
  const int type = wave.number<std::int16_t>();
  wave.skip(50);
  IbwWave found;
  for (std::uint32_t& count : found.count) count = wave.number<std::uint32_t>();
  for (double& step : found.step) step = wave.number<double>();
  wave.skip(4 * sizeof(double));
  found.data_unit = wave.text(4);
  found.x_unit = wave.text(4);
  found.y_unit = wave.text(4);
  constexpr int single_type = 2, double_type = 4;
  if (type != single_type && type != double_type)
    refuse_file(file, "is a wave of numbers of type " + std::to_string(type),
                "floating-point numbers of 32 bits (type 2) and 64 (type 4) are read");
  found.type = type == single_type ? number_type<float> : number_type<double>;
  if (found.count[0] == 0 || found.count[1] == 0 || found.count[3] != 0)
    refuse_file(file,
                "is a wave that is no map: its dimensions have " + std::to_string(found.count[0]) + ", " +
                    std::to_string(found.count[1]) + ", " + std::to_string(found.count[2]) + " and " +
                    std::to_string(found.count[3]) + " numbers",
                "waves of two dimensions are read, or of three with the maps in the last");
  const std::uint64_t maps = found.count[2] == 0 ? 1 : found.count[2];
  constexpr std::uint64_t wave_header = ibw_headers - ibw_binary_header;
  if (wave_bytes < wave_header || ibw_binary_header + wave_bytes > bytes.size())
    refuse_file(file,
                "says that its wave takes " + std::to_string(wave_bytes) + " bytes and has " +
                    std::to_string(bytes.size()) + " in all",
                "the file is cut short or its header is wrong");
  // Both byte counts may include padding.
  found.data = bytes.substr(ibw_headers, wave_bytes - wave_header);
  require_numbers(file, found.count[0], found.count[1], found.type.width, found.data.size());
  const std::uint64_t in_a_map = std::uint64_t{found.count[0]} * found.count[1];
  if (in_a_map > points || points / in_a_map != maps || points % in_a_map != 0 ||
      points != found.data.size() / found.type.width)
    refuse_file(file,
                "says that it holds " + std::to_string(maps) + " maps of " + std::to_string(found.count[0]) +
                    " x " + std::to_string(found.count[1]) + " and " + std::to_string(points) +
                    " numbers, and has " + std::to_string(found.data.size()) + " bytes",
                "the file is cut short or its header is wrong");
  before_labels += ibw_binary_header;
  if (before_labels > bytes.size() || label_bytes > bytes.size() - before_labels)
    refuse_file(file, "is cut short in its labels");
  found.names = ibw_labels(file, bytes.substr(before_labels, label_bytes));
  if (found.names.size() > maps) found.names.resize(maps);
  return found;
}

bool starts_with_any(const std::string& name, std::initializer_list<const char*> starts) {
  const std::string lower = lower_case(name);
  return std::ranges::any_of(starts, [&](const char* start) { return lower.starts_with(start); });
}

HeightMap read_ibw_channel(const SourceFile& file, const std::string& channel, Monitor& monitor) {
  const IbwWave wave = ibw_wave(file);
  const std::size_t bytes_a_map = std::size_t{wave.count[0]} * wave.count[1] * wave.type.width;
  const std::size_t count = wave.data.size() / bytes_a_map;
  std::vector<NamedMap> maps;
  for (std::size_t k = 0; k < count; ++k) {
    const bool named = k < wave.names.size() && !wave.names[k].empty();
    const std::string name = named ? wave.names[k] : "map " + std::to_string(k + 1);
    maps.push_back({name, count == 1 || starts_with_any(name, {"height", "zsensor"})});
  }
  tell_apart(maps);
  const std::size_t chosen = chosen_map(file, maps, channel);
  const auto unit_of = [&](std::string_view text, const std::string& what) -> std::optional<double> {
    if (text.empty()) return {};
    const std::optional<double> metres = instrument_length_unit(text);
    if (!metres) refuse_file(file, "gives " + what + " in " + shown(text) + ", which is no unit of length");
    return metres;
  };
  // One unit for all maps, even of other quantities.
  if (count > 1 &&
      !starts_with_any(maps[chosen].name, {"height", "zsensor", "map ", "deflection", "amplitude"}))
    refuse_file(file, "holds the map " + quoted(maps[chosen].name) + ", which is not of heights",
                "name a map of heights with `channel`");
  const std::string_view data = wave.data.substr(chosen * bytes_a_map, bytes_a_map);
  const auto size_of = [&](std::size_t axis, std::string_view unit) -> std::optional<double> {
    const std::optional<double> metres = unit_of(unit, axis == 0 ? "its x" : "its y");
    if (!metres) return {};
    return above_zero(file, wave.step[axis], "as the step between its points") * wave.count[axis] * *metres;
  };
  return {.heights = field_of_numbers(wave.type, data, wave.count[0], wave.count[1], monitor, not_finite),
          .unit = unit_of(wave.data_unit, "its heights"),
          .size_x = size_of(0, wave.x_unit),
          .size_y = size_of(1, wave.y_unit),
          .trace = wave.count[1] == 1};
}

}  // namespace

extern constexpr Format ibw_format{
    "ibw",
    "version 5 and a header whose sum is 0",
    {"Binary waves of Igor Pro, version 5, as Asylum Research's microscopes write "
     "them: the map of heights, or another by `channel`.",
     "Waves of integers and complex numbers, of other dimensions, of older versions "
     "and of big-endian machines.",
     "Two files of the public test set of SurfaceTopography: heights and sizes, by "
     "an independent program."},
    {FirstLine::bottom, "WaveMetrics gives coordinates: y is the column of a wave times its step."},
    {"ibw"},
    recognises_ibw,
    nullptr,
    read_ibw_channel};

}  // namespace asperity
