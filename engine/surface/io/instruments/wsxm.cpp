// SPDX-License-Identifier: GPL-3.0-or-later
// STP and TOP of WSxM (Nanotec): header lines `key: value`, then double, float or short numbers. Unit of
// height: `Z Amplitude` / (greatest - least number); the printed unit, if equal to 1e-4 for floating-point
// numbers (six printed digits). The file begins at the lower right corner. Non-finite numbers are missing
// points. Layout: Gwyddion's reader and writer.
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view wsxm_mark = "WSxM file copyright", wsxm_end = "[Header end]";
constexpr std::string_view wsxm_size_key = "Image header size:";

struct WsxmHeader {
  HeaderEntries entries;  // "Control::X Amplitude"
  std::string_view data;
};

WsxmHeader wsxm_header(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  LineReader reader(bytes);
  std::string_view line;
  std::string section;
  WsxmHeader header{HeaderEntries(file), {}};
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
    header.entries.add(section + "::" + std::string(trimmed(line.substr(0, colon))),
                       trimmed(line.substr(colon + 1)));
  }
  refuse_file(file, "has a header without [Header end]", "the file is cut short");
}

// In metres.
double wsxm_unit(const SourceFile& file, const Field& numbers, double amplitude, double printed_unit,
                 bool integers) {
  const auto [least, greatest] = known_range(numbers.values());
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
  const HeaderEntries& entries = header.entries;
  const std::uint64_t nx = entries.count("General Info::Number of columns"),
                      ny = entries.count("General Info::Number of rows");
  const std::string_view amplitude_text = entries.text("General Info::Z Amplitude");
  const std::size_t blank = amplitude_text.rfind(' ');
  const std::optional<double> printed_unit =
      blank == std::string_view::npos ? std::nullopt : instrument_length_unit(amplitude_text.substr(blank));
  if (!printed_unit)
    refuse_file(file, "holds a map whose Z Amplitude is " + shown(amplitude_text) + ", which is no length",
                "maps of heights are read");
  const double amplitude = instrument_length(file, "Z Amplitude", amplitude_text);
  // Early versions hold short integers and omit the type.
  const std::string_view kind = entries.find("General Info::Image Data Type").value_or("short");
  const bool integers = kind == "short" || kind == "integer";
  if (!integers && kind != "double" && kind != "float")
    refuse_file(file, "holds numbers of the type " + shown(kind),
                "double, float, short and integer are read");
  const NumberType type = integers          ? number_type<std::int16_t>
                          : kind == "float" ? number_type<float>
                                            : number_type<double>;
  HeightMap map;
  map.heights = exact_field(file, type, header.data, nx, ny, monitor, not_finite);
  map.unit = wsxm_unit(file, map.heights, amplitude, *printed_unit, integers);
  for (int j = 0; j < map.heights.ny(); ++j) std::ranges::reverse(map.heights.row(j));
  map.size_x = instrument_length(file, "X Amplitude", entries.text("Control::X Amplitude"));
  map.size_y = instrument_length(file, "Y Amplitude", entries.text("Control::Y Amplitude"));
  map.trace = ny == 1;
  return map;
}

bool recognises_wsxm(const SourceFile& file) {
  return file.bytes().starts_with(wsxm_mark) &&
         file.bytes().substr(0, 256).find("SxM Image file") != std::string_view::npos;
}

}  // namespace

extern constexpr Format wsxm_format{
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

}  // namespace asperity
