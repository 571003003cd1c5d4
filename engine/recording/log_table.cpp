// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/log_table.hpp"

#include <algorithm>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/recording/log_forms.hpp"
#include "engine/surface/io/foreign_format.hpp"

namespace asperity {

namespace {

char mark_of(Separator separator) {
  return separator == Separator::semicolon ? ';' : separator == Separator::tab ? '\t' : ',';
}

// Cells with their quotes taken off; a doubled quote inside stands for one.
void split(std::string_view line, Separator separator, std::vector<LogCell>& cells) {
  cells.assign(1, {});
  std::string plain;
  bool inside = false;
  const auto finish = [&] {
    if (!cells.back().quoted) cells.back().text = std::string(trimmed(plain));
    plain.clear();
  };
  for (std::size_t k = 0; k < line.size(); ++k) {
    LogCell& cell = cells.back();
    if (inside) {
      if (line[k] != '"')
        cell.text += line[k];
      else if (k + 1 < line.size() && line[k + 1] == '"')
        cell.text += line[++k];
      else
        inside = false;
    } else if (line[k] == '"' && trimmed(plain).empty() && !cell.quoted) {
      inside = cell.quoted = true;
    } else if (line[k] == mark_of(separator)) {
      finish();
      cells.emplace_back();
    } else {
      plain += line[k];
    }
  }
  finish();
}

// Where a character first stands outside quotes.
std::size_t find_unquoted(std::string_view line, char wanted) {
  bool inside = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"') inside = !inside;
    if (line[k] == wanted && !inside) return k;
  }
  return std::string_view::npos;
}

std::string_view without_comment(std::string_view line) { return line.substr(0, find_unquoted(line, '#')); }

// A degree or micro sign as spreadsheets write it that know no UTF-8.
std::string readable_unit(std::string_view unit) {
  std::string text;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    const bool alone = k == 0 || unit[k - 1] != '\xC2';
    if (unit[k] == '\xB0' && alone)
      text += "deg";
    else if (unit[k] == '\xB5' && alone)
      text += 'u';
    else
      text += unit[k];
  }
  return text;
}

bool is_blank(const std::vector<LogCell>& cells) {
  return std::all_of(cells.begin(), cells.end(), [](const LogCell& cell) { return cell.text.empty(); });
}

bool is_comment(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.front() == '#';
}

std::string_view name_in(std::string_view title) {
  return trimmed(title.substr(0, title.find_first_of("[(")));
}

}  // namespace

LogTable::LogTable(const SourceFile& file, std::span<const LogColumn> known)
    : file_(file), known_(known), lines_(file.text()) {
  if (const std::optional<ForeignFormat> foreign = foreign_format(file_))
    refuse_file(file_, "is not text that can be read: it is " + foreign->what, foreign->cure);
  if (!file_.looks_like_text())
    refuse_file(file_, "is not text: it holds zero bytes", "save the log as comma-separated text (UTF-8)");
}

void LogTable::problem(const std::string& place, const std::string& finding) {
  constexpr std::size_t enough = 12;
  if (++problem_count_ <= enough) problems_.push_back(place + ": " + finding);
}

void LogTable::fail_if_any() const {
  if (problem_count_ == 0) return;
  if (problem_count_ == 1) refuse_file(file_, problems_.front());
  std::string finding = "has " + std::to_string(problem_count_) + " problems";
  for (const std::string& text : problems_) finding += "\n  " + text;
  if (problem_count_ > problems_.size())
    finding += "\n  and " + std::to_string(problem_count_ - problems_.size()) + " more";
  refuse_file(file_, finding);
}

std::string LogTable::here(std::size_t column) const {
  const LogColumn* known = columns_[column].known;
  return here() + ", column " + std::to_string(column + 1) + " (" +
         (known != nullptr ? std::string(known->name) : "?") + ")";
}

std::optional<std::size_t> LogTable::find(int meaning) const {
  const std::size_t number = column_of_[static_cast<std::size_t>(meaning)];
  return number == 0 ? std::nullopt : std::optional<std::size_t>(number - 1);
}

void LogTable::read_titles() {
  std::string_view line;
  do {
    if (!lines_.next(line))
      refuse_file(file_, "holds no line of column titles",
                  "begin with one such as \"time [s], pressure [MPa], rotation [deg], dwell [min]\"");
    if (lower_case(trimmed(line)).starts_with("sep=")) line = {};  // a note of spreadsheets to themselves
  } while (is_comment(line));
  line = without_comment(line);
  const auto holds = [line](char mark) { return find_unquoted(line, mark) != std::string_view::npos; };
  separator_ = holds(';') ? Separator::semicolon : holds('\t') ? Separator::tab : Separator::comma;
  std::vector<LogCell> cells, below;
  split(line, separator_, cells);
  std::string_view next;
  for (LineReader ahead = lines_; ahead.next(next);)
    if (!is_comment(next)) {
      split(without_comment(next), separator_, below);
      break;
    }
  refuse_other_forms(line);
  for (const LogCell& cell : cells) {
    columns_.push_back({});
    read_title(cell.text, below);
  }
  while (!columns_.empty() && columns_.back().title.empty()) columns_.pop_back();
  if (is_row_of_numbers(line))
    refuse_file(file_, "begins with numbers, in " + here() + ", and names no columns",
                "begin with a line such as \"time [s], pressure [MPa], rotation [deg], dwell [min]\"");
}

