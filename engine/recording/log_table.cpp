// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/log_table.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/files/text_encoding.hpp"
#include "engine/surface/io/foreign_format.hpp"

namespace asperity {

namespace {

const SourceFile& checked_text(const SourceFile& file) {
  if (const std::optional<ForeignFormat> foreign = foreign_format(file))
    refuse_file(file, "is not text that can be read: it is " + foreign->what, foreign->cure);
  return file;
}

// A title such as "[hh:mm:ss]".
bool is_clock_pattern(std::string_view unit) {
  return unit.find(':') != std::string_view::npos &&
         unit.find_first_not_of("hHmMsSfFnidDyYaAJjTt:.,/- ") == std::string_view::npos;
}

constexpr std::array<std::pair<std::string_view, std::string_view>, 20> other_names{
    {{"force", "load"},         {"kraft", "load"},      {"last", "load"},         {"charge", "load"},
     {"druck", "pressure"},     {"stress", "pressure"}, {"spannung", "pressure"}, {"zeit", "time"},
     {"temps", "time"},         {"uhrzeit", "time"},    {"timestamp", "time"},    {"angle", "rotation"},
     {"winkel", "angle"},       {"winkel", "rotation"}, {"hold", "dwell"},        {"haltezeit", "dwell"},
     {"standardkraft", "load"}, {"prüfkraft", "load"},  {"prüfzeit", "time"},     {"drehwinkel", "angle"}}};

// "kraft" is load, "angle" rotation.
bool means(std::string_view word, std::string_view column) {
  return word == column || std::ranges::find(other_names, std::pair{word, column}) != other_names.end();
}

// Ambiguous: an angle may be the stage's or a rotation.
bool surely_means(std::string_view word, std::string_view column) {
  return means(word, column) && (word == column || column != "rotation");
}

// Since 1900.
bool is_day_of_a_spreadsheet(const TextCell& cell) {
  constexpr double first = 36526, last = 73415;
  return cell.kind == CellKind::number && cell.value >= first && cell.value <= last;
}

std::vector<TableCell> log_cells(std::string_view line) {
  return split_cells(line, marks_in(line).value_or(Separator::comma));
}

struct LogLine {
  enum class Kind { words, units, row, other };
  std::size_t number;  // from 1
  std::string text;
  Kind kind = Kind::other;
  std::size_t cells = 0;
};

LogLine log_line(std::size_t number, std::string_view text) {
  std::size_t words = 0, units = 0, values = 0;
  bool begins = false;
  const std::vector<TableCell> cells = log_cells(text);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::string& cell = cells[k].text;
    if (cell.empty()) continue;
    if (read_cell(cell, Separator::blank).kind == CellKind::number || is_time_stamp(cell)) {
      ++values;
      begins = begins || k == 0;
    } else {
      ++words;
      units += unit_in_cell(utf8_or_cp1252(cell)) ? 1 : 0;
    }
  }
  using Kind = LogLine::Kind;
  const Kind kind = begins && values > 1      ? Kind::row
                    : values > 0 || words < 2 ? Kind::other
                    : units == words          ? Kind::units
                                              : Kind::words;
  return {number, std::string(text), kind, cells.size()};
}

// The first line of words above a table, among 300 lines. The table has three rows, or fewer at the end of
// the file, of as many cells, with numbers or times in the first cell and another.
std::optional<LogLine> find_heads(TableLines lines) {
  constexpr std::size_t most = 300;
  constexpr std::ptrdiff_t rows = 3;
  std::vector<LogLine> all;
  for (std::string_view line; all.size() < most && lines.next_line(line);)
    if (!TableLines::is_comment(line))
      all.push_back(log_line(lines.line(), TableLines::without_comment(line)));
  for (auto heads = all.begin(); heads != all.end(); ++heads) {
    const auto is = [&](const LogLine& line, LogLine::Kind kind) {
      return line.kind == kind && line.cells == heads->cells;
    };
    auto first = heads + 1;
    if (first != all.end() && is(*first, LogLine::Kind::units)) ++first;
    const auto end = first + std::min(rows, all.end() - first);
    if (heads->kind == LogLine::Kind::words && first != end &&
        std::all_of(first, end, [&](const LogLine& line) { return is(line, LogLine::Kind::row); }))
      return *heads;
  }
  return {};
}

NumberEvidence evidence_of(std::string_view text) {
  NumberEvidence evidence('\0', '\0');
  evidence.add(text, "");
  return evidence;
}

}  // namespace

