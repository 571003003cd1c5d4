// SPDX-License-Identifier: GPL-3.0-or-later
// Reading of press logs. Numbers are read together with the unit of their column, so that "152.78" under
// "[MPa]" is the same double as "152.78 MPa" in a script.
#include "engine/experiment/press_log.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/source_file.hpp"
#include "engine/surface/io/text_table.hpp"

namespace asperity {

namespace {

enum class Meaning { time, pressure, load, place, rotation, dwell };
struct Named {
  std::string_view name;
  Meaning meaning;
  Dimension dimension;
  std::string_view example;
};
constexpr std::array<Named, 8> known{{{"time", Meaning::time, dimension::time, "time [s]"},
                                      {"pressure", Meaning::pressure, dimension::pressure, "pressure [MPa]"},
                                      {"load", Meaning::load, dimension::force, "load [N]"},
                                      {"place", Meaning::place, dimension::number, "place"},
                                      {"seed", Meaning::place, dimension::number, "seed"},
                                      {"rotation", Meaning::rotation, dimension::angle, "rotation [deg]"},
                                      {"turn", Meaning::rotation, dimension::angle, "turn [deg]"},
                                      {"dwell", Meaning::dwell, dimension::time, "dwell [min]"}}};
constexpr std::size_t meanings = 6;
constexpr std::size_t at(Meaning meaning) { return static_cast<std::size_t>(meaning); }

struct Column {
  const Named* named = nullptr;  // null: left out
  std::string title, unit;
};

struct LogCell {
  std::string text;
  bool quoted = false;
};

char mark_of(Separator separator) {
  return separator == Separator::semicolon ? ';' : separator == Separator::tab ? '\t' : ',';
}

// Cells with their quotes taken off; a doubled quote inside stands for one.
std::vector<LogCell> split(std::string_view line, Separator separator) {
  std::vector<LogCell> cells(1);
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
  return cells;
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

class LogReader {
 public:
  LogReader(const SourceFile& file, Monitor& monitor) : file_(file), monitor_(monitor), lines_(file_.text()) {
    if (!file_.looks_like_text())
      refuse_file(file_, "is not text: it holds zero bytes", "save the log as comma-separated text (UTF-8)");
    log_name_ = std::filesystem::path(file.path()).filename().string();
  }

  Protocol read() {
    read_header();
    Task task(monitor_, "reading", static_cast<std::int64_t>(file_.bytes().size()));
    std::size_t before = 0;
    for (std::string_view line; lines_.next(line);) {
      task.advance(static_cast<std::int64_t>(lines_.position() - before));
      before = lines_.position();
      if (!is_comment(line)) read_row(line);
    }
    fail_if_any();
    if (events_.empty()) refuse_file(file_, "names columns but holds no row", "a row is an event");
    warn_if_sampled();
    return Protocol(std::move(events_));
  }

 private:
  static bool is_comment(std::string_view line) {
    line = trimmed(line);
    return line.empty() || line.front() == '#';
  }

  bool has(Meaning meaning) const { return column_of_[at(meaning)] > 0; }

  void problem(const std::string& place, const std::string& finding) {
    constexpr std::size_t enough = 12;
    if (++problem_count_ <= enough) problems_.push_back(place + ": " + finding);
  }
  void fail_if_any() const {
    if (problem_count_ == 0) return;
    if (problem_count_ == 1) refuse_file(file_, problems_.front());
    std::string finding = "has " + std::to_string(problem_count_) + " problems";
    for (const std::string& text : problems_) finding += "\n  " + text;
    if (problem_count_ > problems_.size())
      finding += "\n  and " + std::to_string(problem_count_ - problems_.size()) + " more";
    refuse_file(file_, finding);
  }

  std::string here() const { return "line " + std::to_string(lines_.number()); }
  std::string here(std::size_t column) const {
    return here() + ", column " + std::to_string(column + 1) + " (" +
           (columns_[column].named != nullptr ? std::string(columns_[column].named->name) : "?") + ")";
  }

  // --- the line of titles

  void read_header() {
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
    for (const LogCell& cell : split(line, separator_)) {
      columns_.push_back({});
      read_title(cell.text);
    }
    while (!columns_.empty() && columns_.back().title.empty()) columns_.pop_back();
    if (is_row_of_numbers(line))
      refuse_file(file_, "begins with numbers, in " + here() + ", and names no columns",
                  "begin with a line such as \"time [s], pressure [MPa], rotation [deg], dwell [min]\"");
    check_columns();
    fail_if_any();
  }

  void read_title(const std::string& title) {
    Column& column = columns_.back();
    column.title = title;
    const std::size_t open = title.find_first_of("[(");
    const std::string name = lower_case(trimmed(std::string_view(title).substr(0, open)));
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Named& n) { return n.name == name; });
    if (found == known.end()) return;
    const std::size_t number = columns_.size();
    const std::string place = here() + ", column " + std::to_string(number) + " (" + name + ")";
    if (std::size_t& seat = column_of_[at(found->meaning)]; seat == 0)
      seat = number;
    else
      return problem(place, "means the same as column " + std::to_string(seat) + "; leave one of them out");
    column.named = &*found;
    if (found->dimension == dimension::number) return;
    if (open != std::string::npos) {
      const std::size_t close = title.find_last_of("])");
      if (close != std::string::npos && close > open)
        column.unit = readable_unit(trimmed(std::string_view(title).substr(open + 1, close - open - 1)));
    }
    if (column.unit.empty())
      return problem(place, "has no unit; write \"" + std::string(found->example) + "\"");
    try {
      const Quantity unit = parse_unit(column.unit);
      if (unit.dimension != found->dimension)
        problem(place, "has the unit " + shown(column.unit) + " of " + describe(unit.dimension) + " where " +
                           describe(found->dimension) + " is wanted; write \"" + std::string(found->example) +
                           "\"");
    } catch (const Error& error) {
      problem(place, error.what());
    }
  }