// Titles parted by blanks, and words above the titles.
void LogTable::refuse_other_forms(std::string_view line) const {
  const auto count = [line](char mark) { return std::count(line.begin(), line.end(), mark); };
  if (separator_ == Separator::comma && find_unquoted(line, ',') == std::string_view::npos &&
      count('[') + count('(') > 1)
    refuse_file(file_, "parts its columns by blanks, in " + here(),
                "part them by commas, semicolons or tabs");
  const auto known_names = [this](std::string_view titles) {
    const auto has = [&](char mark) { return find_unquoted(titles, mark) != std::string_view::npos; };
    std::vector<LogCell> cells;
    split(titles, has(';') ? Separator::semicolon : has('\t') ? Separator::tab : Separator::comma, cells);
    std::size_t names = 0;
    for (const LogCell& cell : cells)
      names +=
          std::any_of(known_.begin(), known_.end(),
                      [name = lower_case(name_in(cell.text))](const LogColumn& c) { return c.name == name; })
              ? 1
              : 0;
    return names;
  };
  if (known_names(line) > 0 || is_row_of_numbers(line)) return;
  constexpr std::size_t nearby = 100;
  std::string_view next;
  for (LineReader ahead = lines_; ahead.next(next) && ahead.number() < lines_.number() + nearby;)
    if (!is_comment(next) && known_names(without_comment(next)) > 0)
      refuse_file(file_,
                  "begins with words, in " + here() + "; the titles of its columns stand in line " +
                      std::to_string(ahead.number()),
                  "put # before the lines above the titles, or delete them");
}

std::string LogTable::lack_of_unit(const LogColumn& column, const std::vector<LogCell>& below) const {
  const std::string cell = columns_.size() <= below.size() ? below[columns_.size() - 1].text : "";
  const std::string write = "write \"" + std::string(column.example) + "\"";
  if (column.dimension == dimension::time && is_time_stamp(cell))
    return "holds dates or times of day, such as " + shown(cell) + ", which are not read; " + write +
           " and seconds from the start";
  if (column.dimension == dimension::time && is_day_of_a_spreadsheet(read_cell(cell, separator_)))
    return "has no unit, and " + shown(cell) + " looks like a day of a spreadsheet; " + write +
           " and seconds from the start, a day being 86400";
  if (const std::optional<Quantity> unit = unit_in_cell(cell); unit && unit->dimension == column.dimension)
    return "has no unit; units stand in the line below, " + shown(cell) + ": write them into the titles, \"" +
           std::string(column.name) + " [" + bare_unit(cell) + "]\", and delete that line";
  return "has no unit; " + write;
}

void LogTable::read_title(const std::string& title, const std::vector<LogCell>& below) {
  Column& column = columns_.back();
  column.title = title;
  const std::size_t open = title.find_first_of("[(");
  const std::string name = lower_case(name_in(title));
  const auto found =
      std::find_if(known_.begin(), known_.end(), [&](const LogColumn& c) { return c.name == name; });
  if (found == known_.end()) return;
  const std::size_t number = columns_.size();
  const std::string place = here() + ", column " + std::to_string(number) + " (" + name + ")";
  if (std::size_t& seat = column_of_[static_cast<std::size_t>(found->meaning)]; seat == 0)
    seat = number;
  else
    return problem(place, "means the same as column " + std::to_string(seat) +
                              "; leave one of them out, or begin its title with \"result \"");
  column.known = &*found;
  if (found->dimension == dimension::number) return;
  if (open != std::string::npos) {
    const std::size_t close = title.find_last_of("])");
    if (close != std::string::npos && close > open)
      column.unit = readable_unit(trimmed(std::string_view(title).substr(open + 1, close - open - 1)));
  }
  if (column.unit.empty()) return problem(place, lack_of_unit(*found, below));
  try {
    const Quantity unit = parse_unit(column.unit);
    column.factor = unit.value;
    if (unit.dimension != found->dimension)
      problem(place, "has the unit " + shown(column.unit) + " of " + describe(unit.dimension) + " where " +
                         describe(found->dimension) + " is wanted; write \"" + std::string(found->example) +
                         "\"");
  } catch (const Error& error) {
    problem(place, error.what());
  }
}