LogTable::LogTable(const SourceFile& file, std::span<const LogColumn> known, const TableForm& form)
    : file_(checked_text(file)), known_(known), form_(form), lines_(file, form), problems_(file) {}

std::string LogTable::here(std::size_t column) const {
  const LogColumn* known = columns_[column].known;
  return here() + ", column " + std::to_string(column + 1) + " (" +
         (known != nullptr ? std::string(known->name) : "?") + ")";
}

void LogTable::read_titles() {
  refuse_unknown_names();
  skip_preamble();
  if (!lines_.read_heads())
    refuse_file(file_, "holds no line of column titles",
                "begin with one such as \"time [s], pressure [MPa], rotation [deg], dwell [min]\"");
  for (const TableCell& cell : lines_.heads()) {
    columns_.emplace_back();
    columns_.back().title = cell.text;
    split_unit(columns_.back());
  }
  choose_columns();
  match_titles();
  if (!lines_.heads_are_given()) refuse_other_forms();
  const bool below_are_units = units_stand_below();
  for (std::size_t k = 0; k < columns_.size(); ++k)
    if (columns_[k].known != nullptr) read_unit(k, below_are_units);
  if (below_are_units) lines_.skip_below();
}

void LogTable::skip_preamble() {
  if (form_.skip > 0 || !form_.heads.empty()) return;
  TableLines ahead = lines_;
  std::string_view first;
  while (ahead.next_line(first) &&
         (TableLines::is_comment(first) || lower_case(trimmed(first)).starts_with("sep="))) {
  }
  const std::optional<LogLine> heads = find_heads(lines_);
  if (!heads || heads->number <= ahead.line()) return;
  if (const std::size_t known = count_known(TableLines::without_comment(first));
      known > 0 && known >= count_known(heads->text))
    return;
  for (std::string_view line; lines_.line() + 1 < heads->number && lines_.next_line(line);) {
  }
  warnings_.push_back(file_name(file_.path()) + ": the titles of its columns were found in line " +
                      std::to_string(heads->number) + "; the lines above are left out");
}

std::vector<std::string> LogTable::known_names() const {
  std::vector<std::string> names;
  for (const LogColumn& column : known_) names.emplace_back(column.name);
  return names;
}

void LogTable::refuse_unknown_names() const {
  const std::vector<std::string> names = known_names();
  for (const auto& [name, title] : form_.names)
    if (std::ranges::find(names, name) == names.end())
      refuse_name("`columns` names " + quoted(name) + ", which is no column of a protocol" +
                      did_you_mean(name, names),
                  "its columns are " + joined(names, " and "));
}

void LogTable::split_unit(Column& column) const {
  const std::string_view title = column.title;
  const TableHead head = table_head(title);
  column.name = lower_case(head.name);
  column.unit = head.unit;
  if (!column.unit.empty()) return;
  if (column.name.find_first_of("[(") != std::string::npos) {
    // "load (kNewton)": a unit, even if unknown.
    const std::size_t open = title.find_first_of("[("), close = title.find_last_of("])");
    if (open == 0) return;
    column.name = lower_case(trimmed(title.substr(0, open)));
    if (close != std::string_view::npos && close > open)
      column.unit = std::string(trimmed(title.substr(open + 1, close - open - 1)));
    return;
  }
  // Split only if the front names a column: "time_s", "load/kN".
  for (const char mark : {'_', '/', ' ', ':'}) {
    const std::size_t at = column.name.rfind(mark);
    if (at == std::string::npos || at == 0) continue;
    const std::string front(trimmed(std::string_view(column.name).substr(0, at)));
    const std::optional<Quantity> unit = unit_in_cell(title.substr(at + 1));
    const bool known = unit && std::ranges::any_of(known_, [&](const LogColumn& c) {
                         return surely_means(front, c.name) && c.dimension == unit->dimension;
                       });
    if (!known) continue;
    column.unit = bare_unit(title.substr(at + 1));
    column.name = front;
    return;
  }
}

