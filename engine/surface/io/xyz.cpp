// SPDX-License-Identifier: GPL-3.0-or-later
// x y z triples of a regular grid, one point per line, in any order. Spacing = (last - first)/(n - 1) of the
// distinct x and y; every coordinate must be within a quarter of a cell of its lattice line. A duplicate
// point is an error, a missing point is a hole. Scattered points are not gridded. If unnamed columns may or
// may not be a lattice, the call must name the format.
#include <cmath>
#include <functional>

#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/column_head.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/own_head.hpp"

namespace asperity {

namespace {

struct LatticeAxis {
  double first = 0, spacing = 0;
  int lines = 0;      // distinct coordinates
  bool even = false;  // within a quarter of the spacing
  double odd = 0;     // an uneven coordinate
  Array<double> distinct;
  std::uint64_t rank(double coordinate) const {
    return static_cast<std::uint64_t>(std::upper_bound(distinct.begin(), distinct.end(), coordinate) -
                                      distinct.begin() - 1);
  }
  int place(double coordinate) const {
    if (lines == 1) return 0;
    const double nearest = std::round((coordinate - first) / spacing);
    return static_cast<int>(std::clamp(nearest, 0.0, static_cast<double>(lines - 1)));
  }
};

LatticeAxis axis_of(const TextTable& table, std::size_t column) {
  Array<double> values = table.column(column);
  std::sort(values.begin(), values.end());
  const double same = 1e-6 * (values.back() - values.front());
  LatticeAxis axis;
  Array<double>& distinct = axis.distinct;
  for (const double value : values)
    if (distinct.empty() || value - distinct.back() > same) distinct.push_back(value);
  axis.first = distinct.front();
  axis.lines = static_cast<int>(distinct.size());
  axis.even = axis.lines == 1;
  if (axis.even) return axis;
  axis.spacing = (distinct.back() - distinct.front()) / (axis.lines - 1);
  const std::size_t even = even_values(distinct, 0.25);
  axis.even = even == distinct.size();
  if (!axis.even) axis.odd = distinct[even];
  return axis;
}

bool coordinates_present(const TextTable& table) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(table.rows); ++k)
    if (!std::isfinite(table.values[3 * k]) || !std::isfinite(table.values[3 * k + 1])) return false;
  return true;
}

struct TriplesHead {
  std::optional<std::vector<HeadColumn>> columns;
  bool named = false;  // not by a comment
};

// A comment counts only with units. In a head of words, the last line names the columns.
TriplesHead take_head(LineReader& lines, const SourceFile& file) {
  TriplesHead head;
  std::string_view line;
  for (LineReader ahead = lines; ahead.next(line); lines = ahead) {
    auto columns = xyz_head(line);
    if (is_skipped(line)) {
      const auto has_unit = [](const HeadColumn& column) { return column.unit.has_value(); };
      if (columns && std::any_of(columns->begin(), columns->end(), has_unit))
        head.columns = std::move(columns);
      continue;
    }
    if (columns) {
      head.columns = std::move(columns);
      head.named = true;
      lines = ahead;
    } else if (!is_row_of_numbers(line)) {
      auto own = own_head(file);
      if (!own || !own->names || !are_points(*own->names)) return head;
      head.columns = std::move(own->names);
      head.named = true;
      while (lines.number() < own->lines && lines.next(line)) continue;
    }
    return head;
  }
  return head;
}

// Counts of the pairs of x and y.
struct Coverage {
  double places = 0;  // possible pairs
  int points = 0;     // distinct pairs
  bool equally_often = true;
};

Coverage coverage_of(const TextTable& table, const LatticeAxis& x, const LatticeAxis& y) {
  Array<std::uint64_t> pairs(static_cast<std::size_t>(table.rows));
  for (std::size_t k = 0; k < pairs.size(); ++k)
    pairs[k] = x.rank(table.values[3 * k]) << 32 | y.rank(table.values[3 * k + 1]);
  std::sort(pairs.begin(), pairs.end());
  Coverage coverage;
  coverage.places = static_cast<double>(x.lines) * y.lines;
  std::size_t often = 0;
  for (std::size_t k = 0, next = 0; k < pairs.size(); k = next) {
    while (next < pairs.size() && pairs[next] == pairs[k]) ++next;
    if (k == 0) often = next;
    if (next - k != often) coverage.equally_often = false;
    ++coverage.points;
  }
  return coverage;
}

struct Triples {
  TextTable table;
  bool named;
  LatticeAxis x = axis_of(table, 0), y = axis_of(table, 1);
  Coverage coverage = coverage_of(table, x, y);
};

// A table of three columns without holes in x and y.
std::optional<Triples> triples_of(const SourceFile& file) {
  if (!file.looks_like_text()) return {};
  if (file.text().starts_with("# asperity")) return {};
  LineReader lines(file.text());
  const TriplesHead head = take_head(lines, file);
  std::string_view line;
  for (LineReader ahead = lines; ahead.next(line);) {
    if (is_skipped(line)) continue;
    if (!is_row_of_numbers(line)) return {};
    const std::string_view text = trimmed(line.substr(0, line.find('#')));
    if (cells_of(text, separator_of(text)).size() != 3) return {};
    break;
  }
  try {
    TextTable table = read_table(lines, file, Monitor::silent());
    if (table.columns == 3 && coordinates_present(table)) return Triples{std::move(table), head.named};
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_file) throw;
  }
  return {};
}

