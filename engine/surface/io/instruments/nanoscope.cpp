// SPDX-License-Identifier: GPL-3.0-or-later
// Nanoscope files of Digital Instruments, Veeco and Bruker (.spm, .di, .001) from version 4.3 on: header
// lines `\key: value` in sections `\*Name`, then integer images. Height per unit: V / 256^b · S, with V the
// final value of `\@2:Z scale` in volts, b `\Bytes/pixel`, S the sensitivity in m/V (`[Sens. Zsens]`). From
// version 9.2 on, integers have 32 bits for any b. There are no missing points. The z offset is ignored.
// Layout: Gwyddion's and SurfaceTopography's readers.
#include <cmath>
#include <map>
#include <utility>

#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view nanoscope_mark = "\\*File list", nanoscope_end = "\\*File list end";

struct NanoscopeSection {
  std::string name;                                 // without `\*`
  std::map<std::string, std::string_view> entries;  // by key
};

std::vector<NanoscopeSection> nanoscope_sections(const SourceFile& file) {
  require_format(file, file.bytes().starts_with(nanoscope_mark),
                 "is not a Nanoscope file: it does not start with \\*File list");
  std::string_view text = file.bytes();
  text = text.substr(0, text.find('\x1A'));
  std::vector<NanoscopeSection> sections;
  LineReader reader(text);
  std::string_view line;
  while (reader.next(line)) {
    line = trimmed(line);
    if (line == nanoscope_end) return sections;
    if (line.starts_with("\\*")) {
      sections.push_back({lower_case(line.substr(2)), {}});
      continue;
    }
    // Keys such as `@2:Z scale` contain a colon.
    const std::size_t colon = line.find(": ", 1);
    if (!line.starts_with('\\') || colon == std::string_view::npos) continue;
    sections.back().entries.emplace(lower_case(line.substr(1, colon - 1)), trimmed(line.substr(colon + 2)));
  }
  refuse_file(file, "has a header without \\*File list end", "the file is cut short");
}

std::string_view nanoscope_entry(const SourceFile& file, const NanoscopeSection& section,
                                 const std::string& key) {
  const auto found = section.entries.find(key);
  if (found == section.entries.end())
    refuse_file(file, "has an image without " + quoted(key) + " in its header");
  return found->second;
}

// Text in quotes, else in brackets: `S [Height] "Height Sensor"`.
std::string nanoscope_title(std::string_view value) {
  for (const auto& [first, last] : {std::pair{'"', '"'}, std::pair{'[', ']'}}) {
    const std::size_t begin = value.find(first);
    const std::size_t end = begin == std::string_view::npos ? begin : value.find(last, begin + 1);
    if (end != std::string_view::npos && end > begin + 1)
      return plain_text(std::string(value.substr(begin + 1, end - begin - 1)));
  }
  return "image";
}

// `@Sens. NAME` entries.
using Sensitivities = std::map<std::string, std::string_view>;

Sensitivities nanoscope_sensitivities(const std::vector<NanoscopeSection>& sections) {
  Sensitivities found;
  for (const NanoscopeSection& section : sections)
    if (section.name != "ciao image list")
      for (const auto& [key, value] : section.entries)
        if (key.starts_with("@sens.")) found.emplace(key, value);
  return found;
}

struct NanoscopeImage {
  int nx = 0, ny = 0;
  std::size_t width = 0;  // in bytes
  std::string_view data;
  double size_x = 0, size_y = 0;
  std::optional<double> unit;  // m per number; none for other quantities
  std::string kind;            // for errors
};

