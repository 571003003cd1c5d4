// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/log_table.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/error.hpp"
#include "engine/core/files/text_encoding.hpp"
#include "engine/core/text.hpp"
#include "engine/statistics/number_form.hpp"
#include "engine/statistics/table_head.hpp"
#include "engine/surface/io/foreign_format.hpp"

namespace asperity {

namespace {

// UTF-16 is text.
const SourceFile& checked_text(const SourceFile& file) {
  if (utf8_of_utf16(file.bytes().substr(0, 64))) return file;
  if (const std::optional<ForeignFormat> foreign = foreign_format(file))
    refuse_file(file, "is not text that can be read: it is " + foreign->what, foreign->cure);
  return file;
}

// A title such as "[hh:mm:ss]".
bool is_clock_pattern(std::string_view unit) {
  return unit.find(':') != std::string_view::npos &&
         unit.find_first_not_of("hHmMsSfFnidDyYaAJjTt:.,/- ") == std::string_view::npos;
}

bool is_exact_time(const LogColumn& column) { return column.dimension == dimension::time; }

}  // namespace

LogTable::LogTable(const SourceFile& file, std::span<const LogColumn> known, const TableForm& form)
    : file_(checked_text(file)), known_(known), form_(form), lines_(file, form), problems_(file) {}

std::string LogTable::place_of(std::size_t k) const {
  const LogColumn* known = columns_[k].known;
  return here() + ", column " + std::to_string(k + 1) + " (" +
         (known != nullptr ? std::string(known->name) : "?") + ")";
}

std::string LogTable::here(std::size_t column) const { return place_of(column); }

std::optional<std::size_t> LogTable::find(int meaning) const {
  const std::size_t number = column_of_[static_cast<std::size_t>(meaning)];
  return number == 0 ? std::nullopt : std::optional<std::size_t>(number - 1);
}

void LogTable::read_titles() {
  refuse_unknown_names();
  skip_preamble();
  if (!lines_.read_heads())
    refuse_file(file_, "holds no line of column titles",
                "begin with one such as \"time [s], pressure [MPa], rotation [deg], dwell [min]\"");
  for (const LogCell& cell : lines_.heads()) {
    columns_.emplace_back();
    columns_.back().title = cell.text;
    split_unit(columns_.back());
  }
  choose_columns();
  match_titles();
  if (!lines_.heads_are_given()) refuse_other_forms();
  const bool below_are_units = units_stand_below();
  for (std::size_t k = 0; k < columns_.size(); ++k)
    if (columns_[k].known != nullptr && columns_[k].known->dimension != dimension::number)
      read_unit(k, below_are_units);
  if (below_are_units) lines_.skip_below();
}

// Skips the lines of loggers above the heads.
void LogTable::skip_preamble() {
  if (form_.skip > 0 || !form_.heads.empty()) return;
  TableLines ahead = lines_;
  std::string_view first;
  while (ahead.next_line(first) &&
         (TableLines::is_comment(first) || lower_case(trimmed(first)).starts_with("sep="))) {
  }
  const std::optional<FoundHeads> heads = find_heads(lines_);
  if (!heads || heads->line <= ahead.line()) return;
  if (const std::size_t known = known_names(TableLines::without_comment(first));
      known > 0 && known >= known_names(heads->text))
    return;
  for (std::string_view line; lines_.line() + 1 < heads->line && lines_.next_line(line);) {
  }
  warnings_.push_back(file_name(file_.path()) + ": the titles of its columns were found in line " +
                      std::to_string(heads->line) + "; the lines above are left out");
}

void LogTable::refuse_unknown_names() const {
  std::vector<std::string> names;
  for (const LogColumn& column : known_) names.emplace_back(column.name);
  for (const auto* given : {&form_.names, &form_.units})
    for (const auto& [name, title] : *given)
      if (given == &form_.names && std::ranges::find(names, name) == names.end())
        throw Error(ErrorCode::unknown_name,
                    "`columns` names " + quoted(name) + ", which is no column of a protocol" +
                        did_you_mean(name, names),
                    "its columns are " + joined(names, " and "));
}

void LogTable::split_unit(Column& column) const {
  const TableHead head = table_head(column.title);
  column.name = lower_case(head.name);
  column.unit = head.unit;
  if (!column.unit.empty() || column.name.find_first_of("[(") != std::string::npos) {
    // "load (kNewton)": brackets hold a unit, even an unknown one.
    if (const std::size_t open = column.title.find_first_of("[("); column.unit.empty() && open > 0) {
      const std::size_t close = column.title.find_last_of("])");
      column.name = lower_case(trimmed(std::string_view(column.title).substr(0, open)));
      if (close != std::string::npos && close > open)
        column.unit = std::string(trimmed(std::string_view(column.title).substr(open + 1, close - open - 1)));
    }
    return;
  }
  // Split only if the front names a column: "time_s", "load/kN", "time min".
  for (const char mark : {'_', '/', ' ', ':'}) {
    const std::size_t at = column.name.rfind(mark);
    if (at == std::string::npos || at == 0) continue;
    const std::string front(trimmed(std::string_view(column.name).substr(0, at)));
    const std::optional<Quantity> unit = unit_in_cell(std::string_view(column.title).substr(at + 1));
    const bool known = unit && std::ranges::any_of(known_, [&](const LogColumn& c) {
                         return surely_means(front, c.name) && c.dimension == unit->dimension;
                       });
    if (!known) continue;
    column.unit = bare_unit(std::string_view(column.title).substr(at + 1));
    column.name = front;
    return;
  }
}

// columns={ load="Wert" } overrides all other names.
void LogTable::choose_columns() {
  for (const auto& [name, title] : form_.names) {
    const LogColumn& known = *std::ranges::find(known_, std::string_view(name), &LogColumn::name);
    const auto is_it = [&, title = std::string_view(title)](const Column& column, bool whole) {
      return lower_case(column.title) == lower_case(trimmed(title)) ||
             (!whole && column.name == lower_case(trimmed(title)));
    };
    std::size_t found = columns_.size(), count = 0;
    for (const bool whole : {true, false})
      if (count == 0)
        for (std::size_t k = 0; k < columns_.size(); ++k)
          if (is_it(columns_[k], whole) && count++ == 0) found = k;
    if (count != 1) {
      std::vector<std::string> titles;
      for (const Column& column : columns_) titles.push_back(asperity::plain_text(column.title));
      problem(here(), std::to_string(count) + " columns are titled " + shown(title) +
                          ", which `columns` calls " + quoted(name) +
                          (count == 0 ? did_you_mean(title, titles) : "; give the title with its unit"));
      continue;
    }
    columns_[found].known = &known;
    column_of_[static_cast<std::size_t>(known.meaning)] = found + 1;
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

// Own names before foreign names.
void LogTable::match_titles() {
  const auto chosen = column_of_;
  for (const bool by_other_names : {false, true}) {
    const auto before = column_of_;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      Column& column = columns_[k];
      if (column.known != nullptr) continue;
      const LogColumn* known = known_as(column, by_other_names, below(k));
      if (known == nullptr) continue;
      const auto meaning = static_cast<std::size_t>(known->meaning);
      if (chosen[meaning] != 0 || (by_other_names && before[meaning] != 0)) continue;  // ignored
      std::size_t& seat = column_of_[meaning];
      if (seat != 0) {
        problem(here() + ", column " + std::to_string(k + 1) + " (" + std::string(known->name) + ")",
                "means the same as column " + std::to_string(seat) +
                    "; leave one of them out, or begin its title with \"result \"");
        continue;
      }
      seat = k + 1;
      column.known = known;
    }
  }
}

std::size_t LogTable::known_names(std::string_view titles) const {
  std::size_t names = 0;
  for (const std::string& cell : log_cells(titles)) {
    Column column;
    column.title = cell;
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
  if (const auto heads = find_heads(TableLines(file_, whole)); heads && heads->line != line())
    refuse_file(file_,
                std::string("is read from ") + (numbers ? "numbers" : "words") + " in " + here() +
                    " on, and the titles of its columns stand in line " + std::to_string(heads->line),
                "give skip=" + std::to_string(heads->line - 1));
  if (numbers)
    refuse_file(file_, "begins with numbers, in " + here() + ", and names no columns",
                "begin with a line such as \"time [s], pressure [MPa], rotation [deg], dwell [min]\", or "
                "give the titles, as in columns={ \"time [s]\", \"load [kN]\" }");
  constexpr std::size_t nearby = 100;
  TableLines ahead = lines_;
  std::string_view next;
  for (std::size_t lines = 0; lines < nearby && ahead.next_line(next); ++lines)
    if (!TableLines::is_comment(next) && known_names(TableLines::without_comment(next)) > 0)
      refuse_file(file_,
                  "begins with words, in " + here() + "; the titles of its columns stand in line " +
                      std::to_string(ahead.line()),
                  "put # before the lines above the titles, delete them, or skip them with skip=" +
                      std::to_string(ahead.line() - 1));
}

// Units below the titles, at least one missing in its title.
bool LogTable::units_stand_below() const {
  bool needed = false;
  for (std::size_t k = 0; k < lines_.below().size(); ++k) {
    const std::string cell = below(k);
    if (cell.empty() || bare_unit(cell).empty() || cell == "-") continue;
    if (!unit_in_cell(utf8_or_cp1252(cell))) {
      if (k < columns_.size() && columns_[k].known == nullptr &&
          plain_cell(lines_.below()[k]).kind != CellKind::number)
        continue;
      return false;
    }
    needed = needed || (k < columns_.size() && columns_[k].known != nullptr && columns_[k].unit.empty());
  }
  return needed;
}

void LogTable::read_unit(std::size_t k, bool below_are_units) {
  Column& column = columns_[k];
  const LogColumn& known = *column.known;
  const std::string place = place_of(k);
  for (const auto& [name, unit] : form_.units)
    if (name == known.name || lower_case(name) == lower_case(column.title)) column.unit = unit;
  if (is_exact_time(known) && is_clock_pattern(column.unit)) column.unit.clear();
  if (column.unit.empty() && below_are_units) column.unit = bare_unit(below(k));
  column.unit = utf8_or_cp1252(column.unit);
  if (column.unit.empty()) return read_without_unit(k, place);
  try {
    const Quantity unit = parse_unit(column.unit);
    column.factor = unit.value;
    if (unit.dimension != known.dimension)
      problem(place, "has the unit " + shown(column.unit) + " of " + describe(unit.dimension) + " where " +
                         describe(known.dimension) + " is wanted; write \"" + std::string(known.example) +
                         "\"");
  } catch (const Error& error) {
    problem(place, error.what());
  }
}

void LogTable::read_without_unit(std::size_t k, const std::string& place) {
  Column& column = columns_[k];
  const LogColumn& known = *column.known;
  const std::string cell = below(k), write = "write \"" + std::string(known.example) + "\"";
  if (is_exact_time(known) && is_time_stamp(cell)) {
    column.kind = Column::Kind::stamps;
    return learn_stamps(k);
  }
  if (is_exact_time(known) && !cell.empty() && is_day_of_a_spreadsheet(plain_cell(lines_.below()[k]))) {
    column.kind = Column::Kind::days;
    warnings_.push_back(file_name(file_.path()) + ": the column " + quoted(std::string(known.name)) +
                        " has no unit, and its numbers, such as " + shown(cell) +
                        ", are taken for days of a spreadsheet; unit={ " + std::string(known.name) +
                        "=\"s\" } says otherwise");
    return;
  }
  if (const std::optional<Quantity> quantity = quantity_in_cell(cell);
      quantity && quantity->dimension == known.dimension) {
    column.kind = Column::Kind::quantities;
    return;
  }
  problem(place, "has no unit; " + write);
}

void LogTable::learn_stamps(std::size_t k) {
  StampColumn stamps(form_);
  TableLines ahead = lines_;
  for (std::vector<LogCell> cells; ahead.next_row(cells);)
    if (k < cells.size() && stamps.learn(cells[k].text)) break;
  if (const std::optional<std::string> doubt = stamps.doubt()) problem(place_of(k), *doubt);
  columns_[k].stamps = std::move(stamps);
}

// "load [kN]" for "Kraft / kN".
std::optional<std::string> LogTable::meant(const Column& column) const {
  const LogTitle title = log_title(column.title);
  const auto found = std::find_if(known_.begin(), known_.end(),
                                  [&](const LogColumn& c) { return means(title.name, c.name); });
  if (found == known_.end() || has(found->meaning)) return {};
  if (found->dimension == dimension::number) return std::string(found->name);
  const std::string written = utf8_or_cp1252(title.unit);
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

void LogTable::read_rows(Monitor& monitor, const std::function<void(const std::vector<LogCell>&)>& read) {
  Task task(monitor, "reading", static_cast<std::int64_t>(file_.bytes().size()));
  std::size_t before = 0;
  for (std::vector<LogCell> cells; next_row(cells);) {
    task.advance(static_cast<std::int64_t>(position() - before));
    before = position();
    read(cells);
  }
  fail_if_any();
}

bool LogTable::next_row(std::vector<LogCell>& cells) {
  while (lines_.next_row(cells)) {
    if (cells.size() == columns_.size()) return true;
    const bool words = std::ranges::none_of(
        cells, [this](const LogCell& cell) { return plain_cell(cell).kind == CellKind::number; });
    if (words && lines_.at_end_of_table()) {
      warnings_.push_back(file_name(file_.path()) + ": what stands below the table, from " + here() +
                          " on, is left out");
      return false;
    }
    problem(here(), "there " +
                        std::string(cells.size() == 1 ? "is 1 cell"
                                                      : "are " + std::to_string(cells.size()) + " cells") +
                        " under " + std::to_string(columns_.size()) + " columns" +
                        (words && cells.size() == 1 ? "; put # before a line that is no row" : ""));
  }
  return false;
}

std::string LogTable::text_of(const LogCell& cell) const {
  return std::string(trimmed(std::string_view(cell.text).substr(0, cell.text.find('#'))));
}

// With a decimal point, without thousands separators; unchanged if unclear.
std::string LogTable::plain_text(const LogCell& cell) const {
  const std::string text = text_of(cell);
  if (form_.decimal != '\0' || form_.thousands != '\0') {
    const NumberForm said{form_.decimal != '\0'    ? form_.decimal
                          : form_.thousands == '.' ? ','
                                                   : '.',
                          form_.thousands};
    return plain_number(text, said).value_or(text);
  }
  if (lines_.separator() == Separator::comma && text.find(',') == std::string::npos) return text;
  if (lines_.separator() == Separator::comma) {
    // Quoted: "0,5" is decimal, "1,500" may be a thousand.
    NumberEvidence evidence('\0', '\0');
    evidence.add(text, "");
    return evidence.doubt() ? text : plain_number(text, evidence.form()).value_or(text);
  }
  std::string plain = text;
  std::replace(plain.begin(), plain.end(), ',', '.');
  return plain;
}

TextCell LogTable::plain_cell(const LogCell& cell) const {
  const bool said = form_.decimal != '\0' || form_.thousands != '\0';
  const bool quoted_comma =
      lines_.separator() == Separator::comma && cell.text.find(',') != std::string::npos;
  if (said || quoted_comma) return read_cell(plain_text(cell), Separator::comma);
  return read_cell(trimmed(std::string_view(cell.text).substr(0, cell.text.find('#'))), lines_.separator());
}

TextCell LogTable::number(std::size_t k, const LogCell& cell) {
  const Column& column = columns_[k];
  if (column.kind == Column::Kind::stamps && !text_of(cell).empty()) {
    const std::optional<double> seconds = columns_[k].stamps->read(text_of(cell)).seconds;
    return seconds ? TextCell{CellKind::number, *seconds} : TextCell{};
  }
  TextCell number = plain_cell(cell);
  if (number.kind == CellKind::unreadable)
    if (const std::optional<Quantity> quantity = quantity_in_cell(text_of(cell)))
      return quantity->dimension == column.known->dimension ? TextCell{CellKind::number, quantity->value}
                                                            : TextCell{};
  if (number.kind != CellKind::number) return number;
  if (column.kind == Column::Kind::quantities) return {};
  constexpr double day = 86400;
  if (column.kind == Column::Kind::days) {
    double& first = columns_[k].first_day.emplace(columns_[k].first_day.value_or(number.value));
    number.value = (number.value - first) * day;
  } else {
    number.value *= column.factor;
  }
  if (!std::isfinite(number.value)) return {};
  note_comma(k, cell);
  return number;
}

std::string LogTable::complaint(std::size_t k, const LogCell& cell) const {
  const Column& column = columns_[k];
  const std::string text = text_of(cell);
  if (column.kind == Column::Kind::stamps) return StampColumn(*column.stamps).read(text).complaint;
  if (column.kind == Column::Kind::quantities && plain_cell(cell).kind == CellKind::number)
    return shown(text) + " has no unit, as the cells above it have";
  std::string advice;
  if (const std::optional<Quantity> quantity = quantity_in_cell(text))
    advice = ": it is " + describe(quantity->dimension) + " where " + describe(column.known->dimension) +
             " is wanted";
  else if (is_time_stamp(text))
    advice = ": it is a date or a time of day; write times as seconds from the start";
  else if (lines_.separator() == Separator::comma && text.find(',') != std::string::npos)
    advice = ": commas part the cells here; write the decimal sign as a point, or part cells by semicolons";
  else if (const std::string_view sign = thousands_in(text); !sign.empty())
    advice = ": if " +
             std::string(sign == " "   ? "a blank"
                         : sign == "'" ? "an apostrophe"
                         : sign == "," ? "a comma"
                                       : "a point") +
             " parts thousands, say thousands=\"" + std::string(sign) + "\"";
  return shown(text) + " is no finite number" + advice;
}

void LogTable::note_comma(std::size_t k, const LogCell& cell) {
  if (lines_.separator() == Separator::comma || form_.decimal != '\0' || form_.thousands != '\0') return;
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

std::vector<std::string> LogTable::warnings() const {
  std::vector<std::string> warnings = warnings_;
  for (const Column& column : columns_)
    if (!column.thousands.empty() && !column.decimals)
      warnings.push_back(file_name(file_.path()) + ": the comma of " + column.thousands +
                         " is read as a decimal sign; if it parts thousands, leave it out");
  return warnings;
}

std::optional<double> LogTable::quantity(std::size_t k, const LogCell& cell) {
  const Column& column = columns_[k];
  if (text_of(cell).empty()) return {};
  const TextCell found = number(k, cell);
  const bool of_plain_text = plain_cell(cell).kind == CellKind::number;
  if (found.kind != CellKind::number && !(of_plain_text && column.kind == Column::Kind::plain))
    return problem(here(k), complaint(k, cell)), std::nullopt;
  if (column.kind != Column::Kind::plain || !of_plain_text || column.known->dimension == dimension::number)
    return found.value;
  // Same bits as in a script.
  std::string plain = plain_text(cell);
  if (plain.starts_with('+')) plain.erase(0, 1);
  try {
    return parse_quantity_as(plain + " " + column.unit, column.known->dimension);
  } catch (const Error& error) {
    return problem(here(k), error.what()), std::nullopt;
  }
}

}  // namespace asperity
