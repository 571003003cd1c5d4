// SPDX-License-Identifier: GPL-3.0-or-later
// Nanoscope files of Digital Instruments, Veeco and Bruker (.spm, .di, .001) from version 4.3 on: header
// lines `\key: value` in sections `\*Name`, then integer images. Height per unit: V / 256^b · S, with V the
// final value of `\@2:Z scale` in volts, b `\Bytes/pixel`, S the sensitivity in m/V (`[Sens. Zsens]`). From
// version 9.2 on, integers have 32 bits for any b. No missing points. The z offset is ignored. Layout:
// Gwyddion's and SurfaceTopography's readers.
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view nanoscope_mark = "\\*File list", nanoscope_end = "\\*File list end";

struct NanoscopeSection {
  std::string name;  // without `\*`
  HeaderEntries entries;
};

std::vector<NanoscopeSection> nanoscope_sections(const SourceFile& file) {
  std::string_view text = file.bytes();
  text = text.substr(0, text.find('\x1A'));
  std::vector<NanoscopeSection> sections;
  LineReader reader(text);
  std::string_view line;
  while (reader.next(line)) {
    line = trimmed(line);
    if (line == nanoscope_end) return sections;
    if (line.starts_with("\\*")) {
      sections.push_back({lower_case(line.substr(2)), HeaderEntries(file)});
      continue;
    }
    // Keys such as `@2:Z scale` contain a colon.
    const std::size_t colon = line.find(": ", 1);
    if (!line.starts_with('\\') || colon == std::string_view::npos) continue;
    sections.back().entries.add(lower_case(line.substr(1, colon - 1)), trimmed(line.substr(colon + 2)));
  }
  refuse_file(file, "has a header without \\*File list end", "the file is cut short");
}

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
HeaderEntries nanoscope_sensitivities(const SourceFile& file, const std::vector<NanoscopeSection>& sections) {
  HeaderEntries found(file);
  for (const NanoscopeSection& section : sections)
    if (section.name != "ciao image list")
      for (const auto& [key, value] : section.entries.all())
        if (key.starts_with("@sens.")) found.add(key, value);
  return found;
}

struct NanoscopeImage {
  std::uint64_t nx = 0, ny = 0;
  NumberType type;
  std::string_view data;
  double size_x = 0, size_y = 0;
  std::optional<double> unit;  // m per number; none for other quantities
  std::string kind;            // for errors
};

