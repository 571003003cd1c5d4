// SPDX-License-Identifier: GPL-3.0-or-later
// Cells are stored as text first: column types and commas depend on all cells.
#include "engine/statistics/table_reader.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/files/text_encoding.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/statistics/file_problems.hpp"
#include "engine/statistics/number_form.hpp"
#include "engine/statistics/stamp_column.hpp"
#include "engine/statistics/table_head.hpp"
#include "engine/statistics/table_lines.hpp"

namespace asperity {

namespace {

constexpr std::string_view spreadsheet_date = "date";

struct ReadColumn {
  std::string title, name, unit;  // unit as written
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

bool is_data(std::string_view cell) {
  return looks_like_a_number(cell) || read_time_stamp(cell).kind != TimeStamp::Kind::none;
}

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
    std::vector<std::vector<Cell>> rows(rows_.size());
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k].left_out || is_nothing(k)) continue;
      std::string unit = read_column(k, rows);
      heads.push_back({columns_[k].name, std::move(unit)});
    }
    problems_.fail_if_any();
    if (heads.empty()) refuse_file(file_, "has no column with a head");
    Table table(std::move(heads), std::move(rows));
    table.rename(file_name(file_.path()));
    return table;
  }

 private:
  std::string column_place(std::size_t k) const {
    return "column " + std::to_string(k + 1) + " (" + plain_text(columns_[k].name) + ")";
  }
  std::string place(std::size_t row, std::size_t k) const {
    return "line " + std::to_string(line_of_[row]) + ", " + column_place(k);
  }
  const TableCell& cell(std::size_t row, std::size_t k) const { return rows_[row][k]; }
  static std::string text_of(const TableCell& cell) {
    return std::string(cell.quoted ? std::string_view(cell.text) : trimmed(cell.text));
  }

  // --- heads

  void read_heads() {
    if (!lines_.read_heads())
      refuse_file(file_, "holds no line of heads", "begin with one such as \"N, angle [deg], load [N]\"");
    if (!lines_.heads_are_given()) refuse_data_as_heads();
    for (const TableCell& head : lines_.heads()) {
      const TableHead parts = table_head(head.text);
      columns_.push_back(
          {plain_text(head.text), plain_text(parts.name), plain_text(utf8_or_cp1252(parts.unit))});
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

  // Heads may be quantities among words: "slip,10 N,20 N".
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

  // By whole head, then without unit; index and number of matches.
  std::pair<std::size_t, std::size_t> find(std::string_view title) const {
    for (const bool whole : {true, false}) {
      std::size_t found = 0, count = 0;
      for (std::size_t k = 0; k < columns_.size(); ++k)
        if ((whole ? columns_[k].title : columns_[k].name) == trimmed(title) && count++ == 0) found = k;
      if (count > 0) return {found, count};
    }
    return {0, 0};
  }

  std::vector<std::string> titles() const {
    std::vector<std::string> names;
    for (const ReadColumn& column : columns_) {
      names.push_back(column.title);
      if (column.name != column.title) names.push_back(column.name);
    }
    return names;
  }

  void rename_columns() {
    std::vector<std::pair<std::size_t, std::string>> renamed;
    for (const auto& [name, title] : form_.names) {
      const auto [k, count] = find(title);
      if (count == 1) {
        renamed.emplace_back(k, name);
        continue;
      }
      problems_.add(lines_.here(),
                    (count == 0 ? std::string("no column is") : std::to_string(count) + " columns are") +
                        " headed " + shown_whole(title) + ", which `columns` calls " + quoted(name) +
                        (count == 0 ? did_you_mean(title, titles()) : "; give the head with its unit"));
    }
    for (const auto& [chosen, name] : renamed) {
      for (std::size_t k = 0; k < columns_.size(); ++k)
        if (k != chosen && columns_[k].name == name &&
            std::ranges::none_of(renamed, [k](const auto& other) { return other.first == k; })) {
          columns_[k].left_out = true;
          monitor_.warn(file_name(file_.path()) + ": column " + std::to_string(k + 1) + ", " +
                        shown_whole(columns_[k].title) + ", is left out: `columns` calls column " +
                        std::to_string(chosen + 1) + " " + quoted(name));
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
      if (const auto [k, count] = find(name); count == 1) return k;
      problems_.add(lines_.here(), quoted(key) + " names " + quoted(std::string(name)) +
                                       ", which is no column" + did_you_mean(name, titles()));
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
    monitor_.warn(file_name(file_.path()) + ": the unit" + (one ? " " : "s ") +
                  joined(unknown_units_, " and ") + (one ? " is" : " are") +
                  " not known; the numbers are read without a unit, and the head" +
                  (one ? " keeps it" : "s keep them"));
  }

  // --- rows

  void read_rows() {
    Task task(monitor_, "reading", static_cast<std::int64_t>(file_.bytes().size()));
    std::size_t before = 0;
    for (std::vector<TableCell> cells; lines_.next_row(cells);) {
      const std::size_t now = std::min(lines_.position(), file_.bytes().size());
      task.advance(static_cast<std::int64_t>(now - before));
      before = now;
      const std::size_t wanted = columns_.size();
      if (cells.size() != wanted) {
        const bool words = std::ranges::none_of(cells, [](const TableCell& cell) {
          return read_cell(cell.text, Separator::blank).kind == CellKind::number;
        });
        // Wider rows, or rows above further numbers, are the table.
        bool above = rows_.empty() || (wanted == 1 && cells.size() > 1);
        const bool at_end = words && !above && lines_.at_end_of_table();
        above = above || (at_end && lines_.numbers_follow());
        if (at_end && !above) {
          monitor_.warn(file_name(file_.path()) + ": what stands below the table, from " + lines_.here() +
                        " on, is left out");
          break;
        }
        problems_.add(lines_.here(),
                      "there " +
                          std::string(cells.size() == 1 ? "is 1 cell"
                                                        : "are " + std::to_string(cells.size()) + " cells") +
                          " under " + std::to_string(wanted) + (wanted == 1 ? " head" : " heads") +
                          (above ? "; lines above the heads are left out by skip=, as in skip=3"
                                 : "; put # before a line that is no row"));
        if (at_end) break;
        continue;
      }
      rows_.push_back(std::move(cells));
      line_of_.push_back(lines_.line());
    }
    problems_.fail_if_any();
    if (rows_.empty()) refuse_file(file_, "names columns but holds no row");
    warn_of_cut_line();
  }

  // "2;1." or "2;" without a line end may be truncated.
  void warn_of_cut_line() {
    if (lines_.ends_with_a_line_end() || lines_.line() != line_of_.back()) return;
    const auto unfinished = [](const std::string& text) {
      return text.empty() || std::string_view(".,eE+-").find(text.back()) != std::string_view::npos;
    };
    const std::string& last = rows_.back().back().text;
    if (rows_.back().back().quoted || !unfinished(last)) return;
    if (rows_.size() > 1 && unfinished(rows_[rows_.size() - 2].back().text)) return;
    monitor_.warn(file_name(file_.path()) + ", " + lines_.here() +
                  ": the last line has no line end and its last cell is " +
                  (last.empty() ? "empty" : shown(last)) + "; the file may be cut short");
  }

  bool is_nothing(std::size_t k) {
    if (!columns_[k].name.empty()) return false;
    for (std::size_t row = 0; row < rows_.size(); ++row)
      if (!cell(row, k).text.empty()) {
        problems_.add(place(row, k), shown(cell(row, k).text) + " stands under no head; give column " +
                                         std::to_string(k + 1) + " one, or empty it");
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
        if (const std::string text = text_of(cell(row, k));
            read_time_stamp(text).kind == TimeStamp::Kind::none)
          evidence.add(text, place(row, k));
    }
    number_form_ = evidence.form();
    if (const auto doubt = evidence.doubt()) problems_.add(doubt->place, doubt->finding);
  }

  bool holds_words(std::size_t k) const {
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const std::string text = text_of(cell(row, k));
      if (looks_like_a_number(text)) return false;
    }
    return true;
  }

  // --- columns

  struct Counts {
    std::size_t numbers = 0, stamps = 0, quantities = 0, truths = 0, texts = 0, filled = 0;
    std::size_t first_other = 0;
  };

  Counts count(std::size_t k) const {
    Counts counts;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const std::string text = text_of(cell(row, k));
      const TextCell number = read_number(text, number_form_);
      if (number.kind == CellKind::hole) continue;
      ++counts.filled;
      if (number.kind != CellKind::unreadable) {
        ++counts.numbers;
        continue;
      }
      if (counts.filled == counts.numbers + 1) counts.first_other = row;
      if (read_time_stamp(text).kind != TimeStamp::Kind::none)
        ++counts.stamps;
      else if (quantity_in_cell(text))
        ++counts.quantities;
      else if (is_truth(text))
        ++counts.truths;
      else
        ++counts.texts;
    }
    return counts;
  }

  // Returns the SI unit.
  std::string read_column(std::size_t k, std::vector<std::vector<Cell>>& rows) {
    ReadColumn& column = columns_[k];
    if (column.said_text) return read_texts(k, rows), "";
    if (column.unit == spreadsheet_date) return read_dates(k, rows);
    const bool plain = column.unit.empty() || column.unit == "-" || column.unit == "1";
    if (!plain) return read_numbers(k, rows);
    const Counts counts = count(k);
    if (column.unit.empty()) {
      if (counts.filled > 0 && counts.stamps == counts.filled) return read_stamps(k, rows);
      if (counts.filled > 0 && counts.quantities == counts.filled) return read_quantities(k, rows);
      if (counts.filled > 0 && counts.truths == counts.filled) {
        for (std::size_t row = 0; row < rows.size(); ++row) {
          const std::string text = text_of(cell(row, k));
          rows[row].emplace_back();
          if (is_truth(text)) rows[row].back() = text == "true";
        }
        return "";
      }
      if (counts.filled > 0 && counts.numbers == 0) return read_texts(k, rows), "";
    }
    if (counts.numbers < counts.filled) {
      const std::size_t others = counts.filled - counts.numbers;
      problems_.add(place(counts.first_other, k),
                    shown(cell(counts.first_other, k).text) + " is no number, as others of this column are" +
                        (others > 1 ? ", and so in " + std::to_string(others - 1) + " more lines" : "") +
                        "; mend it, or text={ \"" + plain_text(column.name) +
                        "\" } takes all of them for texts");
      return "";
    }
    return read_plain(k, rows);
  }

  void read_texts(std::size_t k, std::vector<std::vector<Cell>>& rows) {
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const TableCell& from = cell(row, k);
      const bool nothing = from.text.empty() && !from.quoted;
      rows[row].emplace_back();
      if (!nothing) rows[row].back() = utf8_or_cp1252(without_guard(text_of(from)));
    }
  }

  // Whole numbers only if all are whole.
  std::string read_plain(std::size_t k, std::vector<std::vector<Cell>>& rows) {
    bool whole = true;
    for (std::size_t row = 0; whole && row < rows_.size(); ++row) {
      const std::string text = text_of(cell(row, k));
      const TextCell number = read_number(text, number_form_);
      const auto plain = plain_number(text, number_form_);
      whole = number.kind == CellKind::hole || (plain && whole_number(*plain));
    }
    warn_of_names(k, whole);
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const std::string text = text_of(cell(row, k));
      const TextCell number = read_number(text, number_form_);
      if (number.kind == CellKind::too_large)
        problems_.add(place(row, k), shown(text) + " is beyond any number");
      if (number.kind == CellKind::hole)
        rows[row].emplace_back();
      else if (whole)
        rows[row].emplace_back(*whole_number(*plain_number(text, number_form_)));
      else
        rows[row].emplace_back(number.value);
    }
    return "";
  }

  // Numbers that look like names: equal length with leading zeros, or more digits than a double.
  void warn_of_names(std::size_t k, bool whole) {
    constexpr std::size_t kept = 15, digits_of_names = 3;
    std::optional<std::size_t> zero, last, longest;
    bool alike = true;
    std::size_t digits = 0;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const std::string text = text_of(cell(row, k));
      if (text.empty()) continue;
      const bool whole_text = text.find_first_not_of("0123456789") == std::string::npos;
      if (!last) digits = text.size();
      alike = alike && whole_text && text.size() == digits;
      last = row;
      if (!zero && whole_text && text.front() == '0' && text.size() > 1) zero = row;
      if (!longest && !whole && whole_text && text.size() > kept) longest = row;
    }
    const auto warn = [&](std::size_t row, const char* lost) {
      monitor_.warn(file_name(file_.path()) + " " + place(row, k) + ": " + shown(text_of(cell(row, k))) +
                    " is read as a number, which loses " + lost + "; text={ \"" +
                    plain_text(columns_[k].name) + "\" } keeps it as it stands");
    };
    if (longest) warn(*longest, "digits");
    if (zero && alike && digits >= digits_of_names) warn(*zero, "its zeros");
  }

  // Exact in SI; a cell may have its own unit.
  std::string read_numbers(std::size_t k, std::vector<std::vector<Cell>>& rows) {
    const ReadColumn& column = columns_[k];
    const Quantity unit = parse_unit(column.unit);
    const bool si = unit.value == 1;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const std::string text = text_of(cell(row, k));
      TextCell number = read_number(text, number_form_);
      if (number.kind == CellKind::hole) {
        rows[row].emplace_back();
        continue;
      }
      if (number.kind == CellKind::unreadable)
        if (const auto own = quantity_in_cell(text); own && own->dimension == unit.dimension) {
          rows[row].emplace_back(own->value);
          continue;
        }
      if (number.kind != CellKind::number && number.kind != CellKind::infinite) {
        complain(row, k, text, unit.dimension, number.kind);
        continue;
      }
      if (!si && number.kind == CellKind::number) {
        std::string plain = *plain_number(text, number_form_);
        if (plain.starts_with('+')) plain.erase(0, 1);
        try {
          number.value = parse_quantity(plain + " " + column.unit).value;
        } catch (const Error& error) {
          problems_.add(place(row, k), error.what());
        }
      }
      rows[row].emplace_back(number.value);
    }
    return si_unit(unit.dimension);
  }

  void complain(std::size_t row, std::size_t k, const std::string& text, Dimension wanted, CellKind kind) {
    std::string why;
    if (kind == CellKind::too_large)
      return problems_.add(place(row, k), shown(text) + " is beyond any number");
    if (const auto own = quantity_in_cell(text))
      why = ": it is " + describe(own->dimension) + " where " + describe(wanted) + " is wanted";
    else if (read_time_stamp(text).kind != TimeStamp::Kind::none)
      why = ": it is a date or a time of day, and the unit of the column is " + columns_[k].unit;
    problems_.add(place(row, k), shown(text) + " is no number" + why);
  }

  std::string read_quantities(std::size_t k, std::vector<std::vector<Cell>>& rows) {
    std::optional<Dimension> dimension;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const std::string text = text_of(cell(row, k));
      const auto quantity = quantity_in_cell(text);
      rows[row].emplace_back();
      if (!quantity) continue;
      rows[row].back() = quantity->value;
      if (!dimension) dimension = quantity->dimension;
      if (quantity->dimension != *dimension)
        problems_.add(place(row, k), shown(text) + " is " + describe(quantity->dimension) +
                                         " where those above are each " + describe(*dimension));
    }
    return si_unit(*dimension);
  }

  std::string read_stamps(std::size_t k, std::vector<std::vector<Cell>>& rows) {
    StampColumn stamps(form_);
    for (std::size_t row = 0; row < rows_.size(); ++row)
      if (stamps.learn(text_of(cell(row, k)))) break;
    if (const auto doubt = stamps.doubt()) {
      problems_.add(place(0, k), *doubt);
      return "";
    }
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const std::string text = text_of(cell(row, k));
      if (read_number(text, number_form_).kind == CellKind::hole) {
        rows[row].emplace_back();
        continue;
      }
      const StampColumn::Reading reading = stamps.read(text);
      if (!reading.seconds) problems_.add(place(row, k), reading.complaint);
      rows[row].emplace_back();
      if (reading.seconds) rows[row].back() = *reading.seconds;
      if (!reading.warning.empty())
        monitor_.warn(file_name(file_.path()) + " " + place(row, k) + ": " + shown(text) + reading.warning);
    }
    return "s";
  }

  std::string read_dates(std::size_t k, std::vector<std::vector<Cell>>& rows) {
    const Counts counts = count(k);
    if (counts.stamps == counts.filled) return read_stamps(k, rows);
    constexpr double first_of_1970 = 25569, day = 86400;
    std::optional<double> first;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const std::string text = text_of(cell(row, k));
      const TextCell number = read_number(text, number_form_);
      if (number.kind == CellKind::hole) {
        rows[row].emplace_back();
        continue;
      }
      if (number.kind != CellKind::number)
        problems_.add(place(row, k), shown(text) + " is no day of a spreadsheet, which counts from 1900");
      if (!first) first = form_.stamps_since_1970 ? first_of_1970 : number.value;
      rows[row].emplace_back((number.value - *first) * day);
    }
    return "s";
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
