// SPDX-License-Identifier: GPL-3.0-or-later
// First as text: column types and commas depend on all cells.
#include "engine/statistics/table_reader.hpp"

#include <algorithm>
#include <charconv>
#include <functional>

#include "engine/core/files/text_encoding.hpp"
#include "engine/statistics/cell_column.hpp"
#include "engine/statistics/number_form.hpp"
#include "engine/statistics/table_head.hpp"
#include "engine/statistics/table_lines.hpp"

namespace asperity {

namespace {

constexpr std::string_view spreadsheet_date = "date";

struct ReadColumn : HeadedColumn {
  bool left_out = false;
  bool said_text = false;
};

// Exact in a double, without point or exponent.
std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr std::int64_t most = std::int64_t{1} << 53;
  if (wrong != std::errc{} || end != text.data() + text.size() || value > most || value < -most) return {};
  return value;
}

bool is_truth(std::string_view text) { return text == "true" || text == "false"; }

bool is_data(std::string_view cell) { return looks_like_a_number(cell) || is_time_stamp(cell); }

// Reverses the formula guard of csv_text in table.cpp.
std::string without_guard(const std::string& text) {
  const bool guarded = text.size() > 1 && text[0] == '\'' &&
                       std::string_view("=+-@\t\r").find(text[1]) != std::string_view::npos;
  return guarded ? text.substr(1) : text;
}

class MeasuredTable {
 public:
  MeasuredTable(const SourceFile& file, const TableForm& form, Monitor& monitor)
      : file_(file), form_(form), monitor_(monitor), lines_(file, form), problems_(file) {}

