// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/own_head.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>

#include "engine/core/files/text_table.hpp"
#include "engine/surface/io/foreign_format.hpp"

namespace asperity {

namespace {

constexpr std::size_t most_lines = 1000, longest_setting = 200;

// `words` stand between bars.
bool is_one_of(const std::string& text, std::string_view words) {
  return words.find("|" + text + "|") != std::string_view::npos;
}

// "X-Size_[um]" gives "x size" and "um".
struct SettingKey {
  std::string name;
  std::string unit;
};

SettingKey setting_key(std::string_view text) {
  SettingKey key;
  if (const std::size_t begins = text.find_first_of("[("); begins != std::string_view::npos) {
    const std::size_t ends = text.find_first_of("])", begins);
    if (ends != std::string_view::npos)
      key.unit = std::string(trimmed(text.substr(begins + 1, ends - begins - 1)));
    text = text.substr(0, begins);
  }
  for (const char c : lower_case(text)) {
    const bool gap = c == '_' || c == '-' || c == '.' || c == ' ' || c == '\t' || c == '"';
    if (!gap)
      key.name += c;
    else if (!key.name.empty() && key.name.back() != ' ')
      key.name += ' ';
  }
  key.name = std::string(trimmed(key.name));
  for (const std::string_view prefix : {"number of ", "no of ", "num "})
    if (key.name.starts_with(prefix)) key.name.erase(0, prefix.size());
  return key;
}

// Blanks between number and word are optional.
struct Stated {
  double number = 0;
  std::string word;
};

std::optional<Stated> stated_value(std::string_view text) {
  text = trimmed(text);
  std::size_t ends = text.find_first_not_of("+-0123456789.,eE");
  if (ends == std::string_view::npos) ends = text.size();
  std::string digits(text.substr(0, ends));
  while (!digits.empty() && (digits.back() == 'e' || digits.back() == 'E')) digits.pop_back(), --ends;
  if (std::ranges::count(digits, ',') == 1 && digits.find('.') == std::string::npos) {
    const std::size_t comma = digits.find(',');
    if (digits.find_first_not_of("0123456789", comma + 1) == std::string::npos && digits.size() - comma == 4)
      return {};  // "1,250" may be thousands
    digits[comma] = '.';
  }
  const TextCell cell = read_cell(trimmed(digits), Separator::blank);
  if (cell.kind != CellKind::number) return {};
  return Stated{cell.value, std::string(trimmed(text.substr(ends)))};
}

std::optional<double> stated_length(const Stated& value, const std::string& unit_of_key) {
  const std::string& word = value.word.empty() ? unit_of_key : value.word;
  if (word.empty() || !(value.number > 0)) return {};
  const std::optional<double> unit = length_unit(word);
  if (!unit || !std::isfinite(value.number * *unit)) return {};
  return value.number * *unit;
}

std::optional<double> stated_count(const Stated& value) {
  const bool whole = value.number >= 1 && value.number < 1e9 && value.number == std::floor(value.number);
  if (!whole ||
      !(value.word.empty() || lower_case(value.word) == "pixels" || lower_case(value.word) == "points"))
    return {};
  return value.number;
}

// "10 um x 20 um", "512 × 512"
std::optional<std::array<std::string_view, 2>> two_values(std::string_view text) {
  for (const std::string_view mark : {" x ", " X ", " * ", "\u00D7"})
    if (const std::size_t at = text.find(mark); at != std::string_view::npos)
      return std::array{trimmed(text.substr(0, at)), trimmed(text.substr(at + mark.size()))};
  const auto digit = [&](std::size_t at) { return std::isdigit(static_cast<unsigned char>(text[at])) != 0; };
  for (std::size_t at = 1; at + 1 < text.size(); ++at)  // "512x512"
    if (text[at] == 'x' && digit(at - 1) && digit(at + 1))
      return std::array{text.substr(0, at), text.substr(at + 1)};
  return {};
}

// Contradictory values become NaN, and are later dropped.
void settle(OwnHead& head, std::optional<double> OwnHead::*member, const std::optional<double>& value,
            std::string_view what) {
  if (!value) return;
  std::optional<double>& held = head.*member;
  if (!held) {
    held = value;
  } else if (!std::isnan(*held) && std::abs(*held - *value) > 1e-6 * std::abs(*value)) {
    head.twice.emplace_back(what);
    held = std::numeric_limits<double>::quiet_NaN();
  }
}

void leave_out_unsettled(OwnHead& head) {
  using O = OwnHead;
  for (const auto member : {&O::stated_columns, &O::stated_rows, &O::size_x, &O::size_y, &O::spacing_x,
                            &O::spacing_y, &O::size, &O::unit})
    if (head.*member && std::isnan(*(head.*member))) (head.*member).reset();
}

struct AxisWords {
  std::string_view name, count_name, counts, sizes, spacings;
  std::optional<double> OwnHead::*count, OwnHead::*size, OwnHead::*spacing;
};
constexpr std::array axes{
    AxisWords{"x", "its columns",
              "|columns|cols|nx|x points|points x|x pixels|pixels x|xpixels|samples per line|samples/line|"
              "points per line|points/line|pixels per line|",
              "|x size|size x|x range|range x|x length|length x|xlength|width|scan width|",
              "|dx|x spacing|x step|x increment|x pixel size|pixel size x|pixel width|spacing x|",
              &OwnHead::stated_columns, &OwnHead::size_x, &OwnHead::spacing_x},
    AxisWords{"y", "its rows", "|rows|lines|ny|y points|points y|y pixels|pixels y|",
              "|y size|size y|y range|range y|y length|length y|ylength|scan height|",
              "|dy|y spacing|y step|y increment|y pixel size|pixel size y|pixel height|spacing y|",
              &OwnHead::stated_rows, &OwnHead::size_y, &OwnHead::spacing_y}};
constexpr std::string_view both_counts = "|pixels|points|samples|resolution|";
constexpr std::string_view both_sizes = "|size|scan size|scan range|scan area|field of view|fov|image size|";
constexpr std::string_view both_spacings =
    "|pixel size|pixelsize|pixel spacing|point spacing|spacing|xy spacing|xy calibration|lateral sampling|"
    "sampling interval|";
constexpr std::string_view height_units =
    "|z unit|z units|unit z|height unit|height units|unit of height|units of height|value unit|value units|";
constexpr std::string_view height_words = "|z|height|heights|raw|topography|";

void take_setting(OwnHead& head, const SettingKey& key, std::string_view value) {
  if (is_one_of(key.name, height_units))
    return settle(head, &OwnHead::unit, length_unit(value), "the unit of its heights");
  const auto both = two_values(value);
  const auto x = stated_value(both ? (*both)[0] : value), y = stated_value(both ? (*both)[1] : value);
  if (!x || !y) return;
  const std::string& unit = both && !y->word.empty() ? y->word : key.unit;  // "10 x 20 um"
  for (const AxisWords& axis : axes) {
    const Stated& stated = &axis == &axes[0] ? *x : *y;
    const std::optional<double> length = stated_length(stated, unit);
    const std::string along = " along " + std::string(axis.name);
    if (is_one_of(key.name, both ? both_sizes : axis.sizes))
      settle(head, axis.size, length, "its size" + along);
    if (is_one_of(key.name, both_spacings) || (!both && is_one_of(key.name, axis.spacings)))
      settle(head, axis.spacing, length, "its spacing" + along);
    if (unit.empty() && is_one_of(key.name, both ? both_counts : axis.counts))
      settle(head, axis.count, stated_count(stated), axis.count_name);
  }
  if (!both && is_one_of(key.name, both_sizes))
    settle(head, &OwnHead::size, stated_length(*x, unit), "its size");
}

// For example "X Range: 10 um", "Columns = 3", "\"XY calibration\",\"277\",\"nm\"", "Scan size 10 um".
void take_head_line(OwnHead& head, std::string_view line) {
  if (line.size() > longest_setting) return;
  std::string plain;  // cells separated by one blank
  for (const char c : line)
    if (c != '"') plain += c == '\t' || c == ';' ? ' ' : c;
  std::size_t parts = plain.find_first_of(":=");
  if (parts == std::string::npos) {
    if (const std::size_t comma = plain.find(','); comma != std::string::npos) {
      parts = comma;
      std::replace(plain.begin() + static_cast<std::ptrdiff_t>(comma), plain.end(), ',', ' ');
    } else {
      parts = plain.find_first_of("0123456789");
      if (parts == std::string::npos) parts = plain.find_last_of(' ') + 1;  // "z unit nm"
      if (parts == 0 || plain[parts - 1] != ' ') return;
      --parts;
    }
  }
  take_setting(head, setting_key(std::string_view(plain).substr(0, parts)),
               std::string_view(plain).substr(parts + 1));
}

bool rises_evenly(std::span<const double> values, double share) {
  return even_values(values, share) == values.size();
}

}  // namespace

std::optional<OwnHead> own_head(const SourceFile& file) {
  if (!file.looks_like_text() || file.text().starts_with("# asperity") || foreign_format(file)) return {};
  OwnHead head;
  std::vector<std::string_view> settings;
  std::string_view line, last;
  std::size_t rows = 0, begins = 0, words = 0;
  for (LineReader lines(file.text()); rows < 2;) {
    if (words > most_lines || !lines.next(line)) return {};
    line = trimmed(line);
    if (is_skipped(line)) {
      settings.push_back(without_mark(line));
      continue;
    }
    if (is_row_of_numbers(line)) {
      if (words == 0) return {};
      const std::size_t cells = cells_of(line, separator_of(line)).size();
      if (rows > 0 && cells != head.columns) rows = 0, last = {};  // a line of the head
      if (rows == 0) begins = lines.number();
      head.columns = cells;
      ++rows;
      continue;
    }
    const bool known = line.starts_with("h=") && line.find("w=") != std::string_view::npos;
    if (words == 0 && (known || profile_head(line) || xyz_head(line))) return {};
    if (words++ == 0) {
      head.words = shown(line);
      head.first = lines.number();
    }
    rows = 0;
    last = line;
    settings.push_back(line);
  }
  head.lines = begins - 1;
  for (const std::string_view setting : settings) take_head_line(head, setting);
  if (auto names = column_head(last)) {
    // A sentence may have as many words.
    const bool parted = last.find_first_of(";,\t") != std::string_view::npos;
    const bool have_units =
        std::ranges::any_of(*names, [](const HeadColumn& column) { return !column.word.empty(); });
    const bool alone = names->size() == 1 && is_one_of(names->front().name, height_words);
    if (names->size() == head.columns &&
        (parted || have_units || are_points(*names) || are_of_profile(*names)))
      head.names = std::move(names);
    else if (alone && names->front().unit)
      settle(head, &OwnHead::unit, names->front().unit, "the unit of its heights");
  }
  leave_out_unsettled(head);
  return head;
}

void refuse_uncertain_lattice(const SourceFile& file, const OwnHead& head) {
  const auto refuse_as = [&](const std::string& finding, const std::string& cure) {
    refuse_file(file,
                "has a head in lines " + std::to_string(head.first) + " (" + head.words + ") to " +
                    std::to_string(head.lines) + " over " + counted(head.columns, "column") +
                    " of numbers: " + finding,
                cure);
  };
  const std::string as_matrix = "say `format` = \"text\" for a matrix of heights";
  const std::size_t columns = head.columns;
  if (columns == 1 || head.stated_columns || (head.names && are_of_profile(*head.names))) return;
  if (head.names)
    refuse_as("line " + std::to_string(head.lines) + " names other columns than positions and heights",
              "read a table of measured numbers by `table.read`; " + as_matrix);
  if (columns == 3)
    refuse_as("they may be x y z points, or a matrix of heights",
              "for points, write a line such as \"x [mm],y [mm],z [um]\" below the head; " + as_matrix);
  LineReader lines(file.text());
  std::string_view line;
  while (lines.number() < head.lines && lines.next(line)) continue;
  const TextTable table = read_table(lines, file, Monitor::silent());
  const auto nx = static_cast<std::size_t>(table.columns), ny = static_cast<std::size_t>(table.rows);
  const Array<double> column = table.column(0);
  if (nx == 2 && ny > 2 && rises_evenly(column, 0.25))
    refuse_as("they may be positions and heights, or a matrix of heights",
              "for a trace, write a line such as \"x [mm],z [um]\" below the head; with `format` = \"text\", "
              "`profile.read` takes positions and heights, `surface.read` a matrix");
  constexpr std::size_t enough = 4;
  constexpr double rounded = 0.02;  // of a step; tilted maps scatter more
  // The shared corner may hold anything.
  const auto may_be_positions = [&](std::span<const double> values) {
    return values.size() > enough && rises_evenly(values.subspan(1), rounded);
  };
  const bool of_column = may_be_positions(column);
  if (of_column || may_be_positions({table.values.data(), nx}))
    refuse_as("its first " + std::string(of_column ? "column" : "line") + " rises evenly, as positions do",
              "delete the positions; " + as_matrix);
  constexpr std::size_t wrapped = 20;
  if (ny >= wrapped * nx)
    refuse_as(std::to_string(ny) + " lines may be a wrapped matrix, or columns of a log",
              "for a matrix, write \"columns = " + std::to_string(nx) + "\" into the head; " + as_matrix);
}

}  // namespace asperity
