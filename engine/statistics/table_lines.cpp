// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/table_lines.hpp"

#include <algorithm>
#include <array>

#include "engine/core/files/text_encoding.hpp"
#include "engine/statistics/number_form.hpp"
#include "engine/statistics/table_head.hpp"

namespace asperity {

namespace {

std::string marks_of(Separator separator) {
  return separator == Separator::blank ? " \t" : std::string(1, static_cast<char>(separator));
}

std::size_t find_unquoted(std::string_view line, char wanted) {
  bool inside = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"') inside = !inside;
    if (line[k] == wanted && !inside) return k;
  }
  return std::string_view::npos;
}

// Failed spreadsheet cells are no comments.
bool is_failed_cell(std::string_view text) {
  constexpr std::array<std::string_view, 7> failed{"#DIV/0!", "#N/A",  "#NAME?", "#NULL!",
                                                   "#NUM!",   "#REF!", "#VALUE!"};
  return std::ranges::any_of(failed, [text](std::string_view word) { return text.starts_with(word); });
}

// Splits text at marks outside quotes; a quoted cell may contain marks and line ends.
class Splitter {
 public:
  explicit Splitter(std::string marks) : marks_(std::move(marks)) {}
  bool open = false;         // last quote
  bool words_after = false;  // behind a closed quote

  Splitter& take(std::string_view text) {
    for (std::size_t k = 0; k < text.size(); ++k) {
      TableCell& cell = cells_.back();
      if (open && text[k] == '\r') {
        // CRLF and CR CRLF are one line end, as is each single CR.
        const std::size_t end = std::min(text.find_first_not_of('\r', k), text.size());
        if (end == text.size() || text[end] != '\n') cell.text.append(end - k, '\n');
        k = end - 1;
      } else if (open && text[k] == '"') {
        open = k + 1 < text.size() && text[k + 1] == '"';
        if (open) cell.text += text[++k];
      } else if (open) {
        cell.text += text[k];
      } else if (text[k] == '"' && trimmed(plain_).empty() && !cell.quoted) {
        open = cell.quoted = true;
      } else if (marks_.find(text[k]) == std::string::npos) {
        plain_ += text[k];
      } else if (!at_blanks() || cell.quoted || !plain_.empty()) {
        end_cell();
        cells_.emplace_back();
      }
    }
    return *this;
  }

  std::vector<TableCell> cells() {
    end_cell();
    if (at_blanks() && cells_.size() > 1 && cells_.back().text.empty() && !cells_.back().quoted)
      cells_.pop_back();
    return std::move(cells_);
  }

 private:
  bool at_blanks() const { return marks_.front() == ' '; }
  void end_cell() {
    if (!cells_.back().quoted)
      cells_.back().text = std::string(trimmed(plain_));
    else if (!trimmed(plain_).empty())
      words_after = true;
    plain_.clear();
  }

  std::string marks_;
  std::vector<TableCell> cells_{1};
  std::string plain_;  // of the last cell, outside quotes
};

std::vector<TableCell> split_at_wide_blanks(std::string_view line) {
  std::string tabbed(line);
  for (std::size_t k = tabbed.find("  "); k != std::string::npos; k = tabbed.find("  ", k))
    tabbed.replace(k, 2, "\t");
  std::vector<TableCell> cells;
  for (const std::string_view cell : cells_of(tabbed, Separator::tab))
    if (!cell.empty()) cells.push_back({std::string(cell), false});
  return cells;
}

// Joins a unit to its name and cells within brackets: "time [s] load / kN", "Force (kN, filtered)".
std::vector<TableCell> with_brackets_joined(const std::vector<TableCell>& parts, const char* glue) {
  const bool words = glue == std::string_view(" ");
  std::vector<TableCell> cells;
  int open = 0;
  bool stroke = false;
  for (const TableCell& part : parts) {
    const bool begins = words && !part.quoted && !part.text.empty() &&
                        std::string_view("[(/").find(part.text[0]) != std::string_view::npos;
    if (!cells.empty() && (begins || stroke || open > 0))
      cells.back().text += glue + part.text;
    else
      cells.push_back(part);
    for (const char c : part.text) open += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    stroke = words && part.text.ends_with('/');
  }
  return cells;
}

std::vector<TableCell> heads_between_blanks(std::string_view line, std::string_view next) {
  std::vector<TableCell> joined = with_brackets_joined(split_cells(line, Separator::blank), " ");
  const std::size_t wanted = split_cells(next, Separator::blank).size();
  if (joined.size() == wanted) return joined;
  if (std::vector<TableCell> wide = split_at_wide_blanks(line); wide.size() == wanted) return wide;
  return joined;
}

}  // namespace

void FileProblems::add(const std::string& place, const std::string& finding) {
  constexpr std::size_t enough = 12;
  if (++count_ <= enough) sentences_.push_back(place + ": " + finding);
}

void FileProblems::fail_if_any() const {
  if (count_ == 0) return;
  if (count_ == 1) refuse_file(file_, sentences_.front());
  std::string finding = "has " + std::to_string(count_) + " problems";
  for (const std::string& text : sentences_) finding += "\n  " + text;
  if (count_ > sentences_.size())
    finding += "\n  and " + std::to_string(count_ - sentences_.size()) + " more";
  refuse_file(file_, finding);
}

