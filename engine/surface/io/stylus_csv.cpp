// SPDX-License-Identifier: GPL-3.0-or-later
// CSV traces of stylus profilers: lines `key,value`, `Scan Data`, column names with units (`Lateral um,Raw
// Micrometer`), samples. Positions and `Resolution` are rounded, so the spacing is the least-squares slope of
// position against sample number. Uneven spacing and samples shorter than `Length` are errors.
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/files/text_encoding.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/statistics/table_head.hpp"
#include "engine/surface/io/column_head.hpp"
#include "engine/surface/io/format.hpp"

namespace asperity {

namespace {

bool is_scan_mark(std::string_view line) {
  std::string text = lower_case(trimmed(line));
  while (!text.empty() && text.back() == ',') text.pop_back();
  return text == "scan data";
}

bool recognises_stylus_csv(const SourceFile& file) {
  if (!file.looks_like_text()) return false;
  LineReader lines(file.text());
  std::string_view line;
  for (int count = 0; count < 500 && lines.next(line); ++count)
    if (is_scan_mark(line)) return true;
  return false;
}

int decimals(std::string_view text) {
  const std::size_t point = text.find_first_of(".,");
  return point == std::string_view::npos
             ? 0
             : static_cast<int>(std::min<std::size_t>(text.size() - point - 1, 17));
}

// Tolerance: half a sample; some headers count from first to last sample.
void check_length(const SourceFile& file, double found, double spacing, double stated, Monitor& monitor) {
  const std::string stated_text = format_quantity(stated, dimension::length),
                    found_text = format_quantity(found, dimension::length);
  if (found + 0.5 * spacing < 0.99 * stated)
    refuse_file(file, "covers " + found_text + " of the " + stated_text + " that its header states",
                "the file is cut short, or the scan was stopped: then correct `Length` in the file");
  if (found > 1.01 * stated)
    monitor.warn(file_name(file.path()) + " says it is " + stated_text + " long but its samples span " +
                 found_text);
}

struct Line {
  double spacing = 0, first = 0;
};

Line fitted(std::span<const double> positions) {
  const auto n = static_cast<double>(positions.size());
  const double middle = 0.5 * (n - 1), average = mean(positions);
  Array<double> products(positions.size());
  for (std::size_t k = 0; k < positions.size(); ++k)
    products[k] = (static_cast<double>(k) - middle) * (positions[k] - average);
  const double spacing = block_sum(products) * 12 / (n * (n * n - 1));
  return {spacing, average - spacing * middle};
}

// `places`: decimals of the positions.
Line evenly_spaced(const SourceFile& file, std::span<const double> positions, int places) {
  if (positions.size() < 2) refuse_file(file, "has fewer than two samples", "the file is cut short");
  if (positions.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    refuse_file(file, "has too many samples");
  const Line fit = fitted(positions);
  const double allowed = std::max(0.5 * fit.spacing, 0.6 * elementary::pow(10.0, -places));
  if (!(fit.spacing > 0) || !std::isfinite(fit.spacing))
    refuse_file(file, "has positions that do not increase");
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (!(std::abs(positions[k] - (fit.first + fit.spacing * static_cast<double>(k))) <= allowed))
      refuse_file(file, "is not evenly spaced: sample " + std::to_string(k + 1) + " is at " +
                            format_short(positions[k]) + " instead of " +
                            format_short(fit.first + fit.spacing * static_cast<double>(k)));
  return fit;
}

HeightMap read_stylus_csv(const SourceFile& file, Monitor& monitor) {
  if (!file.looks_like_text()) refuse_file(file, "is not text: it holds zero bytes");
  LineReader lines(file.text());
  std::string_view line;
  bool found = false;
  std::optional<double> length;  // m, from the header
  while (!found && lines.next(line)) {
    found = is_scan_mark(line);
    const std::vector<std::string_view> cells = cells_of(line, Separator::comma);
    if (cells.size() < 2 || lower_case(cells[0]) != "length" || length) continue;
    const std::optional<Quantity> stated = quantity_in_cell(utf8_or_cp1252(cells[1]));
    if (stated && stated->dimension == dimension::length) length = stated->value;
  }
  if (!found)
    refuse_file(file, "has no line \"Scan Data\"", "if it is another format, name it with `format`");
  do {
    if (!lines.next(line)) refuse_file(file, "ends after \"Scan Data\"", "the file is cut short");
  } while (trimmed(line).empty());
  const std::vector<std::string_view> titles = cells_of(line, separator_of(line));
  if (titles.size() < 2) refuse_file(file, "names no columns after \"Scan Data\": " + shown(line));
  const std::optional<double> lateral_unit = length_unit(titles[0]);
  if (!lateral_unit)
    refuse_file(file, "gives no known unit of length for its positions: " + shown(titles[0]));

  Array<double> positions, heights;
  int places = 0;
  Task task(monitor, "reading", static_cast<std::int64_t>(file.bytes().size()));
  std::size_t before = 0;
  while (lines.next(line)) {
    task.advance(static_cast<std::int64_t>(lines.position() - before));
    before = lines.position();
    line = trimmed(line);
    if (line.find_first_not_of(",; \t") == std::string_view::npos) continue;
    const Separator separator = separator_of(line);
    const std::vector<std::string_view> cells = cells_of(line, separator);
    const std::string where = " in line " + std::to_string(lines.number());
    if (cells.size() < 2) refuse_file(file, "has no height" + where, "the file is cut short");
    const TextCell position = read_cell(cells[0], separator), height = read_cell(cells[1], separator);
    if (position.kind != CellKind::number)
      refuse_file(file, "has no position" + where + ": " + shown(cells[0]));
    if (height.kind != CellKind::number && height.kind != CellKind::hole)
      refuse_file(file, "has no height" + where + ": " + shown(cells[1]));
    places = std::max(places, decimals(cells[0]));
    positions.push_back(position.value);
    heights.push_back(height.value);
  }
  const Line fit = evenly_spaced(file, positions, places);
  HeightMap map;
  const auto n = static_cast<int>(heights.size());
  map.heights = Field(n, 1);
  std::copy(heights.begin(), heights.end(), map.heights.values().begin());
  map.unit = length_unit(titles[1]);
  map.size_x = fit.spacing * *lateral_unit * n;
  map.trace = true;
  if (length) check_length(file, *map.size_x, fit.spacing * *lateral_unit, *length, monitor);
  warn_if_cut(file, monitor);
  return map;
}

}  // namespace

extern constexpr Format stylus_csv_format{
    "stylus-csv",
    "a line \"Scan Data\"",
    {"Traces of stylus profilers (Dektak) as CSV with a line \"Scan Data\".",
     "Uneven spacing, scans cut short of their stated length.",
     "A file of the public test set of SurfaceTopography."},
    {FirstLine::bottom, "Profiles only."},
    {},
    recognises_stylus_csv,
    read_stylus_csv,
    nullptr,
    true};

}  // namespace asperity