// columns={ load="Wert" } overrides other names.
void LogTable::choose_columns() {
  for (const auto& [name, title] : form_.names) {
    const std::vector<HeadedColumn> heads(columns_.begin(), columns_.end());
    const HeadMatch match = find_head(heads, title, true);
    if (match.count != 1) {
      problem(here(), head_complaint(heads, match, title, name));
      continue;
    }
    const LogColumn& known = *std::ranges::find(known_, std::string_view(name), &LogColumn::name);
    columns_[match.first].known = &known;
    column_of_[static_cast<std::size_t>(known.meaning)] = match.first;
  }
}

// A foreign name needs a matching unit, or a matching cell below.
const LogColumn* LogTable::known_as(const Column& column, bool by_other_names,
                                    const std::string& below) const {
  const auto found = std::ranges::find_if(known_, [&](const LogColumn& known) {
    if (!by_other_names) return column.name == known.name;
    if (!surely_means(column.name, known.name)) return false;
    const bool said = std::ranges::any_of(form_.units, [&](const auto& pair) {
      return pair.first == known.name || lower_case(pair.first) == column.name;
    });
    if (said) return true;
    if (known.dimension == dimension::time && is_time_stamp(below)) return true;
    const std::optional<Quantity> unit =
        unit_in_cell(utf8_or_cp1252(column.unit.empty() ? below : column.unit));
    const std::optional<Quantity> quantity = unit ? unit : quantity_in_cell(below);
    return quantity && quantity->dimension == known.dimension;
  });
  return found == known_.end() ? nullptr : &*found;
}

// Own names first. Ignores other columns of a chosen meaning.
void LogTable::match_titles() {
  for (const bool by_other_names : {false, true}) {
    const auto chosen = column_of_;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      Column& column = columns_[k];
      if (column.known != nullptr) continue;
      const LogColumn* known = known_as(column, by_other_names, below(k));
      if (known == nullptr || chosen[static_cast<std::size_t>(known->meaning)]) continue;
      std::optional<std::size_t>& seat = column_of_[static_cast<std::size_t>(known->meaning)];
      if (seat) {
        problem(here() + ", column " + std::to_string(k + 1) + " (" + std::string(known->name) + ")",
                "has the same meaning as column " + std::to_string(*seat + 1) +
                    "; leave one of them out, or begin its title with \"result \"");
        continue;
      }
      seat = k;
      column.known = known;
    }
  }
}

std::size_t LogTable::count_known(std::string_view titles) const {
  std::size_t names = 0;
  for (const TableCell& cell : log_cells(titles)) {
    Column column;
    column.title = cell.text;
    split_unit(column);
    if (known_as(column, false, "") != nullptr || known_as(column, true, "") != nullptr) ++names;
  }
  return names;
}

void LogTable::refuse_other_forms() const {
  const bool numbers = is_row_of_numbers(lines_.head_line());
  if (!numbers && std::ranges::any_of(columns_, [](const Column& column) { return column.known != nullptr; }))
    return;
  const TableForm whole;
  if (const auto heads = find_heads(TableLines(file_, whole)); heads && heads->number != line())
    refuse_file(file_,
                std::string("is read from ") + (numbers ? "numbers" : "words") + " in " + here() +
                    " on, and its column titles are in line " + std::to_string(heads->number),
                "give skip=" + std::to_string(heads->number - 1));
  if (numbers)
    refuse_file(file_, "begins with numbers, in " + here() + ", and names no columns",
                "begin with a line such as \"time [s], pressure [MPa], rotation [deg], dwell [min]\", or "
                "give the titles, as in columns={ \"time [s]\", \"load [kN]\" }");
  constexpr std::size_t nearby = 100;
  TableLines ahead = lines_;
  std::string_view next;
  for (std::size_t lines = 0; lines < nearby && ahead.next_line(next); ++lines)
    if (!TableLines::is_comment(next) && count_known(TableLines::without_comment(next)) > 0)
      refuse_file(file_,
                  "begins with words, in " + here() + ", and its column titles are in line " +
                      std::to_string(ahead.line()),
                  "put # before the lines above the titles, delete them, or give skip=" +
                      std::to_string(ahead.line() - 1));
}