std::string_view TableLines::without_comment(std::string_view line) {
  for (std::size_t from = 0;;) {
    const std::size_t at = find_unquoted(line.substr(from), '#');
    if (at == std::string_view::npos) return line;
    if (!is_failed_cell(line.substr(from + at))) return line.substr(0, from + at);
    from += at + 1;
  }
}

bool TableLines::is_comment(std::string_view line) {
  line = trimmed(line);
  return line.empty() || (line.front() == '#' && !is_failed_cell(line));
}

TableLines::TableLines(const SourceFile& file, const TableForm& form)
    : file_(file), form_(form), lines_(file.text()) {
  if (!file_.looks_like_text())
    refuse_file(file_, "is not text: it holds zero bytes", "save it as comma-separated text (UTF-8)");
  std::string_view line;
  for (std::int64_t k = 0; k < form_.skip; ++k)
    if (!lines_.next(line))
      refuse_file(file_, "has " + std::to_string(k) + " lines, and skip=" + std::to_string(form_.skip) +
                             " leaves none");
}

std::vector<TableCell> split_cells(std::string_view line, Separator separator) {
  return Splitter(marks_of(separator)).take(line).cells();
}

std::optional<Separator> marks_in(std::string_view line) {
  for (const Separator separator : {Separator::semicolon, Separator::tab, Separator::comma})
    if (find_unquoted(line, static_cast<char>(separator)) != std::string_view::npos) return separator;
  return {};
}

std::vector<TableCell> head_cells(std::string_view line) {
  if (const auto separator = marks_in(line)) return split_cells(line, *separator);
  return with_brackets_joined(split_cells(line, Separator::blank), " ");
}

bool TableLines::next_record(LineReader& lines, std::string_view& record, std::size_t& number) const {
  do {
    if (!lines.next(record)) return false;
    number = lines.number();
  } while (is_comment(record));
  if (record.find('"') == std::string_view::npos) return true;
  Splitter scan(marks_known_ ? marks_of(separator_) : ",;\t");
  scan.take(without_comment(record));
  LineReader ahead = lines;
  for (std::string_view more; scan.open && ahead.next(more);) {
    scan.take(more);
    if (scan.open) continue;
    record = {record.data(), static_cast<std::size_t>(more.data() + more.size() - record.data())};
    lines = ahead;
  }
  return true;
}

Separator TableLines::separator_by(std::string_view heads, std::string_view next,
                                   std::string_view second) const {
  const std::optional<Separator> marks = marks_in(heads);
  if (marks && *marks != Separator::comma) return *marks;
  const bool commas = marks && (!heads_are_given() || separator_of(heads) == Separator::comma);
  const bool words = trimmed(heads).find_first_of(" \t") != std::string_view::npos;
  if (commas || !words || split_cells(heads, Separator::comma).size() != 1 ||
      (!heads_are_given() && find_unquoted(next, ',') != std::string_view::npos &&
       separator_of(next) != Separator::blank))
    return Separator::comma;
  const std::vector<TableCell> below = split_cells(next, Separator::blank);
  const std::vector<TableCell> below_units = split_cells(second, Separator::blank);
  const auto has_numbers = [](const std::vector<TableCell>& cells) {
    return cells.size() > 1 && std::ranges::any_of(cells, [](const TableCell& cell) {
             return read_cell(cell.text, Separator::blank).kind == CellKind::number;
           });
  };
  // Units may precede the numbers.
  const bool units = std::ranges::all_of(below, [](const TableCell& cell) {
    return cell.text == "-" || unit_in_cell(cell.text) || bare_unit(cell.text) != cell.text;
  });
  const bool several =
      has_numbers(below) || (units && below_units.size() == below.size() && has_numbers(below_units));
  return several ? Separator::blank : Separator::comma;
}

bool TableLines::read_heads() {
  std::string_view line;
  LineReader before = lines_;
  if (form_.separator) separator_ = *form_.separator;
  marks_known_ = form_.separator.has_value();
  do {
    before = lines_;
    if (!next_record(lines_, line, line_)) return false;
  } while (lower_case(trimmed(line)).starts_with("sep="));  // spreadsheet header
  line = without_comment(line);
  std::string_view next, second;
  if (heads_are_given()) {
    next = line;
    lines_ = before;
    --line_;
  } else {
    std::size_t number = 0;
    LineReader ahead = lines_;
    for (std::string_view* below : {&next, &second}) {
      if (!next_record(ahead, *below, number)) *below = {};
      *below = without_comment(*below);
    }
  }
  if (!form_.separator) separator_ = separator_by(line, next, second);
  marks_known_ = true;
  head_line_ = line;
  if (heads_are_given()) {
    for (const std::string& head : form_.heads) heads_.push_back({head, false});
    below_ = split_cells(next, separator_);
    return true;
  }
  heads_ = separator_ == Separator::blank ? heads_between_blanks(line, next) : split_cells(line, separator_);
  for (TableCell& head : heads_) {
    head.text = utf8_or_cp1252(head.text);
    std::ranges::replace(head.text, '\n', ' ');  // a head over two lines
  }
  while (!heads_.empty() && heads_.back().text.empty()) heads_.pop_back();
  below_ = split_cells(next, separator_);
  second_ = split_cells(second, separator_);
  if (separator_ == Separator::comma && heads_.size() > below_.size())
    if (std::vector<TableCell> joined = with_brackets_joined(heads_, ", "); joined.size() == below_.size())
      heads_ = std::move(joined);
  return true;
}