// Named columns, or a lattice with each point once: full, or of at least 16 rows with missing points.
bool recognises_xyz(const SourceFile& file) {
  const std::optional<Triples> triples = triples_of(file);
  if (!triples || triples->named) return triples.has_value();
  const auto& [table, named, x, y, coverage] = *triples;
  const double rows = table.rows, places = coverage.places;
  return x.even && y.even && x.lines > 1 && y.lines > 1 && coverage.points == table.rows &&
         (places == rows || (rows >= 16 && places > rows && places < 2 * rows));
}

// Occurs only in matrices.
bool names_a_width(const SourceFile& file) {
  LineReader lines(file.text());
  std::string_view line;
  while (lines.next(line) && is_skipped(line))
    if (lower_case(line).find("width:") != std::string::npos) return true;
  return false;
}

// y is converted to the unit of x.
void take_units(HeightMap& map, const std::vector<HeadColumn>& columns, const SourceFile& file,
                Monitor& monitor) {
  const auto x = head_unit(columns[0], file, monitor), y = head_unit(columns[1], file, monitor);
  map.unit = head_unit(columns[2], file, monitor);
  map.named_columns = map.unit || x || y;
  if (x.has_value() != y.has_value())
    refuse_file(file, std::string("gives a unit of ") + (x ? "x" : "y") + " and none of " + (x ? "y" : "x"),
                "write both into the line that names the columns");
  map.position_unit = x;
  if (x && map.size_y) map.size_y = *map.size_y * (*y / *x);
}

// True if points follow scan lines, along either axis in either direction, and end within a line, as in a
// truncated file.
bool ends_within_a_line(const TextTable& table, const LatticeAxis& x, const LatticeAxis& y) {
  const auto place = [](const LatticeAxis& axis, double coordinate, bool falling) {
    return falling ? axis.lines - 1 - axis.place(coordinate) : axis.place(coordinate);
  };
  for (int way = 0; way < 8; ++way) {
    const bool along_y = (way & 1) != 0, falling_fast = (way & 2) != 0, falling_slow = (way & 4) != 0;
    const LatticeAxis &fast = along_y ? y : x, &slow = along_y ? x : y;
    int k = 0;
    for (; k < table.rows; ++k) {
      const double* const point = &table.values[3 * static_cast<std::size_t>(k)];
      if (place(fast, point[along_y ? 1 : 0], falling_fast) != k % fast.lines ||
          place(slow, point[along_y ? 0 : 1], falling_slow) != k / fast.lines)
        break;
    }
    if (k == table.rows) return true;
  }
  return false;
}

HeightMap read_xyz(const SourceFile& file, Monitor& monitor) {
  if (!file.looks_like_text()) refuse_file(file, "is not text: it holds zero bytes");
  LineReader lines(file.text());
  const TriplesHead head = take_head(lines, file);
  const TextTable table = read_table(lines, file, monitor);
  warn_if_cut(file, monitor);
  if (table.columns != 3)
    refuse_file(file, "has " + std::to_string(table.columns) + " numbers a line", "x y z triples have three");
  if (!coordinates_present(table)) refuse_file(file, "has a point without x or y");
  const LatticeAxis x = axis_of(table, 0), y = axis_of(table, 1);
  for (const auto& [axis, name] : {std::pair{&x, "x"}, std::pair{&y, "y"}})
    if (!axis->even)
      refuse_file(file,
                  std::string("is not on a regular grid: its ") + std::to_string(axis->lines) +
                      " values of " + name + " are not evenly spaced (" + name + " = " +
                      format_short(axis->odd) + ")",
                  "grid the points evenly first");
  if (x.lines < 2)
    refuse_file(file, "has only one value of x, so its cells have no width",
                "x y z triples need a grid of points");
  const double places = static_cast<double>(x.lines) * y.lines;
  if (places > 4.0 * table.rows + 16)
    refuse_file(file,
                "is not on a regular grid: " + std::to_string(table.rows) + " points for " +
                    std::to_string(x.lines) + " x " + std::to_string(y.lines) + " places",
                "grid the points evenly first");
  HeightMap map;
  map.heights = Field(x.lines, y.lines, std::numeric_limits<double>::quiet_NaN());
  Array<char> taken(map.heights.size(), 0);
  for (std::size_t k = 0; k < static_cast<std::size_t>(table.rows); ++k) {
    const int i = x.place(table.values[3 * k]), j = y.place(table.values[3 * k + 1]);
    char& mark =
        taken[static_cast<std::size_t>(j) * static_cast<std::size_t>(x.lines) + static_cast<std::size_t>(i)];
    if (mark != 0)
      refuse_file(file, "gives the point x = " + format_short(table.values[3 * k]) +
                            ", y = " + format_short(table.values[3 * k + 1]) + " twice");
    mark = 1;
    map.heights(i, j) = table.values[3 * k + 2];
  }
  if (places > table.rows && ends_within_a_line(table, x, y))
    monitor.warn(file_name(file.path()) + " ends within a line of points: the last " +
                 std::to_string(static_cast<std::int64_t>(places) - table.rows) +
                 " are missing; the file may be cut short");
  map.size_in_units = true;
  map.size_x = x.spacing * x.lines;
  if (y.lines > 1) map.size_y = y.spacing * y.lines;
  map.trace = y.lines == 1;
  if (head.columns) take_units(map, *head.columns, file, monitor);
  return map;
}