bool LogTable::units_stand_below() {
  bool needed = false;
  for (std::size_t k = 0; k < lines_.below().size(); ++k) {
    const std::string cell = below(k);
    if (cell.empty() || bare_unit(cell).empty() || cell == "-") continue;
    if (!unit_in_cell(utf8_or_cp1252(cell))) {
      if (k < columns_.size() && columns_[k].known == nullptr &&
          read_number(cell, form_of(k, cell)).kind != CellKind::number)
        continue;
      return false;
    }
    needed = needed || (k < columns_.size() && columns_[k].known != nullptr && columns_[k].unit.empty());
  }
  return needed;
}

void LogTable::read_unit(std::size_t k, bool below_are_units) {
  using Kind = CellColumn::Kind;
  Column& column = columns_[k];
  const LogColumn& known = *column.known;
  const std::string place = here(k);
  if (known.dimension == dimension::number) {
    column.cells.emplace(Kind::numbers, "", dimension::number, form_);
    return;
  }
  for (const auto& [name, unit] : form_.units)
    if (name == known.name || lower_case(name) == lower_case(column.title)) column.unit = unit;
  if (known.dimension == dimension::time && is_clock_pattern(column.unit)) column.unit.clear();
  if (column.unit.empty() && below_are_units) column.unit = bare_unit(below(k));
  column.unit = utf8_or_cp1252(column.unit);
  if (column.unit.empty()) return read_without_unit(k, place);
  try {
    column.cells.emplace(Kind::numbers, column.unit, std::nullopt, form_);
    if (column.cells->dimension() != known.dimension)
      problem(place, "has the unit " + shown(column.unit) + " of " + describe(column.cells->dimension()) +
                         " where " + describe(known.dimension) + " is wanted; write \"" +
                         std::string(known.example) + "\"");
  } catch (const Error& error) {
    problem(place, error.what());
  }
}

void LogTable::read_without_unit(std::size_t k, const std::string& place) {
  using Kind = CellColumn::Kind;
  Column& column = columns_[k];
  const LogColumn& known = *column.known;
  const std::string cell = below(k), write = "write \"" + std::string(known.example) + "\"";
  const std::optional<Quantity> quantity = quantity_in_cell(cell);
  if (known.dimension == dimension::time && is_time_stamp(cell)) {
    column.cells = stamps_of(k);
  } else if (known.dimension == dimension::time &&
             is_day_of_a_spreadsheet(read_number(cell, form_of(k, cell)))) {
    column.cells.emplace(Kind::days, "", std::nullopt, form_);
    warnings_.push_back(file_name(file_.path()) + ": the column " + quoted(std::string(known.name)) +
                        " has no unit, and its numbers, such as " + shown(cell) +
                        ", are read as days of a spreadsheet; give unit={ " + std::string(known.name) +
                        "=\"s\" } for seconds");
  } else if (quantity && quantity->dimension == known.dimension) {
    column.cells.emplace(Kind::quantities, "", known.dimension, form_);
  } else {
    problem(place, "has no unit; " + write);
  }
}

CellColumn LogTable::stamps_of(std::size_t k) {
  CellColumn column(CellColumn::Kind::stamps, "", std::nullopt, form_);
  TableLines ahead = lines_;
  for (std::vector<TableCell> cells; ahead.next_row(cells);)
    if (k < cells.size() && column.stamps().learn(cells[k].text)) break;
  if (const std::optional<std::string> doubt = column.stamps().doubt()) problem(here(k), *doubt);
  return column;
}