bool TableLines::units_stand_below() const {
  bool known = false, unknown = false, in_brackets = true;
  for (std::size_t k = 0; k < below_.size(); ++k) {
    const std::string cell = utf8_or_cp1252(below_[k].text), unit = bare_unit(cell);
    if (unit.empty() || unit == "-") continue;
    in_brackets = in_brackets && unit != cell;
    if (unit_in_cell(unit)) {
      known = true;
    } else {
      if (looks_like_a_number(cell) || quantity_in_cell(cell) || cell == "true" || cell == "false" ||
          is_time_stamp(cell) || k >= second_.size() || !looks_like_a_number(second_[k].text))
        return false;
      unknown = true;
    }
  }
  return known || (unknown && in_brackets);
}

void TableLines::skip_below() {
  std::string_view line;
  next_record(lines_, line, line_);
}

bool TableLines::next_row(std::vector<TableCell>& cells) {
  for (std::string_view line; next_record(lines_, line, line_);) {
    // "sample #3": no comment if the row needs the rest.
    Splitter splitter(marks_of(separator_));
    cells = splitter.take(without_comment(line)).cells();
    if (cells.size() != heads_.size()) cells = (splitter = Splitter(marks_of(separator_))).take(line).cells();
    const bool empty = std::ranges::all_of(cells, [](const TableCell& cell) { return cell.text.empty(); });
    if (empty && !splitter.open) continue;
    while (cells.size() > heads_.size() && cells.back().text.empty()) cells.pop_back();
    const bool whole = cells.size() == heads_.size();
    if (splitter.open && (whole || !at_end_of_table()))
      refuse_file(file_, "has a quote in " + here() + " that is never closed",
                  "close it at the end of its cell, or remove it");
    if (lines_.number() > line_ && (whole ? splitter.words_after : !at_end_of_table()))
      refuse_file(file_,
                  "has a quote in " + here() + " that is closed in line " + std::to_string(lines_.number()) +
                      ", where " +
                      (whole ? "no cell ends"
                             : "the row has " + std::to_string(cells.size()) + " cells under " +
                                   counted(heads_.size(), "head")),
                  "close the quote at the end of its cell, or remove it");
    return true;
  }
  return false;
}

void TableLines::read_rows(Monitor& monitor, FileProblems& problems,
                           const std::function<bool(std::vector<TableCell>&)>& take) {
  Task task(monitor, "reading", static_cast<std::int64_t>(file_.bytes().size()));
  const std::size_t wanted = heads_.size();
  std::size_t before = 0, rows = 0;
  for (std::vector<TableCell> cells; next_row(cells);) {
    const std::size_t now = std::min(lines_.position(), file_.bytes().size());
    task.advance(static_cast<std::int64_t>(now - before));
    before = now;
    if (cells.size() == wanted) {
      ++rows;
      if (!take(cells)) return;
      continue;
    }
    const bool words = std::ranges::none_of(cells, [](const TableCell& cell) {
      return read_cell(cell.text, Separator::blank).kind == CellKind::number;
    });
    // The table has wider rows, or rows above further numbers.
    bool above = rows == 0 || (wanted == 1 && cells.size() > 1);
    const bool at_end = words && !above && at_end_of_table();
    above = above || (at_end && numbers_follow());
    if (at_end && !above)
      return monitor.warn(file_name(file_.path()) + ": the lines below the table, from " + here() +
                          " on, are left out");
    problems.add(
        here(),
        "there " +
            std::string(cells.size() == 1 ? "is 1 cell" : "are " + std::to_string(cells.size()) + " cells") +
            " under " + counted(wanted, "head") +
            (above ? "; give the number of lines above the heads as skip="
                   : "; put # before a line that is no row"));
    if (at_end) return;
  }
}

bool TableLines::next_line(std::string_view& line) {
  const bool there = lines_.next(line);
  line_ = lines_.number();
  return there;
}

bool TableLines::at_end_of_table() const {
  if (line() < whole_row_) return false;
  if (ended_) return true;
  LineReader ahead = lines_;
  std::size_t number = 0;
  for (std::string_view line; next_record(ahead, line, number);)
    if (split_cells(without_comment(line), separator_).size() == heads_.size()) {
      whole_row_ = number;
      return false;
    }
  ended_ = true;
  return true;
}

bool TableLines::numbers_follow() const {
  LineReader ahead = lines_;
  for (std::string_view line; ahead.next(line);)
    if (is_row_of_numbers(line) && cells_of(line, separator_of(line)).size() > 1) return true;
  return false;
}

}  // namespace asperity
