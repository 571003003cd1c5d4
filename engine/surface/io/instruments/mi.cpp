// SPDX-License-Identifier: GPL-3.0-or-later
// MI of Agilent's (Molecular Imaging's) microscopes: header lines with 14-character keys, then the numbers of
// all buffers. A number n of b bits is n / 2^(b-1) of `bufferRange`, in `bufferUnit`; lengths are in metres.
// No missing points. Layout: Gwyddion's and SurfaceTopography's readers.
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view mi_mark = "fileType      Image";
constexpr std::size_t mi_key = 14;

struct MiHeader {
  HeaderEntries lines;  // before the first buffer
  std::vector<HeaderEntries> buffers;
  std::string_view kind, data;
};

MiHeader mi_header(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  MiHeader header{HeaderEntries(file), {}, {}, {}};
  std::size_t at = 0;
  while (at < bytes.size()) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string_view::npos) break;
    std::string_view line = bytes.substr(at, end - at);
    if (line.ends_with('\r')) line.remove_suffix(1);
    at = end + 1;
    if (line.size() < mi_key || line.starts_with(' ')) continue;
    const std::string_view key = trimmed(line.substr(0, mi_key)), value = trimmed(line.substr(mi_key));
    if (key == "data") {
      header.kind = value;
      header.data = bytes.substr(at);
      return header;
    }
    if (key == "bufferLabel") header.buffers.emplace_back(file);
    (header.buffers.empty() ? header.lines : header.buffers.back()).add(key, value);
  }
  refuse_file(file, "has a header without the line `data`", "the file is cut short");
}

HeightMap read_mi_channel(const SourceFile& file, const std::string& channel, Monitor& monitor) {
  const MiHeader header = mi_header(file);
  if (header.kind != "BINARY" && header.kind != "BINARY_32")
    refuse_file(file, "holds numbers of the kind " + shown(header.kind), "BINARY and BINARY_32 are read");
  const std::size_t width = header.kind == "BINARY" ? 2 : 4;
  const std::uint64_t columns = header.lines.count("xPixels"), rows = header.lines.count("yPixels");
  std::vector<NamedMap> maps;
  std::vector<std::string> traces;
  for (const HeaderEntries& buffer : header.buffers) {
    const std::string label = plain_text(std::string(buffer.text("bufferLabel")));
    const auto trace = buffer.find("trace");
    traces.push_back(trace ? ", " + plain_text(std::string(*trace)) : "");
    maps.push_back({label, label.starts_with("Topography") || label == "Height"});
  }
  tell_apart_by(maps, traces);
  const std::size_t chosen = chosen_map(file, maps, channel);
  require_numbers(file, columns, rows, width, header.data.size() / maps.size());
  const std::uint64_t in_a_map = columns * rows * width;
  if (header.data.size() != in_a_map * maps.size())
    refuse_file(file,
                "says in its header that it holds " + std::to_string(maps.size()) + " buffers of " +
                    std::to_string(columns) + " x " + std::to_string(rows) + " numbers but has " +
                    std::to_string(header.data.size()) + " bytes of data",
                "its header is wrong or the file is damaged");
  const HeaderEntries& buffer = header.buffers[chosen];
  const std::string_view unit_text = buffer.text("bufferUnit");
  const std::optional<double> unit = instrument_length_unit(unit_text);
  if (!unit) refuse_no_heights(file, maps[chosen], shown(unit_text));
  const double range = above_zero(file, buffer.number("bufferRange"), "as its bufferRange");
  const std::string_view data = header.data.substr(chosen * in_a_map, in_a_map);
  return {.heights = field_of_numbers(width == 2 ? number_type<std::int16_t> : number_type<std::int32_t>,
                                      data, columns, rows, monitor),
          .unit = *unit * range / (width == 2 ? 32768.0 : 2147483648.0),
          .size_x = header.lines.length("xLength", "m"),
          .size_y = header.lines.length("yLength", "m"),
          .trace = rows == 1};
}

}  // namespace

extern constexpr Format mi_format{
    "mi",
    "`fileType      Image` at the start",
    {"MI of Agilent and Molecular Imaging: the buffer of topography, or another in "
     "a unit of length with `channel`.",
     "Spectra, numbers written as text, buffers of other quantities.",
     "A file of the public test set of SurfaceTopography: size, heights, and the "
     "one that its tests state."},
    {FirstLine::bottom, "Gwyddion's reader shows the first line at the bottom."},
    {"mi"},
    begins_with<mi_mark>,
    nullptr,
    read_mi_channel};

}  // namespace asperity