  void check_columns() {
    std::vector<std::string> names;
    for (const Named& n : known) names.emplace_back(n.name);
    std::string others;
    for (const Column& column : columns_) {
      if (column.named != nullptr || column.title.empty()) continue;
      const std::string name(trimmed(column.title.substr(0, column.title.find_first_of("[("))));
      others += (others.empty() ? "" : ", ") + shown(column.title) + did_you_mean(name, names);
    }
    if (has(Meaning::pressure) && has(Meaning::load))
      problem(here(), "both `pressure` and `load` are given; leave one of them out, or name it otherwise");
    else if (!has(Meaning::pressure) && !has(Meaning::load))
      problem(here(), "no column `pressure` or `load`" +
                          (others.empty() ? std::string() : " among others: " + others) +
                          "; write \"pressure [MPa]\" or \"load [N]\"");
    else if (!others.empty() && problem_count_ == 0)
      monitor_.warn(file_name(file_.path()) + " has columns of which a protocol makes nothing: " + others);
  }

  // --- rows

  void read_row(std::string_view line) {
    // A # begins a comment unless the row is only whole with what follows it: "sample #3".
    std::vector<LogCell> cells = split(without_comment(line), separator_);
    if (cells.size() != columns_.size()) cells = split(line, separator_);
    if (is_blank(cells)) return;
    while (cells.size() > columns_.size() && cells.back().text.empty()) cells.pop_back();
    if (cells.size() != columns_.size())
      return problem(here(),
                     "there " +
                         std::string(cells.size() == 1 ? "is 1 cell"
                                                       : "are " + std::to_string(cells.size()) + " cells") +
                         " under " + std::to_string(columns_.size()) + " columns");
    std::array<std::optional<double>, meanings> row;
    const std::size_t before = problem_count_;
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (columns_[k].named != nullptr) row[at(columns_[k].named->meaning)] = read_cell_of(k, cells[k]);
    check_time(row[at(Meaning::time)], problem_count_ == before);
    if (problem_count_ == before) add_events(row);
  }

