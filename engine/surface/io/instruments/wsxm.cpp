// SPDX-License-Identifier: GPL-3.0-or-later
// STP and TOP of WSxM (Nanotec): header lines `key: value`, then double, float or short numbers. Unit of
// height: `Z Amplitude` / (greatest - least number); the printed unit, if equal to 1e-4 for floating-point
// numbers (six printed digits). The file begins at the lower right corner. Non-finite numbers are missing
// points. Layout and orientation: Gwyddion's reader and writer.
#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view wsxm_mark = "WSxM file copyright", wsxm_end = "[Header end]";
constexpr std::string_view wsxm_size_key = "Image header size:";

struct WsxmHeader {
  std::map<std::string, std::string_view> entries;  // "Control::X Amplitude"
  std::string_view data;
};

WsxmHeader wsxm_header(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  require_format(file, bytes.starts_with(wsxm_mark),
                 "is not a WSxM file: it does not start with \"WSxM file copyright\"");
  LineReader reader(bytes);
  std::string_view line;
  std::string section;
  WsxmHeader header;
  while (reader.next(line)) {
    line = trimmed(line);
    if (reader.number() == 2 && line != "SxM Image file")
      refuse_file(file, "is a WSxM file of the kind " + shown(line), "images (\"SxM Image file\") are read");
    if (line.starts_with(wsxm_size_key)) {
      const std::uint64_t size =
          instrument_count(file, "Image header size", line.substr(wsxm_size_key.size()));
      if (size > bytes.size()) refuse_file(file, "is cut short in its header");
      const std::string_view head = bytes.substr(0, size);
      const std::size_t end = head.rfind(wsxm_end);
      if (end == std::string_view::npos ||
          head.find_first_not_of(" \r\n", end + wsxm_end.size()) != std::string_view::npos)
        refuse_file(
            file,
            "has no [Header end] before byte " + std::to_string(size) + ", where its numbers should begin",
            "its header is wrong or the file is damaged");
      header.data = bytes.substr(size);
    }
    if (line == wsxm_end) {
      if (header.data.data() == nullptr) refuse_file(file, "has no `Image header size` in its header");
      return header;
    }
    if (line.starts_with('[') && line.ends_with(']')) section = line.substr(1, line.size() - 2);
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) continue;
    header.entries.emplace(section + "::" + std::string(trimmed(line.substr(0, colon))),
                           trimmed(line.substr(colon + 1)));
  }
  refuse_file(file, "has a header without [Header end]", "the file is cut short");
}

std::string_view wsxm_entry(const SourceFile& file, const WsxmHeader& header, const std::string& key) {
  const auto found = header.entries.find(key);
  if (found == header.entries.end()) refuse_file(file, "has no " + quoted(key) + " in its header");
  return found->second;
}

template <class T>
Field wsxm_numbers(const SourceFile& file, std::string_view data, std::uint64_t nx, std::uint64_t ny,
                   Monitor& monitor) {
  require_exactly(file, nx, ny, sizeof(T), data.size());
  return field_of_numbers<T>(data, static_cast<int>(nx), static_cast<int>(ny), monitor,
                             [](T value) { return !std::isfinite(static_cast<double>(value)); });
}

// In metres.
double wsxm_unit(const SourceFile& file, const Field& numbers, double amplitude, double printed_unit,
                 bool integers) {
  double least = INFINITY, greatest = -INFINITY;
  for (const double value : numbers.values()) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  const double unit = amplitude / (greatest - least);
  if (!(unit > 0) || !std::isfinite(unit))
    refuse_file(file,
                "holds numbers from " + format_short(least) + " to " + format_short(greatest) +
                    ", so that its Z Amplitude gives no scale",
                "export its heights as text, and give their `unit`");
  constexpr double printed_digits = 1e-4;
  return !integers && std::abs(unit / printed_unit - 1) < printed_digits ? printed_unit : unit;
}

HeightMap read_wsxm(const SourceFile& file, Monitor& monitor) {
  const WsxmHeader header = wsxm_header(file);
  const auto count = [&](const char* key) {
    return instrument_count(file, key, wsxm_entry(file, header, std::string("General Info::") + key));
  };
  const std::uint64_t nx = count("Number of columns"), ny = count("Number of rows");
  const std::string_view amplitude_text = wsxm_entry(file, header, "General Info::Z Amplitude");
  const std::size_t blank = amplitude_text.rfind(' ');
  const std::optional<double> printed_unit =
      blank == std::string_view::npos ? std::nullopt : instrument_length_unit(amplitude_text.substr(blank));
  if (!printed_unit)
    refuse_file(file, "holds a map whose Z Amplitude is " + shown(amplitude_text) + ", which is no length",
                "maps of heights are read");
  const double amplitude = instrument_length(file, "Z Amplitude", amplitude_text);
  const auto type = header.entries.find("General Info::Image Data Type");
  // Early versions omit the type and hold short integers.
  const std::string kind = type == header.entries.end() ? "short" : std::string(type->second);
  HeightMap map;
  Field numbers;
  if (kind == "double")
    numbers = wsxm_numbers<double>(file, header.data, nx, ny, monitor);
  else if (kind == "float")
    numbers = wsxm_numbers<float>(file, header.data, nx, ny, monitor);
  else if (kind == "short" || kind == "integer")
    numbers = wsxm_numbers<std::int16_t>(file, header.data, nx, ny, monitor);
  else
    refuse_file(file, "holds numbers of the type " + shown(kind),
                "double, float, short and integer are read");
  map.unit = wsxm_unit(file, numbers, amplitude, *printed_unit, kind == "short" || kind == "integer");
  map.heights = lines_reversed(numbers);
  map.size_x = instrument_length(file, "X Amplitude", wsxm_entry(file, header, "Control::X Amplitude"));
  map.size_y = instrument_length(file, "Y Amplitude", wsxm_entry(file, header, "Control::Y Amplitude"));
  map.trace = ny == 1;
  return map;
}

bool recognises_wsxm(const SourceFile& file) {
  return file.bytes().starts_with(wsxm_mark) &&
         file.bytes().substr(0, 256).find("SxM Image file") != std::string_view::npos;
}

}  // namespace

const Format& wsxm_format() {
  static const Format format{
      "wsxm",
      "`WSxM file copyright` and `SxM Image file` at the start",
      {"STP and TOP of WSxM: the map of heights, of double, float or short numbers.",
       "Maps of other quantities, spectra, movies, and maps of one height only.",
       "Two files of the public test set of SurfaceTopography (double, short): heights and sizes, by an "
       "independent program."},
      {FirstLine::bottom, "Gwyddion's reader and WSxM's page of formats: lines by ascending y, x falling."},
      {"stp", "top"},
      recognises_wsxm,
      read_wsxm};
  return format;
}

}  // namespace asperity
