// SPDX-License-Identifier: GPL-3.0-or-later
// One pass; no regular expressions, no locale. std::from_chars rounds correctly.
#include "engine/core/files/text_table.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace asperity {

namespace {

constexpr std::size_t longest_number = 64;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

// Two cells or more, each with at most one comma, between digits.
bool commas_are_decimal(std::string_view line) {
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto is_decimal = [&](std::string_view cell) {
    const std::size_t comma = cell.find(',');
    return comma == std::string_view::npos ||
           (comma == cell.rfind(',') && comma > 0 && comma + 1 < cell.size() && is_digit(cell[comma - 1]) &&
            is_digit(cell[comma + 1]));
  };
  const std::vector<std::string_view> cells = cells_of(line, Separator::blank);
  return cells.size() > 1 && line.find('.') == std::string_view::npos &&
         std::ranges::all_of(cells, is_decimal);
}

[[noreturn]] void refuse_cell(const SourceFile& file, std::size_t line, std::size_t index,
                              std::string_view cell, CellKind kind) {
  const std::string here =
      "line " + std::to_string(line) + ", cell " + std::to_string(index + 1) + ": " + shown(cell);
  if (kind == CellKind::infinite)
    refuse_file(file, "has an infinite number in " + here, "mark missing points with nan");
  if (kind == CellKind::too_large) refuse_file(file, "has a number too large for a double in " + here);
  refuse_file(file, "has no number in " + here);
}

}  // namespace

bool LineReader::next(std::string_view& line) {
  if (position_ >= text_.size()) return false;
  const std::size_t end = text_.find_first_of("\r\n", position_);
  ++number_;
  if (end == std::string_view::npos) {
    line = text_.substr(position_);
    position_ = text_.size();
    return true;
  }
  line = text_.substr(position_, end - position_);
  position_ = end + 1;
  if (text_[end] == '\r') {
    // One search per run of CR: linear cost.
    if (end >= run_end_) run_end_ = std::min(text_.find_first_not_of('\r', end), text_.size());
    if (run_end_ < text_.size() && text_[run_end_] == '\n') position_ = run_end_ + 1;
  }
  return true;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

Separator separator_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return Separator::semicolon;
  if (line.find(',') != std::string_view::npos && !commas_are_decimal(trimmed(line))) return Separator::comma;
  if (line.find('\t') == std::string_view::npos) return Separator::blank;
  // Blanks inside a cell: tabs are blanks too.
  for (const std::string_view cell : cells_of(line, Separator::tab))
    if (trimmed(cell).find(' ') != std::string_view::npos) return Separator::blank;
  return Separator::tab;
}

std::vector<std::string_view> cells_of(std::string_view line, Separator separator) {
  std::vector<std::string_view> cells;
  if (separator == Separator::blank) {
    std::size_t k = 0;
    while (k < line.size()) {
      while (k < line.size() && is_blank(line[k])) ++k;
      const std::size_t start = k;
      while (k < line.size() && !is_blank(line[k])) ++k;
      if (k > start) cells.push_back(line.substr(start, k - start));
    }
    return cells;
  }
  std::size_t start = 0;
  for (;;) {
    const std::size_t end = line.find(static_cast<char>(separator), start);
    cells.push_back(trimmed(line.substr(start, end == std::string_view::npos ? end : end - start)));
    if (end == std::string_view::npos) return cells;
    start = end + 1;
  }
}

TextCell read_cell(std::string_view text, Separator separator) {
  const TextCell hole{CellKind::hole, std::numeric_limits<double>::quiet_NaN()};
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  if (text.empty()) return hole;
  if (text.size() > longest_number) return {};
  std::array<char, longest_number> copy;
  std::ranges::copy(text, copy.begin());
  if (separator != Separator::comma) std::replace(copy.begin(), copy.begin() + std::ssize(text), ',', '.');
  const char* first = copy.data();
  const char* const last = first + text.size();
  if (*first == '+' && text.size() > 1 && first[1] != '-') ++first;
  double value = 0;
  const auto [end, failure] = std::from_chars(first, last, value);
  if (end == last && failure == std::errc{}) {
    if (std::isnan(value)) return hole;
    if (std::isinf(value)) return {CellKind::infinite, value};
    return {CellKind::number, value};
  }
  if (end == last && failure == std::errc::result_out_of_range) {
    // Underflow is zero, overflow is no height.
    const std::string lower = lower_case(std::string(first, last));
    const std::size_t exponent = lower.find('e');
    if (exponent != std::string::npos && lower.substr(exponent + 1).starts_with('-'))
      return {CellKind::number, 0.0};
    return {CellKind::too_large, 0};
  }
  static constexpr std::array<std::string_view, 7> names{"nan", "bad", "na", "n/a", "#n/a", "null", "none"};
  const std::string word = lower_case(text);
  if (std::ranges::find(names, word) != names.end()) return hole;
  if (word.find_first_not_of('-') == std::string::npos || word.find_first_not_of('*') == std::string::npos)
    return hole;
  if (word == "1.#inf" || word == "-1.#inf") return {CellKind::infinite, 0};
  if (word.find("#qnan") != std::string::npos || word.find("#ind") != std::string::npos) return hole;
  return {};
}