  Table read() {
    read_heads();
    problems_.fail_if_any();
    read_rows();
    learn_number_form();
    problems_.fail_if_any();
    std::vector<TableColumn> heads;
    Rows rows(rows_.size());
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k].left_out || is_nothing(k)) continue;
      std::string unit = read_column(k, rows);
      heads.push_back({columns_[k].name, std::move(unit)});
    }
    problems_.fail_if_any();
    if (heads.empty()) refuse_file(file_, "has no column with a head");
    return {std::move(heads), std::move(rows), file_name(file_.path())};
  }

 private:
  using Rows = std::vector<std::vector<Cell>>;
  std::string column_place(std::size_t k) const {
    return "column " + std::to_string(k + 1) + " (" + plain_text(columns_[k].name) + ")";
  }
  std::string place(std::size_t row, std::size_t k) const {
    return "line " + std::to_string(line_of_[row]) + ", " + column_place(k);
  }
  const std::string& text(std::size_t row, std::size_t k) const { return rows_[row][k].text; }
  void warn(const std::string& finding) const { monitor_.warn(file_name(file_.path()) + finding); }

  // --- heads

  void read_heads() {
    if (!lines_.read_heads())
      refuse_file(file_, "holds no line of heads", "begin with one such as \"N, angle [deg], load [N]\"");
    if (!lines_.heads_are_given()) refuse_data_as_heads();
    for (const TableCell& head : lines_.heads()) {
      const TableHead parts = table_head(head.text);
      columns_.push_back(
          {{plain_text(head.text), plain_text(parts.name), plain_text(utf8_or_cp1252(parts.unit))}});
    }
    const bool below = !lines_.heads_are_given() && lines_.units_stand_below() &&
                       std::ranges::all_of(columns_, [](const ReadColumn& c) { return c.unit.empty(); });
    for (std::size_t k = 0; below && k < std::min(columns_.size(), lines_.below().size()); ++k)
      columns_[k].unit = utf8_or_cp1252(bare_unit(lines_.below()[k].text));
    rename_columns();
    say_units();
    check_names();
    for (std::size_t k = 0; k < columns_.size(); ++k) check_unit(k);
    warn_of_unknown_units();
    if (below) lines_.skip_below();
  }

  // Quantities among words may be heads: "slip,10 N,20 N".
  void refuse_data_as_heads() const {
    const std::vector<TableCell>& heads = lines_.heads();
    const bool numbers = is_row_of_numbers(lines_.head_line());
    auto found = std::ranges::find_if(heads, is_data, &TableCell::text);
    if (std::ranges::all_of(heads,
                            [](const TableCell& cell) { return quantity_in_cell(cell.text).has_value(); }))
      found = heads.begin();
    if (numbers || found != heads.end())
      refuse_file(file_,
                  "begins with " + (numbers ? "numbers" : shown(found->text)) + ", in " + lines_.here() +
                      ", and names no columns",
                  "give their heads, as in columns={ \"time [s]\", \"load [kN]\" }");
  }

  std::vector<HeadedColumn> heads() const { return {columns_.begin(), columns_.end()}; }

  void rename_columns() {
    std::vector<std::pair<std::size_t, std::string>> renamed;
    for (const auto& [name, title] : form_.names) {
      const HeadMatch match = find_head(heads(), title, false);
      if (match.count == 1)
        renamed.emplace_back(match.first, name);
      else
        problems_.add(lines_.here(), head_complaint(heads(), match, title, name));
    }
    for (const auto& [chosen, name] : renamed) {
      for (std::size_t k = 0; k < columns_.size(); ++k)
        if (k != chosen && columns_[k].name == name &&
            std::ranges::none_of(renamed, [k](const auto& other) { return other.first == k; })) {
          columns_[k].left_out = true;
          warn(": column " + std::to_string(k + 1) + ", " + shown_whole(columns_[k].title) +
               ", is left out: `columns` calls column " + std::to_string(chosen + 1) + " " + quoted(name));
        }
    }
    for (const auto& [chosen, name] : renamed) columns_[chosen].name = name;
  }

  static std::string shown_whole(std::string_view text) {
    return "\"" + plain_text(std::string(text)) + "\"";
  }

  void say_units() {
    const auto place_of = [&](std::string_view name, const char* key) -> std::optional<std::size_t> {
      for (std::size_t k = 0; k < columns_.size(); ++k)
        if (!columns_[k].left_out && columns_[k].name == name) return k;
      if (const HeadMatch match = find_head(heads(), name, false); match.count == 1) return match.first;
      problems_.add(lines_.here(), quoted(key) + " names " + quoted(name) + ", which is no column" +
                                       did_you_mean(name, head_names(heads())));
      return {};
    };
    for (const auto& [name, unit] : form_.units)
      if (const auto k = place_of(name, "unit")) columns_[*k].unit = unit;
    for (const std::string& name : form_.texts)
      if (const auto k = place_of(name, "text")) columns_[*k].said_text = true;
  }

  void check_names() {
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k].left_out || columns_[k].name.empty()) continue;
      for (std::size_t before = 0; before < k; ++before)
        if (!columns_[before].left_out && columns_[before].name == columns_[k].name) {
          problems_.add(lines_.here() + ", " + column_place(k),
                        "has the name of column " + std::to_string(before + 1) +
                            (columns_[before].title != columns_[k].title
                                 ? "; choose one, as in columns={ " + plain_text(columns_[k].name) + "=" +
                                       shown_whole(columns_[k].title) + " }"
                                 : "; give each a head of its own"));
          break;
        }
    }
  }

  void check_unit(std::size_t k) {
    ReadColumn& column = columns_[k];
    if (column.left_out || column.said_text) return;
    // "time [hh:mm:ss]" is a format.
    if (column.unit.find(':') != std::string::npos) column.unit.clear();
    if (column.unit.empty() || column.unit == spreadsheet_date) return;
    try {
      parse_unit(column.unit);
      return;
    } catch (const Error& error) {
      const bool said =
          std::ranges::any_of(form_.units, [&](const auto& given) { return given.second == column.unit; });
      if (said) return problems_.add(lines_.here() + ", " + column_place(k), error.what());
    }
    unknown_units_.push_back(shown_whole(column.unit) + " of " + column_place(k));
    const bool renamed =
        std::ranges::any_of(form_.names, [&](const auto& given) { return given.first == column.name; });
    if (!renamed) column.name += " [" + plain_text(column.unit) + "]";
    column.unit.clear();
  }

  void warn_of_unknown_units() {
    if (unknown_units_.empty()) return;
    const bool one = unknown_units_.size() == 1;
    warn(": the unit" + std::string(one ? " " : "s ") + joined(unknown_units_, " and ") +
         (one ? " is" : " are") + " not known; the numbers are read without a unit, and the head" +
         (one ? " keeps it" : "s keep them"));
  }

  // --- rows

  void read_rows() {
    lines_.read_rows(monitor_, problems_, [this](std::vector<TableCell>& cells) {
      rows_.push_back(std::move(cells));
      line_of_.push_back(lines_.line());
      return true;
    });
    problems_.fail_if_any();
    if (rows_.empty()) refuse_file(file_, "names columns but holds no row");
    warn_of_cut_line();
  }

  // "2;1." or "2;" at the end may be truncated.
  void warn_of_cut_line() {
    if (ends_with_line_end(file_) || lines_.line() != line_of_.back()) return;
    const auto unfinished = [](const std::string& text) {
      return text.empty() || std::string_view(".,eE+-").find(text.back()) != std::string_view::npos;
    };
    const std::string& last = rows_.back().back().text;
    if (rows_.back().back().quoted || !unfinished(last)) return;
    if (rows_.size() > 1 && unfinished(rows_[rows_.size() - 2].back().text)) return;
    warn(", " + lines_.here() + ": the last line has no line end and its last cell is " +
         (last.empty() ? "empty" : shown(last)) + "; the file may be cut short");
  }

  bool is_nothing(std::size_t k) {
    if (!columns_[k].name.empty()) return false;
    for (std::size_t row = 0; row < rows_.size(); ++row)
      if (!text(row, k).empty()) {
        problems_.add(place(row, k), shown(text(row, k)) + " has no head; give column " +
                                         std::to_string(k + 1) + " a head, or empty the cell");
        break;
      }
    return true;
  }

  void learn_number_form() {
    NumberEvidence evidence(form_.decimal, form_.thousands);
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k].left_out || columns_[k].said_text) continue;
      if (columns_[k].unit.empty() && holds_words(k)) continue;
      for (std::size_t row = 0; row < rows_.size(); ++row)
        if (!is_time_stamp(text(row, k))) evidence.add(text(row, k), place(row, k));
    }
    number_form_ = evidence.form();
    if (const auto doubt = evidence.doubt()) problems_.add(doubt->place, doubt->finding);
  }

  bool holds_words(std::size_t k) const {
    return std::ranges::none_of(
        rows_, [k](const std::vector<TableCell>& cells) { return looks_like_a_number(cells[k].text); });
  }

  // --- columns

  struct Counts {
    std::size_t numbers = 0, stamps = 0, quantities = 0, truths = 0, filled = 0;
    std::size_t first_other = 0;
  };

  Counts count(std::size_t k) const {
    Counts counts;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const std::string& cell = text(row, k);
      const CellKind kind = read_number(cell, number_form_).kind;
      if (kind == CellKind::hole) continue;
      ++counts.filled;
      if (kind != CellKind::unreadable) {
        ++counts.numbers;
        continue;
      }
      if (counts.filled == counts.numbers + 1) counts.first_other = row;
      if (is_time_stamp(cell))
        ++counts.stamps;
      else if (quantity_in_cell(cell))
        ++counts.quantities;
      else if (is_truth(cell))
        ++counts.truths;
    }
    return counts;
  }

  // Stores numbers in SI; returns the display unit.
  std::string read_column(std::size_t k, Rows& rows) {
    using Kind = CellColumn::Kind;
    const ReadColumn& column = columns_[k];
    if (column.said_text) return read_texts(k, rows), "";
    const bool plain = column.unit.empty() || column.unit == "-" || column.unit == "1";
    if (!plain && column.unit != spreadsheet_date) return read_values(k, Kind::numbers, rows);
    const Counts counts = count(k);
    if (column.unit == spreadsheet_date)
      return read_values(k, counts.stamps == counts.filled ? Kind::stamps : Kind::days, rows);
    if (column.unit.empty() && counts.filled > 0) {
      if (counts.stamps == counts.filled) return read_values(k, Kind::stamps, rows);
      if (counts.quantities == counts.filled) return read_values(k, Kind::quantities, rows);
      if (counts.truths == counts.filled) return read_truths(k, rows), "";
      if (counts.numbers == 0) return read_texts(k, rows), "";
    }
    if (counts.numbers == counts.filled) return read_plain(k, rows), "";
    const std::size_t others = counts.filled - counts.numbers;
    problems_.add(place(counts.first_other, k),
                  shown(text(counts.first_other, k)) + " is no number, unlike others of this column" +
                      (others > 1 ? " (and " + std::to_string(others - 1) + " more lines)" : "") +
                      "; correct it, or read the column as texts by text={ \"" + plain_text(column.name) +
                      "\" }");
    return "";
  }

  void fill(Rows& rows, const std::function<Cell(std::size_t)>& cell_of_row) const {
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row].push_back(cell_of_row(row));
  }

  void read_texts(std::size_t k, Rows& rows) {
    fill(rows, [&](std::size_t row) -> Cell {
      const TableCell& from = rows_[row][k];
      if (from.text.empty() && !from.quoted) return {};
      return utf8_or_cp1252(without_guard(from.text));
    });
  }

  void read_truths(std::size_t k, Rows& rows) {
    fill(rows, [&](std::size_t row) -> Cell {
      if (!is_truth(text(row, k))) return {};
      return text(row, k) == "true";
    });
  }

  // Whole numbers only if all are whole.
  void read_plain(std::size_t k, Rows& rows) {
    const auto whole_in = [&](std::size_t row) -> std::optional<std::int64_t> {
      const auto plain = plain_number(text(row, k), number_form_);
      return plain ? whole_number(*plain) : std::nullopt;
    };
    bool whole = true;
    for (std::size_t row = 0; whole && row < rows_.size(); ++row)
      whole = read_number(text(row, k), number_form_).kind == CellKind::hole || whole_in(row);
    warn_of_names(k, whole);
    fill(rows, [&](std::size_t row) -> Cell {
      const TextCell number = read_number(text(row, k), number_form_);
      if (number.kind == CellKind::too_large)
        problems_.add(place(row, k), shown(text(row, k)) + " is too large for a number");
      if (number.kind == CellKind::hole) return {};
      return whole ? Cell(*whole_in(row)) : Cell(number.value);
    });
  }

  // Like names: equal length with leading zeros, or more digits than a double.
  void warn_of_names(std::size_t k, bool whole) {
    constexpr std::size_t kept = 15, digits_of_names = 3;
    std::optional<std::size_t> zero, longest;
    bool alike = true;
    std::size_t digits = 0;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const std::string& cell = text(row, k);
      if (cell.empty()) continue;
      const bool whole_text = cell.find_first_not_of("0123456789") == std::string::npos;
      if (digits == 0) digits = cell.size();
      alike = alike && whole_text && cell.size() == digits;
      if (!zero && whole_text && cell.front() == '0' && cell.size() > 1) zero = row;
      if (!longest && !whole && whole_text && cell.size() > kept) longest = row;
    }
    const auto warn_of_loss = [&](std::size_t row, const char* lost) {
      warn(" " + place(row, k) + ": " + shown(text(row, k)) + " is read as a number, which loses " + lost +
           "; text={ \"" + plain_text(columns_[k].name) + "\" } reads it unchanged");
    };
    if (longest) warn_of_loss(*longest, "digits");
    if (zero && alike && digits >= digits_of_names) warn_of_loss(*zero, "its zeros");
  }

  std::string read_values(std::size_t k, CellColumn::Kind kind, Rows& rows) {
    CellColumn column(kind, kind == CellColumn::Kind::numbers ? columns_[k].unit : "", {}, form_);
    if (kind == CellColumn::Kind::stamps) {
      for (std::size_t row = 0; row < rows_.size(); ++row)
        if (column.stamps().learn(text(row, k))) break;
      if (const auto doubt = column.stamps().doubt()) return problems_.add(place(0, k), *doubt), "";
    }
    fill(rows, [&](std::size_t row) -> Cell {
      const CellReading reading = column.read(text(row, k), number_form_, true);
      if (!reading.warning.empty()) warn(" " + place(row, k) + ": " + shown(text(row, k)) + reading.warning);
      if (reading.kind == CellKind::unreadable) problems_.add(place(row, k), reading.complaint);
      const bool empty = reading.kind == CellKind::unreadable || reading.kind == CellKind::hole;
      return empty ? Cell() : Cell(reading.value);
    });
    const std::string& unit = columns_[k].unit;
    const bool in_file = kind == CellColumn::Kind::numbers && !unit.empty() && unit != "-" && unit != "1";
    return in_file ? unit : si_unit(column.dimension());
  }

  const SourceFile& file_;
  const TableForm& form_;
  Monitor& monitor_;
  TableLines lines_;
  FileProblems problems_;
  NumberForm number_form_;
  std::vector<ReadColumn> columns_;
  std::vector<std::vector<TableCell>> rows_;
  std::vector<std::size_t> line_of_;
  std::vector<std::string> unknown_units_;
};

}  // namespace

Table read_measured_table(const SourceFile& file, const TableForm& form, Monitor& monitor) {
  return MeasuredTable(file, form, monitor).read();
}

}  // namespace asperity