// Lines of the smallest regular lattice through all coordinates, at most `most`; the least distance is a
// whole number of spacings.
std::optional<double> lattice_lines(const LatticeAxis& axis, double most) {
  if (axis.lines == 1) return 1;
  const Array<double>& distinct = axis.distinct;
  const double whole = distinct.back() - distinct.front();
  double least = whole;
  for (std::size_t k = 1; k < distinct.size(); ++k) least = std::min(least, distinct[k] - distinct[k - 1]);
  constexpr int greatest_gap = 20;
  for (int parts = 1; parts <= greatest_gap; ++parts) {
    const double spacings = std::round(whole / (least / parts));
    if (!(spacings + 1 <= most)) return {};
    const double spacing = whole / spacings;
    const auto on_a_line = [&](double value) {
      const double place = (value - distinct.front()) / spacing;
      return std::abs(place - std::round(place)) <= 0.1;
    };
    if (std::all_of(distinct.begin(), distinct.end(), on_a_line)) return spacings + 1;
  }
  return {};
}

// Monotonic, like the slow axis of a scan.
bool goes_one_way(const TextTable& table, std::size_t column) {
  const Array<double> values = table.column(column);
  return std::ranges::is_sorted(values) || std::ranges::is_sorted(values, std::ranges::greater());
}

// Coarsely quantised heights repeat pairs by chance: n pairs drawn from m give m (1 - exp(-n/m)) distinct
// pairs, 73 % of n at m = 1.5 n. Points of a scan are nearly all distinct or equally frequent.
bool almost_fill_a_lattice(const Triples& triples) {
  const auto& [table, named, x, y, coverage] = triples;
  const double rows = table.rows;
  if (rows < 5 || x.lines < 2 || y.lines < 2 || 1.5 * x.lines >= rows || 1.5 * y.lines >= rows) return false;
  if (coverage.points == coverage.places && coverage.equally_often) return true;
  if (coverage.places < 0.5 * rows || coverage.places >= 2 * rows) return false;
  if (rows < 16)
    return x.even && y.even && coverage.places <= 1.5 * rows &&
           (coverage.points == rows || coverage.points == coverage.places);
  return coverage.points >= (coverage.places <= 1.5 * rows ? 0.8 : 0.9) * rows;
}

// A table is a matrix only if a place repeats, if the places fit no small lattice, or if no coordinate
// repeats and neither is monotonic.
bool may_fit_a_lattice(const Triples& triples) {
  const auto& [table, named, x, y, coverage] = triples;
  if (table.rows < 2 || coverage.points != table.rows) return false;
  const double most_places = 4.0 * table.rows + 10000;
  const bool x_again = x.lines < table.rows, y_again = y.lines < table.rows;
  if (x_again && y_again && coverage.places <= most_places) return true;
  const auto columns = lattice_lines(x, most_places), rows = lattice_lines(y, most_places);
  if (!columns || !rows || *columns * *rows > most_places) return false;
  return x_again || y_again || goes_one_way(table, 0) || goes_one_way(table, 1);
}

}  // namespace

void refuse_uncertain_points(const SourceFile& file) {
  const std::optional<Triples> triples = triples_of(file);
  if (!triples || names_a_width(file)) return;
  if (almost_fill_a_lattice(*triples))
    refuse_file(file,
                "has three columns, and the first two hold almost all points of a lattice: x y z triples "
                "with gaps or repeats, or a matrix of heights",
                "give `format` = \"xyz\" or `format` = \"text\"");
  constexpr int many = 100;
  const int rows = triples->table.rows;
  if (rows >= many && 2 * triples->x.lines >= rows && 2 * triples->y.lines >= rows)
    refuse_file(
        file,
        "has three columns and a hundred lines or more: it may be x y z points that are not on a lattice, or "
        "a matrix of heights",
        "grid the points first, or say `format` = \"text\"");
  if (may_fit_a_lattice(*triples))
    refuse_file(file,
                "has three columns: it may be x y z points of a lattice with holes, or a matrix of heights",
                "give `format` = \"xyz\" for points with holes, or `format` = \"text\" for a matrix");
}

extern constexpr Format xyz_format{"xyz",
                                   "x y z triples on a lattice",
                                   {"Lines of x, y and z on a lattice, in any order, with holes.",
                                    "Points that are not on a lattice, points given twice.",
                                    "Files of the public test set of SurfaceTopography."},
                                   {FirstLine::bottom, "The coordinates of the points."},
                                   {"xyz"},
                                   recognises_xyz,
                                   read_xyz,
                                   nullptr,
                                   true};

}  // namespace asperity
