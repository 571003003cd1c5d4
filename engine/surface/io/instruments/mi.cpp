// SPDX-License-Identifier: GPL-3.0-or-later
// MI of Agilent's (Molecular Imaging's) microscopes: header lines with 14-character keys, then the numbers
// of all buffers. A number n of b bits is n / 2^(b-1) of `bufferRange`, in `bufferUnit`; lengths are in
// metres. There are no missing points. Layout: Gwyddion's and SurfaceTopography's readers.
#include <map>

#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view mi_mark = "fileType      Image";
constexpr std::size_t mi_key = 14;

using MiLines = std::map<std::string, std::string_view>;

struct MiHeader {
  MiLines lines;  // before the first buffer
  std::vector<MiLines> buffers;
  std::string_view kind, data;
};

MiHeader mi_header(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  require_format(file, bytes.starts_with(mi_mark),
                 "is not an MI image: it does not start with \"fileType      Image\"");
  MiHeader header;
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
    if (key == "bufferLabel") header.buffers.emplace_back();
    (header.buffers.empty() ? header.lines : header.buffers.back()).emplace(key, value);
  }
  refuse_file(file, "has a header without the line `data`", "the file is cut short");
}

std::string_view mi_entry(const SourceFile& file, const MiLines& lines, const std::string& key) {
  const auto found = lines.find(key);
  if (found == lines.end()) refuse_file(file, "has no " + quoted(key) + " in its header");
  return found->second;
}

HeightMap read_mi_channel(const SourceFile& file, const std::string& channel, Monitor& monitor) {
  const MiHeader header = mi_header(file);
  if (header.kind != "BINARY" && header.kind != "BINARY_32")
    refuse_file(file, "holds numbers of the kind " + shown(header.kind), "BINARY and BINARY_32 are read");
  const std::size_t width = header.kind == "BINARY" ? 2 : 4;
  const auto count = [&](const char* key) {
    return instrument_count(file, key, mi_entry(file, header.lines, key));
  };
  const std::uint64_t columns = count("xPixels"), rows = count("yPixels");
  std::vector<NamedMap> maps;
  std::vector<std::string> traces;
  for (const MiLines& buffer : header.buffers) {
    const std::string label = plain_text(std::string(mi_entry(file, buffer, "bufferLabel")));
    const auto trace = buffer.find("trace");
    traces.push_back(trace == buffer.end() ? "" : ", " + plain_text(std::string(trace->second)));
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
  const MiLines& buffer = header.buffers[chosen];
  const std::string_view unit_text = mi_entry(file, buffer, "bufferUnit");
  const std::optional<double> unit = instrument_length_unit(unit_text);
  if (!unit) refuse_no_heights(file, maps[chosen], shown(unit_text));
  const double range = instrument_number(file, "bufferRange", mi_entry(file, buffer, "bufferRange"));
  if (!(range > 0)) refuse_file(file, "gives " + format_short(range) + " as its bufferRange");
  const std::string_view data = header.data.substr(chosen * in_a_map, in_a_map);
  const int nx = static_cast<int>(columns), ny = static_cast<int>(rows);
  HeightMap map;
  map.heights = width == 2 ? field_of_numbers<std::int16_t>(data, nx, ny, monitor)
                           : field_of_numbers<std::int32_t>(data, nx, ny, monitor);
  map.unit = *unit * range / (width == 2 ? 32768.0 : 2147483648.0);
  const auto size_of = [&](const char* key) {
    return instrument_length(file, key, std::string(mi_entry(file, header.lines, key)) + " m");
  };
  map.size_x = size_of("xLength");
  map.size_y = size_of("yLength");
  map.trace = ny == 1;
  return map;
}

bool recognises_mi(const SourceFile& file) { return file.bytes().starts_with(mi_mark); }

}  // namespace

const Format& mi_format() {
  static const Format format{"mi",
                             "`fileType      Image` at the start",
                             {"MI of Agilent and Molecular Imaging: the buffer of topography, or another in "
                              "a unit of length with `channel`.",
                              "Spectra, numbers written as text, buffers of other quantities.",
                              "A file of the public test set of SurfaceTopography: size, heights, and the "
                              "one that its tests state."},
                             {FirstLine::bottom, "Gwyddion's reader shows the first line at the bottom."},
                             {"mi"},
                             recognises_mi,
                             nullptr,
                             read_mi_channel};
  return format;
}

}  // namespace asperity