// `V [Sens. Zsens] (0.005035400 V/LSB) 330.0000 V`
void scale_nanoscope_image(const SourceFile& file, const HeaderEntries& sensitivities, std::string_view scale,
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
  if (!found)
    refuse_file(file, "has an image scaled by " + shown(name) + ", and its header lacks this scale");
  const std::vector<std::string_view> parts = cells_of(*found, Separator::blank);
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

NanoscopeImage nanoscope_image(const SourceFile& file, const HeaderEntries& sensitivities,
                               const NanoscopeSection& section) {
  const HeaderEntries& entries = section.entries;
  const std::uint64_t nx = entries.count("samps/line"), ny = entries.count("number of lines");
  const std::uint64_t offset = entries.count("data offset"), length = entries.count("data length");
  const std::uint64_t bytes_a_pixel = entries.count("bytes/pixel");
  if (bytes_a_pixel != 2 && bytes_a_pixel != 4)
    refuse_file(file, "holds heights of " + std::to_string(bytes_a_pixel) + " bytes a pixel",
                "integers of 2 and of 4 bytes are read");
  const std::string_view data = bytes_at(
      file, offset, length,
      "an image of " + std::to_string(length) + " bytes from byte " + std::to_string(offset) + " on");
  require_numbers(file, nx, ny, 2, length);
  const bool wide = bytes_a_pixel == 4 || length / nx / ny == 4;
  NanoscopeImage image;
  image.nx = nx;
  image.ny = ny;
  image.type = wide ? number_type<std::int32_t> : number_type<std::int16_t>;
  image.data = data;
  require_exactly(file, nx, ny, image.type.width, length);
  size_nanoscope_image(file, entries.text("scan size"), image);
  const auto scale = entries.find("@2:z scale");
  if (!scale)
    refuse_file(file, "has an image without \\@2:Z scale, as versions before 4.3 write them",
                "save it as .gwy in Gwyddion");
  scale_nanoscope_image(file, sensitivities, *scale, bytes_a_pixel, image);
  return image;
}

// In a stopped scan, the remaining lines hold old data.
void warn_of_stopped_scan(const SourceFile& file, const NanoscopeSection& section,
                          const NanoscopeImage& image, Monitor& monitor) {
  const auto valid = [&](const char* key, std::uint64_t whole) {
    return !section.entries.find(key) || section.entries.count(key) == whole;
  };
  if (!valid("valid data len x", image.nx) || !valid("valid data len y", image.ny))
    monitor.warn(file_name(file.path()) + " says that only a part of its " + std::to_string(image.nx) +
                 " x " + std::to_string(image.ny) + " points is valid: crop it to the measured points");
}

// `2:1`: width twice the height.
void warn_of_aspect(const SourceFile& file, const NanoscopeSection& section, const NanoscopeImage& image,
                    Monitor& monitor) {
  const auto found = section.entries.find("aspect ratio");
  if (!found) return;
  const std::size_t colon = found->find(':');
  if (colon == std::string_view::npos) return;
  const double along_x = instrument_number(file, "aspect ratio", found->substr(0, colon));
  const double along_y = instrument_number(file, "aspect ratio", found->substr(colon + 1));
  constexpr double printed_digits = 0.02;
  if (!(std::abs(image.size_x * along_y - image.size_y * along_x) <=
        printed_digits * std::abs(image.size_x * along_y)))
    monitor.warn(file_name(file.path()) + " states the aspect ratio " + plain_text(std::string(*found)) +
                 " and the size " + format_short(image.size_x) + " m x " + format_short(image.size_y) +
                 " m; give `size` if this is wrong");
}

HeightMap read_nanoscope_channel(const SourceFile& file, const std::string& channel, Monitor& monitor) {
  const std::vector<NanoscopeSection> sections = nanoscope_sections(file);
  const HeaderEntries sensitivities = nanoscope_sensitivities(file, sections);
  std::vector<NanoscopeImage> images;
  std::vector<const NanoscopeSection*> described;
  std::vector<NamedMap> maps;
  std::vector<std::string> lines;  // Trace or Retrace
  for (const NanoscopeSection& section : sections) {
    if (section.name != "ciao image list") continue;
    images.push_back(nanoscope_image(file, sensitivities, section));
    described.push_back(&section);
    const std::string title = nanoscope_title(section.entries.text("@2:image data"));
    maps.push_back({title, images.back().unit.has_value() && lower_case(title).starts_with("height")});
    const auto line = section.entries.find("line direction");
    lines.push_back(line ? ", " + lower_case(*line) : "");
  }
  tell_apart_by(maps, lines);  // shared titles
  const std::size_t found = chosen_map(file, maps, channel);
  const NanoscopeImage& image = images[found];
  if (!image.unit) refuse_no_heights(file, maps[found], image.kind);
  warn_of_stopped_scan(file, *described[found], image, monitor);
  warn_of_aspect(file, *described[found], image, monitor);
  return {.heights = field_of_numbers(image.type, image.data, image.nx, image.ny, monitor),
          .unit = image.unit,
          .size_x = image.size_x,
          .size_y = image.size_y,
          .trace = image.ny == 1};
}

}  // namespace

extern constexpr Format nanoscope_format{
    "nanoscope",
    "\\*File list at the start",
    {"Nanoscope of Digital Instruments, Veeco and Bruker, from 4.3 on: the image of heights, or another in "
     "a unit of length with `channel`.",
     "Force curves, files of text, versions before 4.3, images of other quantities.",
     "Six files of the public test set of SurfaceTopography, versions 5.12 to 10: heights and sizes, by an "
     "independent program."},
    {FirstLine::bottom, "Gwyddion's reader shows the first line at the bottom."},
    {"spm", "di"},
    begins_with<nanoscope_mark>,
    nullptr,
    read_nanoscope_channel};

}  // namespace asperity
