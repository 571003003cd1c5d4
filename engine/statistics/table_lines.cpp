// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/table_lines.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/files/text_encoding.hpp"
#include "engine/statistics/number_form.hpp"
#include "engine/statistics/table_head.hpp"

namespace asperity {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t'; }

char mark_of(Separator separator) {
  return separator == Separator::semicolon ? ';' : separator == Separator::tab ? '\t' : ',';
}

// Failed spreadsheet cells are no comments.
bool is_failed_cell(std::string_view text) {
  constexpr std::array<std::string_view, 7> failed{"#DIV/0!", "#N/A",  "#NAME?", "#NULL!",
                                                   "#NUM!",   "#REF!", "#VALUE!"};
  return std::ranges::any_of(failed, [text](std::string_view word) { return text.starts_with(word); });
}

// Tracks cell starts; a quote there may contain line ends.
class QuoteScan {
 public:
  explicit QuoteScan(std::string_view marks) : marks_(marks) {}
  void take(std::string_view text) {
    for (std::size_t k = 0; k < text.size(); ++k) {
      const char c = text[k];
      if (inside_) {
        if (c != '"') continue;
        if (k + 1 < text.size() && text[k + 1] == '"')
          ++k;
        else
          inside_ = false;
      } else if (marks_.find(c) != std::string_view::npos) {
        begins_ = true;
      } else if (c == '"' && begins_) {
        inside_ = true;
        begins_ = false;
      } else if (!is_space(c)) {
        begins_ = false;
      }
    }
  }
  bool is_inside() const { return inside_; }

 private:
  std::string_view marks_;
  bool inside_ = false, begins_ = true;
};

// `open`: the last quote is not closed; `words_after`: text after a closed quote.
struct Quotes {
  bool open = false, words_after = false;
};
std::vector<TableCell> split_at(std::string_view line, Separator separator, Quotes* quotes = nullptr) {
  const bool blanks = separator == Separator::blank;
  const auto parts = [&](char c) { return blanks ? is_space(c) : c == mark_of(separator); };
  std::vector<TableCell> cells(1);
  std::string plain;
  bool inside = false, words_after = false;
  const auto finish = [&] {
    if (!cells.back().quoted)
      cells.back().text = std::string(trimmed(plain));
    else if (!trimmed(plain).empty())
      words_after = true;
    plain.clear();
  };
  for (std::size_t k = 0; k < line.size(); ++k) {
    TableCell& cell = cells.back();
    if (inside) {
      if (line[k] == '\r') {
        // CRLF and CR CRLF are one line end, each single CR is one.
        const std::size_t end = std::min(line.find_first_not_of('\r', k), line.size());
        if (end == line.size() || line[end] != '\n') cell.text.append(end - k, '\n');
        k = end - 1;
      } else if (line[k] != '"') {
        cell.text += line[k];
      } else if (k + 1 < line.size() && line[k + 1] == '"') {
        cell.text += line[++k];
      } else {
        inside = false;
      }
    } else if (line[k] == '"' && trimmed(plain).empty() && !cell.quoted) {
      inside = cell.quoted = true;
    } else if (parts(line[k])) {
      if (blanks && !cell.quoted && plain.empty()) continue;
      finish();
      cells.emplace_back();
    } else {
      plain += line[k];
    }
  }
  finish();
  if (quotes) *quotes = {inside, words_after};
  if (blanks && cells.size() > 1 && cells.back().text.empty() && !cells.back().quoted) cells.pop_back();
  return cells;
}

bool is_blank(const std::vector<TableCell>& cells) {
  return std::all_of(cells.begin(), cells.end(), [](const TableCell& cell) { return cell.text.empty(); });
}

std::vector<TableCell> split_at_wide_blanks(std::string_view line) {
  std::vector<TableCell> cells;
  for (std::size_t k = 0; k < line.size();) {
    while (k < line.size() && is_space(line[k])) ++k;
    std::size_t end = k;
    while (end < line.size() && line[end] != '\t' &&
           !(line[end] == ' ' && (end + 1 == line.size() || is_space(line[end + 1]))))
      ++end;
    if (end > k) cells.push_back({std::string(line.substr(k, end - k)), false});
    k = end;
  }
  return cells;
}

// Joins units to names: "time [s] load [kN]".
std::vector<TableCell> with_brackets_joined(std::vector<TableCell> words) {
  std::vector<TableCell> cells;
  bool open = false;
  for (TableCell& word : words) {
    const bool begins =
        !word.quoted && !word.text.empty() && (word.text.front() == '[' || word.text.front() == '(');
    if (!cells.empty() && (begins || open))
      cells.back().text += " " + word.text;
    else
      cells.push_back(std::move(word));
    const std::string& text = cells.back().text;
    open =
        text.find_last_of("[(") != std::string::npos &&
        (text.find_last_of("])") == std::string::npos || text.find_last_of("])") < text.find_last_of("[("));
  }
  return cells;
}

}  // namespace

