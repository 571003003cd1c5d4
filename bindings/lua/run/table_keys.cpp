// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/run/table_keys.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace asperity::lua {

namespace {

// { load="Wert" }, sorted by key.
void read_pairs(const Argument& value, const OptionInfo& info,
                std::vector<std::pair<std::string, std::string>>& pairs, const char* wanted,
                Problems& problems) {
  if (!value.is_table()) return detail::wrong_type(value, info, wanted, problems);
  value.each([&](const Argument& key, const Argument& text) {
    if (!key.is_text() || !text.is_text())
      return detail::wrong_type(key.is_text() ? text : key, info, wanted, problems);
    pairs.emplace_back(key.text(), text.text());
  });
  std::ranges::sort(pairs);
}

void read_columns(const Argument& value, const OptionInfo& info, TableForm& form, Problems& problems) {
  constexpr const char* wanted =
      "own names with heads of the file, as in { load=\"Kraft\" }, or the heads of a file that has none in a "
      "list";
  if (!value.is_table()) return detail::wrong_type(value, info, wanted, problems);
  if (value.length() > 0) return read_texts(value, info, form.heads, problems);
  read_pairs(value, info, form.names, wanted, problems);
}

}  // namespace

void read_texts(const Argument& value, const OptionInfo& info, std::vector<std::string>& texts,
                Problems& problems) {
  const auto take = [&](const Argument& part) {
    if (part.is_text())
      texts.emplace_back(part.text());
    else if (!part.is_unknown())
      detail::wrong_type(part, info, "a column's name", problems);
  };
  if (value.is_text()) return take(value);
  if (!value.is_table() || value.length() == 0)
    return detail::wrong_type(value, info, "a column's name or a list of them", problems);
  for (std::int64_t k = 1; k <= value.length(); ++k) value.element(k, take);
}

const std::vector<Option<TableForm>>& table_form_keys() {
  using F = TableForm;
  static const std::vector<Option<F>> keys = {
      custom<F>(
          "columns", "table",
          "own names of columns, each with its head in the file, as in { load=\"Kraft\" }; where two heads "
          "differ in their units alone, with the unit. Or a list: the heads of a file that has none",
          [](const Argument& value, const OptionInfo& info, F& form, Problems& problems) {
            read_columns(value, info, form, problems);
          }),
      integer("skip", &F::skip, at_least(0), "lines above the heads that are left out"),
      custom<F>("unit", "table",
                "units of columns that the file says none for, or others than it says: { load=\"kN\" }; "
                "\"1\" for plain numbers, \"date\" for dates that a spreadsheet wrote as numbers of days",
                [](const Argument& value, const OptionInfo& info, F& form, Problems& problems) {
                  read_pairs(value, info, form.units, "units by the names of columns, as in { load=\"kN\" }",
                             problems);
                }),
      choice("dates", &F::dates,
             {{"day first", DateOrder::day_first}, {"month first", DateOrder::month_first}},
             "the order in dates such as 03/04/2026")
          .defaults_to("as a date of the column tells that has a day after the 12th"),
      choice("clock", &F::clock, {{"h:min", ClockForm::hours_minutes}, {"min:s", ClockForm::minutes_seconds}},
             "what times such as 10:30 are"),
      choice("decimal", &F::decimal, {{".", '.'}, {",", ','}}, "the decimal sign")
          .defaults_to("as the numbers of the file tell together"),
      choice("thousands", &F::thousands, {{",", ','}, {".", '.'}, {" ", ' '}, {"'", '\''}},
             "what parts thousands")
          .defaults_to("nothing"),
      choice("separator", &F::separator,
             {{",", Separator::comma},
              {";", Separator::semicolon},
              {"tab", Separator::tab},
              {"blank", Separator::blank}},
             "what parts the cells")
          .defaults_to("as the line of heads tells"),
  };
  return keys;
}

}  // namespace asperity::lua