// The title that a column should have, which is named or spelled otherwise: "load [kN]" for "Kraft / kN".
std::optional<std::string> LogTable::meant(const Column& column) const {
  const LogTitle title = log_title(column.title);
  const auto found = std::find_if(known_.begin(), known_.end(),
                                  [&](const LogColumn& c) { return means(title.name, c.name); });
  if (found == known_.end() || has(found->meaning)) return {};
  if (found->dimension == dimension::number) return std::string(found->name);
  const std::string written = readable_unit(title.unit);
  const std::optional<Quantity> unit = unit_in_cell(written);
  return unit && unit->dimension == found->dimension ? std::string(found->name) + " [" + written + "]"
                                                     : std::string(found->example);
}

std::string LogTable::others() const {
  std::vector<std::string> names;
  for (const LogColumn& known : known_) names.emplace_back(known.name);
  std::string others;
  for (const Column& column : columns_) {
    if (column.known != nullptr || column.title.empty()) continue;
    if (lower_case(column.title).starts_with("result ")) continue;
    const std::optional<std::string> title = meant(column);
    others += (others.empty() ? "" : ", ") + shown(column.title) +
              (title ? " (did you mean " + quoted(*title) + "?)"
                     : did_you_mean(std::string(name_in(column.title)), names));
  }
  return others;
}

bool LogTable::next_row(std::vector<LogCell>& cells) {
  for (std::string_view line; lines_.next(line);) {
    if (is_comment(line)) continue;
    // A # begins a comment unless the row is only whole with what follows it: "sample #3".
    split(without_comment(line), separator_, cells);
    if (cells.size() != columns_.size()) split(line, separator_, cells);
    if (is_blank(cells)) continue;
    while (cells.size() > columns_.size() && cells.back().text.empty()) cells.pop_back();
    if (cells.size() == columns_.size()) return true;
    const bool words = cells.size() == 1 && number(cells[0]).kind == CellKind::unreadable;
    problem(here(), "there " +
                        std::string(cells.size() == 1 ? "is 1 cell"
                                                      : "are " + std::to_string(cells.size()) + " cells") +
                        " under " + std::to_string(columns_.size()) + " columns" +
                        (words ? "; put # before a line that is no row" : ""));
  }
  return false;
}

TextCell LogTable::number(const LogCell& cell) const {
  return read_cell(trimmed(std::string_view(cell.text).substr(0, cell.text.find('#'))), separator_);
}

std::string LogTable::complaint(const LogCell& cell) const {
  const std::string text(trimmed(std::string_view(cell.text).substr(0, cell.text.find('#'))));
  std::string advice;
  if (is_time_stamp(text))
    advice = ": it is a date or a time of day; write times as seconds from the start";
  else if (separator_ == Separator::comma && text.find(',') != std::string::npos)
    advice = ": commas part the cells here; write the decimal sign as a point, or part cells by semicolons";
  else if (has_unit(text))
    advice = ": write its unit into the title of the column alone";
  return shown(text) + " is no finite number" + advice;
}

void LogTable::note_comma(std::size_t k, const LogCell& cell) {
  if (separator_ == Separator::comma) return;
  std::string_view text = trimmed(cell.text);
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return;
  const std::string_view rest = text.substr(comma + 1);
  const bool three = rest.size() == 3 && rest.find_first_not_of("0123456789") == std::string_view::npos;
  Column& column = columns_[k];
  if (!three || comma > 3 || text.starts_with('0'))
    column.decimals = true;
  else if (column.thousands.empty())
    column.thousands = shown(cell.text) + " in " + here(k);
}

std::vector<std::string> LogTable::comma_warnings() const {
  std::vector<std::string> warnings;
  for (const Column& column : columns_)
    if (!column.thousands.empty() && !column.decimals)
      warnings.push_back(file_name(file_.path()) + ": the comma of " + column.thousands +
                         " is read as a decimal sign; if it parts thousands, leave it out");
  return warnings;
}

std::optional<double> LogTable::quantity(std::size_t k, const LogCell& cell) {
  const Column& column = columns_[k];
  const std::string text(trimmed(std::string_view(cell.text).substr(0, cell.text.find('#'))));
  if (text.empty()) return {};
  const TextCell number = read_cell(text, separator_);
  if (number.kind != CellKind::number) return problem(here(k), complaint(cell)), std::nullopt;
  note_comma(k, cell);
  if (column.known->dimension == dimension::number) return number.value;
  std::string plain = text;
  if (separator_ != Separator::comma) std::replace(plain.begin(), plain.end(), ',', '.');
  if (plain.starts_with('+')) plain.erase(0, 1);
  try {
    return parse_quantity_as(plain + " " + column.unit, column.known->dimension);
  } catch (const Error& error) {
    return problem(here(k), error.what()), std::nullopt;
  }
}

}  // namespace asperity