  std::optional<double> read_cell_of(std::size_t k, const LogCell& cell) {
    const Column& column = columns_[k];
    const std::string text(trimmed(std::string_view(cell.text).substr(0, cell.text.find('#'))));
    if (text.empty()) return {};
    const Cell number = read_cell(text, separator_);
    if (number.kind != CellKind::number)
      return problem(here(k), shown(text) + " is no finite number"), std::nullopt;
    if (column.named->meaning == Meaning::place) {
      constexpr double most = 9007199254740992.0;
      if (!(number.value >= 0 && number.value <= most && number.value == std::floor(number.value)))
        return problem(here(k), shown(text) + " is no seed; give a whole number from zero up"), std::nullopt;
      return number.value;
    }
    std::string plain = text;
    if (separator_ != Separator::comma) std::replace(plain.begin(), plain.end(), ',', '.');
    if (plain.starts_with('+')) plain.erase(0, 1);
    double value = 0;
    try {
      value = parse_quantity_as(plain + " " + column.unit, column.named->dimension);
    } catch (const Error& error) {
      return problem(here(k), error.what()), std::nullopt;
    }
    const Meaning meaning = column.named->meaning;
    if (value < 0 && meaning != Meaning::time && meaning != Meaning::rotation)
      return problem(here(k), shown(text) + " is negative"), std::nullopt;
    return value;
  }

  void check_time(const std::optional<double>& time, bool row_is_good) {
    if (!has(Meaning::time)) return;
    const std::size_t column = column_of_[at(Meaning::time)] - 1;
    if (!time) {
      if (row_is_good) problem(here(column), "the time is missing");
    } else if (last_time_ && *time < *last_time_) {
      problem(here(column), "the time " + format_short(*time) +
                                " s runs backwards: " + format_short(*last_time_) + " s stands before it");
    } else {
      last_time_ = time;
    }
  }

  void add(Protocol::Step step, const std::optional<double>& time) {
    events_.push_back({std::move(step), time, log_name_ + " " + here()});
  }

  void add_events(const std::array<std::optional<double>, meanings>& row) {
    const auto time = row[at(Meaning::time)], place = row[at(Meaning::place)],
               dwell = row[at(Meaning::dwell)];
    const double angle = row[at(Meaning::rotation)].value_or(0);
    const bool by_load = has(Meaning::load);
    const double value = row[at(by_load ? Meaning::load : Meaning::pressure)].value_or(0);
    const std::size_t before = events_.size();
    if (under_load_ && (place || angle != 0)) {
      add(Protocol::Release{}, time);
      under_load_ = false;
    }
    if (place) add(Protocol::Place{static_cast<std::uint64_t>(*place)}, time);
    if (angle != 0) add(Protocol::Rotate{angle}, time);
    ++rows_;
    if (dwell || angle != 0 || place) ++rows_with_more_;
    if (value > 0) {
      add(PressRequest{by_load ? PressBy::load : PressBy::pressure, value, dwell}, time);
      under_load_ = true;
      return;
    }
    if (events_.size() == before) {
      add(Protocol::Release{}, time);
      under_load_ = false;
    }
    if (dwell.value_or(0) > 0)
      monitor_.warn(file_name(file_.path()) + ": a dwell without load changes nothing, as in " + here());
  }

  void warn_if_sampled() const {
    constexpr std::size_t many = 100;
    if (rows_ >= many && rows_with_more_ == 0)
      monitor_.warn(file_name(file_.path()) + " has " + std::to_string(rows_) +
                    " rows and neither dwell nor turn: each is taken for an event, so a recording sampled "
                    "all the time becomes as many presses");
  }

  const SourceFile& file_;
  Monitor& monitor_;
  LineReader lines_;
  std::string log_name_;
  Separator separator_ = Separator::comma;
  std::vector<Column> columns_;
  std::array<std::size_t, meanings> column_of_{};  // number from 1; 0: none
  std::vector<Protocol::Event> events_;
  std::optional<double> last_time_;
  bool under_load_ = false;
  std::size_t rows_ = 0, rows_with_more_ = 0;
  std::vector<std::string> problems_;
  std::size_t problem_count_ = 0;
};

}  // namespace

Protocol read_press_log(const std::string& path, Monitor& monitor) {
  return read_press_log(SourceFile(path, monitor), monitor);
}

Protocol read_press_log(const SourceFile& file, Monitor& monitor) { return LogReader(file, monitor).read(); }

}  // namespace asperity