// `V [Sens. Zsens] (0.005035400 V/LSB) 330.0000 V`
void scale_nanoscope_image(const SourceFile& file, const Sensitivities& sensitivities, std::string_view scale,
                           std::uint64_t bytes_a_pixel, NanoscopeImage& image) {
  const std::size_t bracket = scale.find(')');
  const std::vector<std::string_view> words = cells_of(
      trimmed(bracket == std::string_view::npos ? scale : scale.substr(bracket + 1)), Separator::blank);
  if (!scale.starts_with('V') || bracket == std::string_view::npos || words.empty())
    refuse_file(file, "has an image whose Z scale is not understood: " + shown(scale));
  const double hard = instrument_number(file, "@2:Z scale", words.front());
  const std::string_view hard_unit = words.size() > 1 ? words[1] : "";
  image.kind = hard_unit.empty()     ? "numbers without a unit"
               : hard_unit == "\xBA" ? "degrees"
                                     : plain_text(std::string(hard_unit));
  const std::size_t begin = scale.find('['), end = scale.find(']');
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin || end > bracket)
    return;
  const std::string name = "@" + lower_case(scale.substr(begin + 1, end - begin - 1));
  const auto found = sensitivities.find(name);
  if (found == sensitivities.end())
    refuse_file(file, "has an image scaled by " + shown(name) + ", which its header does not say");
  const std::vector<std::string_view> parts = cells_of(found->second, Separator::blank);
  // `V 20.82646 nm/V`; without a unit: volts or an angle.
  if (parts.size() < 3 || parts[0] != "V") return;
  const std::size_t slash = parts[2].rfind('/');
  if (slash == std::string_view::npos) return;
  const std::optional<double> metres = instrument_length_unit(parts[2].substr(0, slash));
  const std::string_view per = parts[2].substr(slash + 1);
  if (!metres) {
    image.kind = plain_text(std::string(parts[2].substr(0, slash)));
    return;
  }
  double volts = 1;
  if (hard_unit != per) {
    if (hard_unit == "mV" && per == "V")
      volts = 1e-3;
    else if (hard_unit == "V" && per == "mV")
      volts = 1e3;
    else
      refuse_file(file,
                  "has an image scaled in " + shown(hard_unit) + " with a sensitivity in " + shown(parts[2]));
  }
  double range = 1;
  for (std::uint64_t k = 0; k < bytes_a_pixel; ++k) range *= 256;
  const double unit = hard * volts / range * instrument_number(file, name, parts[1]) * *metres;
  if (!(unit > 0) || !std::isfinite(unit))
    refuse_file(file, "gives one unit of its heights as " + format_short(unit) + " m");
  image.unit = unit;
}

// `500 500 nm`, or one number for both.
void size_nanoscope_image(const SourceFile& file, std::string_view value, NanoscopeImage& image) {
  const std::vector<std::string_view> words = cells_of(value, Separator::blank);
  if (words.size() != 2 && words.size() != 3)
    refuse_file(file, "has no length for `scan size` in its header: " + shown(value));
  const std::string unit(words.back());
  image.size_x = instrument_length(file, "scan size", std::string(words[0]) + " " + unit);
  image.size_y = instrument_length(file, "scan size", std::string(words[words.size() - 2]) + " " + unit);
}

NanoscopeImage nanoscope_image(const SourceFile& file, const Sensitivities& sensitivities,
                               const NanoscopeSection& section) {
  const auto count = [&](const char* key) {
    return instrument_count(file, key, nanoscope_entry(file, section, key));
  };
  const std::uint64_t nx = count("samps/line"), ny = count("number of lines");
  const std::uint64_t offset = count("data offset"), length = count("data length");
  const std::uint64_t bytes_a_pixel = count("bytes/pixel");
  if (bytes_a_pixel != 2 && bytes_a_pixel != 4)
    refuse_file(file, "holds heights of " + std::to_string(bytes_a_pixel) + " bytes a pixel",
                "integers of 2 and of 4 bytes are read");
  const std::string_view bytes = file.bytes();
  if (offset > bytes.size() || length > bytes.size() - offset)
    refuse_file(file,
                "has an image past its end, " + std::to_string(length) + " bytes from byte " +
                    std::to_string(offset) + " on",
                "the file is cut short");
  NanoscopeImage image;
  image.data = bytes.substr(offset, length);
  require_numbers(file, nx, ny, 2, length);
  image.width = bytes_a_pixel == 4 || length / nx / ny == 4 ? 4 : 2;
  require_exactly(file, nx, ny, image.width, length);
  image.nx = static_cast<int>(nx);
  image.ny = static_cast<int>(ny);
  size_nanoscope_image(file, nanoscope_entry(file, section, "scan size"), image);
  const auto scale = section.entries.find("@2:z scale");
  if (scale == section.entries.end())
    refuse_file(file, "has an image without \\@2:Z scale, as versions before 4.3 write them",
                "save it as .gwy in Gwyddion");
  scale_nanoscope_image(file, sensitivities, scale->second, bytes_a_pixel, image);
  return image;
}

