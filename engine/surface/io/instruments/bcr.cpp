// SPDX-License-Identifier: GPL-3.0-or-later
// BCR and BCRF of Image Metrology (SPIP): a text header, then 16-bit integers (`bcrstm`, unit `bit2nm`) or
// 32-bit floating-point numbers (`bcrf`, unit `zunit`, default nm). Missing points: above 1.7e38; 32767 in
// 16 bits unless `voidpixels` is 0; a negative or fractional `voidpixels`. Layout: Gwyddion's and
// SurfaceTopography's readers.
#include <cctype>

#include "engine/surface/io/column_head.hpp"
#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::size_t header_characters = 2048;
constexpr std::string_view unicode_ending = "_unicode";

std::pair<std::string, std::string_view> statement(std::string_view line) {
  const std::size_t sign = line.find('=');
  if (line.starts_with('%') || line.starts_with('#') || sign == std::string_view::npos) return {};
  return {lower_case(trimmed(line.substr(0, sign))), trimmed(line.substr(sign + 1))};
}

// In single bytes; non-ASCII characters become question marks.
struct BcrHeader {
  std::string text;
  std::size_t data_at = 0;
};

bool is_utf16_head(std::string_view bytes) {
  constexpr std::string_view mark("\xFF\xFE", 2), first("f\0i\0l\0e\0", 8);
  if (bytes.starts_with(mark)) bytes.remove_prefix(mark.size());
  if (bytes.size() < first.size()) return false;
  for (std::size_t k = 0; k < first.size(); ++k)
    if (std::tolower(static_cast<unsigned char>(bytes[k])) != first[k]) return false;
  return true;
}

BcrHeader header_of(const SourceFile& file, std::size_t characters) {
  const std::string_view bytes = file.bytes();
  if (!is_utf16_head(bytes)) return {std::string(bytes.substr(0, characters)), characters};
  BcrHeader header;
  for (std::size_t k = 0; k + 1 < bytes.size() && header.text.size() < characters; k += 2)
    header.text += bytes[k + 1] == '\0' ? bytes[k] : '?';
  if (header.text.starts_with('?')) header.text.erase(0, 1);  // the byte order mark
  header.data_at = 2 * characters;
  return header;
}

bool recognises_bcr(const SourceFile& file) {
  const BcrHeader header = header_of(file, 64);
  LineReader reader(header.text);
  std::string_view line;
  if (!reader.next(line)) return false;
  const auto [key, value] = statement(line);
  return key == "fileformat" && lower_case(value).starts_with("bcr");
}

// Returns the numbers in `data`.
HeaderEntries entries_of(const SourceFile& file, std::size_t characters, std::string_view& data) {
  const BcrHeader header = header_of(file, characters);
  if (file.bytes().size() < header.data_at)
    refuse_file(file, "is cut short in its header of " + std::to_string(header.data_at) + " bytes");
  data = file.bytes().substr(header.data_at);
  std::string_view text = header.text;
  text = text.substr(0, text.find('\0'));
  HeaderEntries entries(file);
  LineReader reader(text);
  std::string_view line;
  while (reader.next(line))
    if (const auto [key, value] = statement(line); !key.empty()) entries.add(key, value);
  return entries;
}

HeaderEntries read_entries(const SourceFile& file, std::string_view& data) {
  HeaderEntries entries = entries_of(file, header_characters, data);
  if (!entries.find("headersize")) return entries;
  const std::uint64_t said = entries.count("headersize");
  if (said == header_characters) return entries;
  if (said < header_characters || said > file.bytes().size())
    refuse_file(file, "says that its header has " + std::to_string(said) + " characters",
                "they are 2048 or more, and no more than the file has");
  return entries_of(file, static_cast<std::size_t>(said), data);
}

// Metres; default nanometres.
double unit_of(const SourceFile& file, const HeaderEntries& entries, std::string_view key) {
  constexpr double nanometre = 1e-9;
  const auto word = entries.find(key);
  const std::optional<double> metres = word ? length_unit(*word) : nanometre;
  if (!metres)
    refuse_file(file, "gives no known unit of length as " + std::string(key) + ": " + shown(*word));
  return *metres;
}

// In metres.
std::optional<double> length_of(const SourceFile& file, const HeaderEntries& entries, std::string_view key,
                                std::string_view unit_key) {
  if (!entries.find(key)) return {};
  return above_zero(file, entries.decimal(key), "as its " + std::string(key)) *
         unit_of(file, entries, unit_key);
}

HeightMap read_bcr(const SourceFile& file, Monitor& monitor) {
  std::string_view data;
  const HeaderEntries entries = read_entries(file, data);
  const std::string_view stated = entries.text("fileformat");
  std::string kind = lower_case(stated);
  if (is_utf16_head(file.bytes()) && kind.ends_with(unicode_ending))
    kind.resize(kind.size() - unicode_ending.size());
  const bool integers = kind == "bcrstm";
  if (!integers && kind != "bcrf")
    refuse_file(file, "is a BCR file of the kind " + shown(stated), "bcrstm and bcrf are read");
  const std::uint64_t nx = entries.count("xpixels"), ny = entries.count("ypixels");
  const bool swapped = entries.find("intelmode") && entries.count("intelmode") == 0;
  // Some files state a count of missing points instead.
  const double void_value = entries.find("voidpixels") ? entries.decimal("voidpixels") : 1;
  const bool value = void_value < 0 || void_value != std::floor(void_value);
  HeightMap map;
  if (integers) {
    constexpr double missing = 32767;
    map.heights = exact_field(
        file, swapped ? number_type<std::int16_t, big_endian<std::int16_t>> : number_type<std::int16_t>, data,
        nx, ny, monitor, [&](double number) {
          return (void_value != 0 && number == missing) || (value && number == void_value);
        });
    map.unit = length_of(file, entries, "bit2nm", "zunit");
  } else {
    constexpr double least_missing = 1.7e38F;
    const auto rounded = static_cast<double>(static_cast<float>(void_value));
    map.heights = exact_field(
        file, swapped ? number_type<float, big_endian<float>> : number_type<float>, data, nx, ny, monitor,
        [&](double number) { return !(std::abs(number) <= least_missing) || (value && number == rounded); });
    map.unit = unit_of(file, entries, "zunit");
    // The format defines bit2nm only for integers.
    const std::string_view scale = entries.find("bit2nm").value_or("1");
    const TextCell cell = read_cell(scale, Separator::blank);
    if (cell.kind != CellKind::number || cell.value != 1)
      monitor.warn(file_name(file.path()) + " holds floating-point heights and a bit2nm of " + shown(scale) +
                   ", which is for integers only and is ignored");
  }
  map.size_x = length_of(file, entries, "xlength", "xunit");
  map.size_y = length_of(file, entries, "ylength", "yunit");
  return map;
}

}  // namespace

extern constexpr Format bcr_format{
    "bcr",
    "`fileformat = bcrstm` or bcrf at the start",
    {"BCR and BCRF of SPIP (Image Metrology): integers or single precision, in text "
     "of one or two bytes a character.",
     "Other kinds of number, heights that are no length.",
     "A file in UTF-16 of the public test set of SurfaceTopography (bcrf): every "
     "height, size; integers by the layout alone."},
    {FirstLine::top, "Gwyddion's reader shows the first line at the top."},
    {"bcr", "bcrf"},
    recognises_bcr,
    read_bcr};

}  // namespace asperity