std::size_t find_unquoted(std::string_view line, char wanted) {
  bool inside = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"') inside = !inside;
    if (line[k] == wanted && !inside) return k;
  }
  return std::string_view::npos;
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
    : file_(file),
      form_(form),
      decoded_(utf8_of_utf16(file.bytes())),
      lines_(decoded_ ? *decoded_ : file.text()) {
  if (!decoded_ && !file_.looks_like_text())
    refuse_file(file_, "is not text: it holds zero bytes", "save it as comma-separated text (UTF-8)");
  std::string_view line;
  for (std::int64_t k = 0; k < form_.skip; ++k)
    if (!lines_.next(line))
      refuse_file(file_, "has " + std::to_string(k) + " lines, of which " + std::to_string(form_.skip) +
                             " are to be skipped");
}

std::vector<TableCell> TableLines::split(std::string_view line) const { return split_at(line, separator_); }

std::vector<TableCell> TableLines::heads_between_blanks(std::string_view line, std::string_view next) const {
  std::vector<TableCell> joined = with_brackets_joined(split_at(line, Separator::blank));
  const std::size_t wanted = split_at(next, Separator::blank).size();
  if (joined.size() == wanted) return joined;
  if (std::vector<TableCell> wide = split_at_wide_blanks(line); wide.size() == wanted) return wide;
  return joined;
}

bool TableLines::next_record(LineReader& lines, std::string_view& record, std::size_t& number) const {
  if (!lines.next(record)) return false;
  number = lines.number();
  if (record.find('"') == std::string_view::npos || is_comment(record)) return true;
  QuoteScan scan(!marks_known_                        ? ",;\t"
                 : separator_ == Separator::blank     ? " \t"
                 : separator_ == Separator::tab       ? "\t"
                 : separator_ == Separator::semicolon ? ";"
                                                      : ",");
  scan.take(without_comment(record));
  LineReader ahead = lines;
  for (std::string_view more; scan.is_inside() && ahead.next(more);) {
    scan.take(more);
    if (scan.is_inside()) continue;
    record = {record.data(), static_cast<std::size_t>(more.data() + more.size() - record.data())};
    lines = ahead;
  }
  return true;
}