// "load [kN]" for "Kraft / kN".
std::optional<std::string> LogTable::meant(const Column& column) const {
  // "force applied [kN]"
  const std::string word = column.name.substr(0, column.name.find_first_of(" _/[(:,\t"));
  const auto found =
      std::ranges::find_if(known_, [&](const LogColumn& known) { return means(word, known.name); });
  if (found == known_.end() || has(found->meaning)) return {};
  if (found->dimension == dimension::number) return std::string(found->name);
  const std::string written = utf8_or_cp1252(column.unit);
  const std::optional<Quantity> unit = unit_in_cell(written);
  return unit && unit->dimension == found->dimension ? std::string(found->name) + " [" + written + "]"
                                                     : std::string(found->example);
}

std::string LogTable::others() const {
  const std::vector<std::string> names = known_names();
  std::string others;
  for (const Column& column : columns_) {
    if (column.known != nullptr || column.title.empty()) continue;
    if (lower_case(column.title).starts_with("result ")) continue;
    const std::optional<std::string> title = meant(column);
    others += (others.empty() ? "" : ", ") + shown(column.title) +
              (title                                    ? " (did you mean " + quoted(*title) + "?)"
               : known_as(column, false, "") != nullptr ? ""
                                                        : did_you_mean(column.name, names));
  }
  return others;
}

void LogTable::warn_of_others(Monitor& monitor) const {
  if (const std::string names = others(); !names.empty())
    monitor.warn(file_name(file_.path()) + " has columns that a protocol does not use: " + names);
}

void LogTable::require_one_of(int pressure, int load) {
  if (has(pressure) && has(load)) {
    problem(here(),
            "both `pressure` and `load` are given; choose one, and begin the title of the other with "
            "\"result \" or leave it out");
  } else if (!has(pressure) && !has(load)) {
    const std::string names = others();
    problem(here(), "no column `pressure` or `load`" + (names.empty() ? names : " among others: " + names) +
                        "; write \"pressure [MPa]\" or \"load [N]\"" +
                        (names.empty() ? "" : ", or choose one: columns={ load=\"its head\" }"));
  }
}

// A comma is a decimal sign unless commas separate the cells; then quoted cells decide for themselves.
NumberForm LogTable::form_of(std::size_t k, const std::string& text) {
  if (form_.decimal != '\0' || form_.thousands != '\0') {
    const NumberForm form = NumberEvidence(form_.decimal, form_.thousands).form();
    return plain_number(text, form) ? form : NumberForm{};
  }
  if (text.find(',') == std::string::npos) return {};
  if (lines_.separator() != Separator::comma) {
    if (commas_.form().decimal != ',') commas_.add(text, here(k));
    return {.decimal = ','};
  }
  const NumberEvidence evidence = evidence_of(text);
  return evidence.doubt() ? NumberForm{} : evidence.form();
}

CellReading LogTable::read(std::size_t k, const TableCell& cell, bool exactly) {
  const std::string text(trimmed(std::string_view(cell.text).substr(0, cell.text.find('#'))));
  CellReading reading = columns_[k].cells->read(text, form_of(k, text), exactly);
  if (reading.kind == CellKind::hole || (reading.kind == CellKind::number && std::isfinite(reading.value)))
    return reading;
  if (reading.kind != CellKind::unreadable)
    reading = {CellKind::unreadable, 0, shown(text) + " is no finite number"};
  const NumberEvidence evidence = evidence_of(text);
  if (const auto doubt = evidence.doubt())
    reading.complaint = doubt->finding;
  else if (const char sign = evidence.form().thousands; sign != '\0')
    reading.complaint += "; give thousands=\"" + std::string(1, sign) + "\" if the sign separates thousands";
  problem(here(k), reading.complaint);
  return reading;
}

std::vector<std::string> LogTable::warnings() const {
  std::vector<std::string> warnings = warnings_;
  if (const auto doubt = commas_.doubt())
    warnings.push_back(file_name(file_.path()) + " " + doubt->place + ": " + doubt->finding +
                       "; the comma is read as a decimal sign");
  return warnings;
}

std::string past_midnight(double seconds_back) {
  constexpr double half_a_day = 43200;
  return seconds_back > half_a_day ? "; times of day that go past midnight need their dates" : "";
}

}  // namespace asperity
