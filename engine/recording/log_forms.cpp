// SPDX-License-Identifier: GPL-3.0-or-later
// Foreign names and units without brackets in press tables (log_table.hpp).
#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/files/text_encoding.hpp"
#include "engine/recording/log_table.hpp"
#include "engine/statistics/table_head.hpp"
#include "engine/statistics/time_stamp.hpp"

namespace asperity {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 20> other_names{
    {{"force", "load"},         {"kraft", "load"},      {"last", "load"},         {"charge", "load"},
     {"druck", "pressure"},     {"stress", "pressure"}, {"spannung", "pressure"}, {"zeit", "time"},
     {"temps", "time"},         {"uhrzeit", "time"},    {"timestamp", "time"},    {"angle", "rotation"},
     {"winkel", "angle"},       {"winkel", "rotation"}, {"hold", "dwell"},        {"haltezeit", "dwell"},
     {"standardkraft", "load"}, {"prüfkraft", "load"},  {"prüfzeit", "time"},     {"drehwinkel", "angle"}}};

struct LineKind {
  enum class Kind { words, units, row, other };
  Kind kind = Kind::other;
  std::size_t cells = 0;
  bool is(Kind wanted, std::size_t count) const { return kind == wanted && cells == count; }
};

LineKind kind_of(std::string_view line) {
  const Separator separator = line.find(';') != std::string_view::npos    ? Separator::semicolon
                              : line.find('\t') != std::string_view::npos ? Separator::tab
                                                                          : Separator::comma;
  std::size_t words = 0, units = 0, values = 0;
  bool begins = false;
  const std::vector<std::string> cells = log_cells(line);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (cells[k].empty()) continue;
    if (read_cell(cells[k], separator).kind == CellKind::number || is_time_stamp(cells[k])) {
      ++values;
      begins = begins || k == 0;
    } else {
      ++words;
      units += unit_in_cell(utf8_or_cp1252(cells[k])) ? 1 : 0;
    }
  }
  using Kind = LineKind::Kind;
  return {begins && values > 1      ? Kind::row
          : values > 0 || words < 2 ? Kind::other
          : units == words          ? Kind::units
                                    : Kind::words,
          cells.size()};
}

}  // namespace

bool is_time_stamp(std::string_view cell) { return read_time_stamp(cell).kind != TimeStamp::Kind::none; }

bool is_day_of_a_spreadsheet(const TextCell& cell) {
  constexpr double first = 36526, last = 73415;
  return cell.kind == CellKind::number && cell.value >= first && cell.value <= last;
}

LogTitle log_title(std::string_view title) {
  title = trimmed(title);
  LogTitle parts;
  const std::size_t end = std::min(title.find_first_of(" _/[(:,\t"), title.size());
  parts.name = lower_case(title.substr(0, end));
  std::string_view rest = title.substr(end);
  while (!rest.empty() && std::string_view(" _/:,\t").find(rest.front()) != std::string_view::npos)
    rest.remove_prefix(1);
  // "force applied [kN]"
  if (const std::size_t open = rest.find_last_of("[("); open != std::string_view::npos)
    rest = rest.substr(open);
  parts.unit = bare_unit(rest);
  return parts;
}

std::vector<std::string> log_cells(std::string_view line) {
  const auto has = [&](char mark) { return find_unquoted(line, mark) != std::string_view::npos; };
  const char mark = has(';') ? ';' : has('\t') ? '\t' : ',';
  std::vector<std::string> cells;
  for (;;) {
    const std::size_t end = find_unquoted(line, mark);
    std::string_view cell = trimmed(line.substr(0, end));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    cells.emplace_back(cell);
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

std::optional<FoundHeads> find_heads(TableLines lines) {
  constexpr std::size_t most = 300, rows = 3;
  std::vector<std::pair<FoundHeads, LineKind>> all;
  for (std::string_view line; all.size() < most && lines.next_line(line);) {
    if (TableLines::is_comment(line)) continue;
    const std::string_view text = TableLines::without_comment(line);
    all.push_back({{lines.line(), std::string(text)}, kind_of(text)});
  }
  using Kind = LineKind::Kind;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].second.kind != Kind::words) continue;
    const std::size_t cells = all[k].second.cells;
    std::size_t first = k + 1;
    if (first < all.size() && all[first].second.is(Kind::units, cells)) ++first;
    const std::size_t end = std::min(all.size(), first + rows);
    bool table = first < end;
    for (std::size_t i = first; i < end; ++i) table = table && all[i].second.is(Kind::row, cells);
    if (table) return all[k].first;
  }
  return {};
}

bool means(std::string_view word, std::string_view column) {
  return word == column || std::any_of(other_names.begin(), other_names.end(), [&](const auto& pair) {
           return pair.first == word && pair.second == column;
         });
}

bool surely_means(std::string_view word, std::string_view column) {
  return means(word, column) && (word == column || column != "rotation");
}

std::string past_midnight(double seconds_back) {
  constexpr double half_a_day = 43200;
  return seconds_back > half_a_day ? "; times of day that go past midnight need their dates" : "";
}

std::string_view thousands_in(std::string_view text) {
  constexpr std::array<std::string_view, 6> blanks{" ", "\xC2\xA0", "\xE2\x80\xAF", "'", ",", "."};
  text = trimmed(text);
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  if (text.empty() || text.find_first_not_of("0123456789") == 0) return "";
  std::string_view first;
  while (!text.empty()) {
    text.remove_prefix(std::min(text.find_first_not_of("0123456789"), text.size()));
    if (text.empty()) break;
    const auto sign =
        std::find_if(blanks.begin(), blanks.end(), [&](auto each) { return text.starts_with(each); });
    if (sign == blanks.end()) return "";
    text.remove_prefix(sign->size());
    if (text.empty() || text.find_first_of("0123456789") != 0) return "";
    if (first.empty()) first = sign - blanks.begin() < 3 ? " " : *sign;
  }
  return first;
}

}  // namespace asperity
