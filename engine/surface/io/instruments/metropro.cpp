// SPDX-License-Identifier: GPL-3.0-or-later
// MetroPro of Zygo's interferometers, big-endian: header, camera intensities, 32-bit phases. Height = phase ·
// scale factor · wavelength · obliquity factor / R; R = 4096, 32768 or 131072 for a phase resolution of 0, 1
// or 2. The header may invert the sign. Phases from 2147483640 on are missing. Source: SurfaceTopography's
// and Gwyddion's readers, after the MetroPro Reference Guide.
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::array<std::string_view, 3> metropro_marks{"\x88\x1B\x03\x6F", "\x88\x1B\x03\x70",
                                                         "\x88\x1B\x03\x71"};

struct MetroProHeader {
  std::uint64_t nx = 0, ny = 0;
  double unit = 0, spacing = 0;
  bool inverted = false;
  std::size_t data_at = 0;
};

bool recognises_metropro(const SourceFile& file) {
  for (const std::string_view mark : metropro_marks)
    if (file.bytes().starts_with(mark)) return true;
  return false;
}

MetroProHeader read_metropro_header(const SourceFile& file) {
  constexpr std::size_t short_header = 834, long_header = 4096;
  const std::string_view bytes = file.bytes();
  if (bytes.size() < short_header)
    refuse_file(file, "is cut short in its header of " + std::to_string(short_header) + " bytes");
  const auto word = [&](std::size_t at) { return std::uint64_t{big_endian<std::uint16_t>(&bytes[at])}; };
  const auto number = [&](std::size_t at) { return static_cast<double>(big_endian<float>(&bytes[at])); };
  const std::uint64_t size = big_endian<std::uint32_t>(&bytes[6]);
  if (size != short_header && size != long_header)
    refuse_file(file, "says that its header has " + std::to_string(size) + " bytes",
                "headers of 834 and 4096 bytes are read");
  const std::uint64_t pictures = 2 * word(52) * word(54) * word(56);
  if (const std::uint64_t said = big_endian<std::uint32_t>(&bytes[60]); said != pictures)
    refuse_file(file, "says that its intensities have " + std::to_string(said) + " bytes, and " +
                          std::to_string(word(56)) + " of " + std::to_string(word(52)) + " x " +
                          std::to_string(word(54)) + " take " + std::to_string(pictures));
  MetroProHeader header;
  header.data_at = static_cast<std::size_t>(size + pictures);
  header.nx = word(68);
  header.ny = word(70);
  if (header.nx == 0 || header.ny == 0)
    refuse_file(file, "holds no phases, so it has no heights", "save the measurement with its phase data");
  if (header.data_at > bytes.size())
    refuse_file(file, "is cut short: its header and its intensities take " + std::to_string(header.data_at) +
                          " bytes and it has " + std::to_string(bytes.size()));
  constexpr std::array<double, 3> resolutions{4096, 32768, 131072};
  const std::uint64_t resolution = word(218);
  if (resolution >= resolutions.size())
    refuse_file(file, "gives " + std::to_string(resolution) + " as the resolution of its phases",
                "0, 1 and 2 are known");
  header.unit = number(164) * number(168) * number(176) / resolutions[resolution];
  header.spacing = number(184);
  header.inverted = word(232) != 0;
  if (!std::isfinite(header.unit) || header.unit == 0)
    refuse_file(file, "gives its heights no usable scale: scale " + format_short(number(164)) +
                          ", wavelength " + format_short(number(168)) + " m, obliquity " +
                          format_short(number(176)));
  if (!(header.spacing >= 0) || !std::isfinite(header.spacing))
    refuse_file(file, "gives " + format_short(header.spacing) + " m as the distance of its points");
  return header;
}

HeightMap read_metropro(const SourceFile& file, Monitor& monitor) {
  const MetroProHeader header = read_metropro_header(file);
  const std::string_view data = file.bytes().substr(header.data_at);
  constexpr double least_missing = 2147483640;
  HeightMap map;
  map.heights = exact_field(file, number_type<std::int32_t, big_endian<std::int32_t>>, data, header.nx,
                            header.ny, monitor, [](double phase) { return phase >= least_missing; });
  if (header.inverted != (header.unit < 0))
    for (double& height : map.heights.values()) height = -height;
  map.unit = std::abs(header.unit);
  if (header.spacing > 0) {
    map.size_x = header.spacing * map.heights.nx();
    map.size_y = header.spacing * map.heights.ny();
  }
  return map;
}

}  // namespace

extern constexpr Format metropro_format{
    "metropro",
    "88 1B 03 6F, 70 or 71 at the start",
    {"MetroPro (.dat) of Zygo interferometers: the phase map, of headers 1, 2 and 3.",
     "Files of intensities alone; intensities are passed over.",
     "A file of the public test set of SurfaceTopography (header 1, resolution 1), every height and size; "
     "it has no missing points."},
    {FirstLine::top, "Gwyddion's reader shows the first line at the top."},
    {},  // ambiguous
    recognises_metropro,
    read_metropro};

}  // namespace asperity