bool is_row_of_numbers(std::string_view line) {
  line = trimmed(without_comment(line));
  if (line.empty()) return false;
  const Separator separator = separator_of(line);
  bool some = false;
  for (const std::string_view cell : cells_of(line, separator)) {
    if (read_cell(cell, separator).kind == CellKind::unreadable) return false;
    if (!cell.empty()) some = true;
  }
  return some;
}

bool is_skipped(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.front() == '#' || line.front() == '%';
}

Array<double> TextTable::column(std::size_t k) const {
  Array<double> found(static_cast<std::size_t>(rows));
  for (std::size_t j = 0; j < found.size(); ++j) found[j] = values[j * static_cast<std::size_t>(columns) + k];
  return found;
}

TextTable read_table(LineReader& lines, const SourceFile& file, Monitor& monitor) {
  TextTable table;
  Task task(monitor, "reading", static_cast<std::int64_t>(file.text().size() - lines.position()));
  Separator separator = Separator::blank;
  bool last_column_empty = true;
  std::string_view line;
  std::size_t before = lines.position();
  while (lines.next(line)) {
    task.advance(static_cast<std::int64_t>(lines.position() - before));
    before = lines.position();
    if (is_skipped(line)) continue;
    line = without_comment(line);
    if (table.rows == 0) separator = separator_of(line);
    if (separator != Separator::tab) line = trimmed(line);  // leading and trailing tabs are empty cells
    const std::vector<std::string_view> cells = cells_of(line, separator);
    if (table.rows == 0) {
      if (cells.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        refuse_file(file, "has too many columns");
      table.columns = static_cast<int>(cells.size());
    } else if (std::ssize(cells) != table.columns) {
      refuse_file(file,
                  "has " + std::to_string(cells.size()) + " cells in line " + std::to_string(lines.number()) +
                      " but " + std::to_string(table.columns) + " in the lines before it",
                  "every line of a table needs the same number of cells");
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const TextCell cell = read_cell(cells[k], separator);
      if (cell.kind != CellKind::number && cell.kind != CellKind::hole)
        refuse_cell(file, lines.number(), k, cells[k], cell.kind);
      table.values.push_back(cell.value);
    }
    if (!cells.back().empty()) last_column_empty = false;
    if (table.rows == std::numeric_limits<int>::max()) refuse_file(file, "has too many lines");
    ++table.rows;
  }
  if (table.rows == 0) refuse_file(file, "holds no table of numbers", "give one line of numbers a row");
  if (last_column_empty && table.columns > 1) {
    const auto columns = static_cast<std::size_t>(table.columns);
    std::size_t to = 0;
    for (std::size_t from = 0; from < table.values.size(); ++from)
      if (from % columns != columns - 1) table.values[to++] = table.values[from];
    table.values.resize(to);
    --table.columns;
  }
  return table;
}

std::size_t even_values(std::span<const double> values, double share) {
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  if (!(step > 0) || !std::isfinite(step)) return 0;
  std::size_t k = 0;
  while (k < values.size() &&
         std::abs(values[k] - (values.front() + static_cast<double>(k) * step)) <= share * step)
    ++k;
  return k;
}

bool ends_with_line_end(const SourceFile& file) {
  const std::string_view text = file.text();
  return text.empty() || text.back() == '\n' || text.back() == '\r';
}

void warn_if_cut(const SourceFile& file, Monitor& monitor) {
  if (!ends_with_line_end(file))
    monitor.warn(file_name(file.path()) +
                 ": the last line has no line end; if the file was cut short its last height may be wrong");
}

}  // namespace asperity