// In a stopped scan, the remaining lines hold old data.
void warn_of_stopped_scan(const SourceFile& file, const NanoscopeSection& section,
                          const NanoscopeImage& image, Monitor& monitor) {
  const auto valid = [&](const char* key, int whole) {
    const auto found = section.entries.find(key);
    return found == section.entries.end() ||
           instrument_count(file, key, found->second) == static_cast<std::uint64_t>(whole);
  };
  if (!valid("valid data len x", image.nx) || !valid("valid data len y", image.ny))
    monitor.warn(file_name(file.path()) + " says that only a part of its " + std::to_string(image.nx) +
                 " x " + std::to_string(image.ny) + " points is valid: crop it to what was measured");
}

// `2:1`: width twice the height. A different scan size suggests wrong cells.
void warn_of_aspect(const SourceFile& file, const NanoscopeSection& section, const NanoscopeImage& image,
                    Monitor& monitor) {
  const auto found = section.entries.find("aspect ratio");
  if (found == section.entries.end()) return;
  const std::size_t colon = found->second.find(':');
  if (colon == std::string_view::npos) return;
  const double along_x = instrument_number(file, "aspect ratio", found->second.substr(0, colon));
  const double along_y = instrument_number(file, "aspect ratio", found->second.substr(colon + 1));
  constexpr double printed_digits = 0.02;
  if (!(std::abs(image.size_x * along_y - image.size_y * along_x) <=
        printed_digits * std::abs(image.size_x * along_y)))
    monitor.warn(file_name(file.path()) + " says that its aspect ratio is " +
                 plain_text(std::string(found->second)) + " and its size " + format_short(image.size_x) +
                 " m x " + format_short(image.size_y) + " m: give `size` if that is wrong");
}

HeightMap read_nanoscope_channel(const SourceFile& file, const std::string& channel, Monitor& monitor) {
  const std::vector<NanoscopeSection> sections = nanoscope_sections(file);
  const Sensitivities sensitivities = nanoscope_sensitivities(sections);
  std::vector<NanoscopeImage> images;
  std::vector<const NanoscopeSection*> described;
  std::vector<NamedMap> maps;
  std::vector<std::string> lines;  // Trace or Retrace
  for (const NanoscopeSection& section : sections) {
    if (section.name != "ciao image list") continue;
    images.push_back(nanoscope_image(file, sensitivities, section));
    described.push_back(&section);
    const std::string title = nanoscope_title(nanoscope_entry(file, section, "@2:image data"));
    maps.push_back({title, images.back().unit.has_value() && lower_case(title).starts_with("height")});
    const auto line = section.entries.find("line direction");
    lines.push_back(line == section.entries.end() ? "" : ", " + lower_case(line->second));
  }
  tell_apart_by(maps, lines);  // shared titles
  const std::size_t found = chosen_map(file, maps, channel);
  const NanoscopeImage& image = images[found];
  if (!image.unit) refuse_no_heights(file, maps[found], image.kind);
  warn_of_stopped_scan(file, *described[found], image, monitor);
  warn_of_aspect(file, *described[found], image, monitor);
  HeightMap map;
  map.heights = image.width == 2 ? field_of_numbers<std::int16_t>(image.data, image.nx, image.ny, monitor)
                                 : field_of_numbers<std::int32_t>(image.data, image.nx, image.ny, monitor);
  map.unit = image.unit;
  map.size_x = image.size_x;
  map.size_y = image.size_y;
  map.trace = image.ny == 1;
  return map;
}

bool recognises_nanoscope(const SourceFile& file) { return file.bytes().starts_with(nanoscope_mark); }

}  // namespace

const Format& nanoscope_format() {
  static const Format format{
      "nanoscope",
      "\\*File list at the start",
      {"Nanoscope of Digital Instruments, Veeco and Bruker, from 4.3 on: the image of heights, or another in "
       "a unit of length with `channel`.",
       "Force curves, files of text, versions before 4.3, images of other quantities.",
       "Six files of the public test set of SurfaceTopography, versions 5.12 to 10: heights and sizes, by an "
       "independent program."},
      {FirstLine::bottom, "Gwyddion's reader shows the first line at the bottom."},
      {"spm", "di"},
      recognises_nanoscope,
      nullptr,
      read_nanoscope_channel};
  return format;
}

}  // namespace asperity