Separator TableLines::separator_by(std::string_view heads, std::string_view next,
                                   std::string_view second) const {
  const auto holds = [](std::string_view text, char mark) {
    return find_unquoted(text, mark) != std::string_view::npos;
  };
  if (holds(heads, ';')) return Separator::semicolon;
  if (holds(heads, '\t')) return Separator::tab;
  const bool commas = holds(heads, ',') && (!heads_are_given() || separator_of(heads) == Separator::comma);
  const bool words = trimmed(heads).find_first_of(" \t") != std::string_view::npos;
  if (commas || !words || split_at(heads, Separator::comma).size() != 1 ||
      (!heads_are_given() && holds(next, ',') && separator_of(next) != Separator::blank))
    return Separator::comma;
  const std::vector<TableCell> below = split_at(next, Separator::blank);
  const std::vector<TableCell> below_units = split_at(second, Separator::blank);
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

namespace {

// "Force (kN, filtered)": heads joined where a bracket is open.
std::vector<TableCell> joined_in_brackets(const std::vector<TableCell>& heads) {
  std::vector<TableCell> joined;
  int open = 0;
  for (const TableCell& head : heads) {
    if (open > 0)
      joined.back().text += ", " + head.text;
    else
      joined.push_back(head);
    for (const char c : head.text) open += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
  }
  return joined;
}

}  // namespace

bool TableLines::read_heads() {
  std::string_view line;
  LineReader before = lines_;
  if (form_.separator) separator_ = *form_.separator;
  marks_known_ = form_.separator.has_value();
  do {
    before = lines_;
    if (!next_record(lines_, line, line_)) return false;
    if (lower_case(trimmed(line)).starts_with("sep=")) line = {};  // spreadsheet header
  } while (is_comment(line));
  line = without_comment(line);
  std::string_view next, second;
  if (heads_are_given()) {
    next = line;
    lines_ = before;
    line_ = lines_.number();
  } else {
    std::size_t number = 0;
    LineReader ahead = lines_;
    for (std::string_view* below : {&next, &second}) {
      while (next_record(ahead, *below, number) && is_comment(*below)) *below = {};
      *below = without_comment(*below);
    }
  }
  if (!form_.separator) separator_ = separator_by(line, next, second);
  marks_known_ = true;
  head_line_ = line;
  if (heads_are_given()) {
    for (const std::string& head : form_.heads) heads_.push_back({head, false});
    below_ = split(next);
    return true;
  }
  heads_ = separator_ == Separator::blank ? heads_between_blanks(line, next) : split(line);
  for (TableCell& head : heads_) {
    head.text = utf8_or_cp1252(head.text);
    std::ranges::replace(head.text, '\n', ' ');  // a head over two lines
  }
  while (!heads_.empty() && heads_.back().text.empty()) heads_.pop_back();
  below_ = split(next);
  second_ = split(second);
  if (separator_ == Separator::comma && heads_.size() > below_.size())
    if (std::vector<TableCell> joined = joined_in_brackets(heads_); joined.size() == below_.size())
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
          read_time_stamp(cell).kind != TimeStamp::Kind::none || k >= second_.size() ||
          !looks_like_a_number(second_[k].text))
        return false;
      unknown = true;
    }
  }
  return known || (unknown && in_brackets);
}

bool TableLines::ends_with_a_line_end() const {
  const std::string_view text = decoded_ ? std::string_view(*decoded_) : file_.text();
  return text.empty() || text.back() == '\n' || text.back() == '\r';
}

void TableLines::skip_below() {
  std::string_view line;
  while (next_record(lines_, line, line_) && is_comment(line)) {
  }
}

bool TableLines::next_row(std::vector<TableCell>& cells) {
  for (std::string_view line; next_record(lines_, line, line_);) {
    if (is_comment(line)) continue;
    // "sample #3": a # starts a comment unless the row is complete only with it.
    Quotes quotes;
    cells = split_at(without_comment(line), separator_, &quotes);
    if (cells.size() != heads_.size()) cells = split_at(line, separator_, &quotes);
    if (is_blank(cells) && !quotes.open) continue;
    while (cells.size() > heads_.size() && cells.back().text.empty()) cells.pop_back();
    const bool whole = cells.size() == heads_.size();
    if (quotes.open && (whole || !at_end_of_table()))
      refuse_file(file_, "has a quote in " + here() + " that is closed nowhere",
                  "close it at the end of its cell, or take it out");
    if (lines_.number() > line_ && (whole ? quotes.words_after : !at_end_of_table()))
      refuse_file(file_,
                  "has a quote in " + here() + " that is closed in line " + std::to_string(lines_.number()) +
                      " only, where " +
                      (whole ? "no cell ends"
                             : "the row has " + std::to_string(cells.size()) + " cells under " +
                                   std::to_string(heads_.size()) + (heads_.size() == 1 ? " head" : " heads")),
                  "close the quote at the end of its cell, or take it out");
    return true;
  }
  return false;
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
    if (!is_comment(line) && split(without_comment(line)).size() == heads_.size()) {
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
