// SPDX-License-Identifier: GPL-3.0-or-later
// t:chart and book:chart. Script functions stay on the stack during drawing.
#include <algorithm>

#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

using C = NotebookChart;

void read_spread(const Argument& value, const OptionInfo& info, C& c, Problems& problems) {
  if (value.is_boolean())
    c.spread = value.boolean();
  else if (value.is_text())
    c.spread_column = std::string(value.text());
  else
    detail::wrong_type(value, info, "true or a column's name", problems);
}

void read_interval(const Argument& value, const OptionInfo& info, C& c, Problems& problems) {
  if (!value.is_table() || value.length() != 2)
    return detail::wrong_type(value, info, "two columns' names, as in {\"low\", \"high\"}", problems);
  std::vector<std::string> names;
  read_texts(value, info, names, problems);
  if (names.size() != 2) return;
  c.low = names[0];
  c.high = names[1];
}

void read_line_across(const Argument& value, std::int64_t k, C& c, Problems& problems) {
  static const std::vector<std::string> keys = {"x", "y", "name"};
  const std::string place = "lines[" + std::to_string(k) + "]";
  if (value.is_unknown()) return;
  if (!value.is_table())
    return detail::wrong_type(value, place, "a table such as { y=0.4, name=\"measured\" }", problems);
  ReferenceLine line;
  bool unknown = false;
  value.each([&](const Argument& key, const Argument& given) {
    const std::string_view name = key.text();
    unknown = unknown || given.is_unknown();
    if (name == "x") {
      read_expected(given, place + ".x", line.x, problems);
    } else if (name == "y") {
      read_expected(given, place + ".y", line.y, problems);
    } else if (name == "name" && given.is_text()) {
      line.name = given.text();
    } else if (name == "name") {
      if (!given.is_unknown()) detail::wrong_type(given, place + ".name", "a string", problems);
    } else {
      problems.push_back(quoted(place) + " has the key " + (key.is_text() ? quoted(name) : key.describe()) +
                         did_you_mean(name, keys) + "; a line has x or y, and a name");
    }
  });
  if (!unknown && line.x.has_value() == line.y.has_value())
    problems.push_back(quoted(place) + (line.x ? " has both x and y" : " has neither x nor y") +
                       "; give one of them, as in { y=0.4, name=\"measured\" }");
  c.references.push_back(std::move(line));
}

void read_lines(const Argument& value, const OptionInfo& info, C& c, Problems& problems) {
  if (value.is_boolean()) {
    c.lines = value.boolean();
  } else if (value.is_table() && value.length() > 0) {
    value.elements([&](const Argument& part, std::int64_t k) { read_line_across(part, k, c, problems); });
  } else {
    detail::wrong_type(value, info,
                       "true, false, or a list of lines such as { { y=0.4, name=\"measured\" } }", problems);
  }
}

void read_fits(const Argument& value, const OptionInfo& info, C& c, Problems& problems) {
  const auto take = [&](const Argument& part) {
    if (auto fit = fitted_curve_of(part))
      c.fits.push_back(*std::move(fit));
    else if (!part.is_unknown())
      detail::wrong_type(part, info, "the result of t:fit{...}, or a list of such results", problems);
  };
  if (!value.is_table()) return take(value);
  if (value.length() == 0)
    return detail::wrong_type(value, info, "the result of t:fit{...}, or a list of such results", problems);
  value.elements(take);
}

// Only names: functions are read when the chart is drawn.
void read_functions(const Argument& value, const OptionInfo& info, C& c, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(
        value, info, "a table of functions by name, as in { law=function(x) return x end }", problems);
  value.each([&](const Argument& key, const Argument& function) {
    if (!key.is_text())
      problems.push_back(quoted(info.name) + " names a function by " + key.describe() + "; give it a name");
    else if (function.is_function())
      c.functions.push_back({std::string(key.text()), nullptr});
    else if (!function.is_unknown())
      problems.push_back("`functions." + std::string(key.text()) + "` is " + function.describe() +
                         "; give a function of x");
  });
  std::ranges::sort(c.functions, {}, &FunctionLine::name);
}

std::vector<Option<C>> panel_keys(bool first) {
  auto x = text("x", &C::x, "the column along");
  return {first ? std::move(x).required() : std::move(x).defaults_to("that of the panel above"),
          texts_key("y", "string|string[]", "the column, or columns of one unit, up", &C::y).required(),
          text("one_line_per", &C::one_line_per, "a column; one line for each of its values"),
          custom<C>("spread", "boolean|string",
                    "error bars: true for the scatter of rows that share x, or a column that holds them",
                    read_spread),
          custom<C>("interval", "{string, string}",
                    "error bars: the columns that hold their lower and upper ends, as t:mean gives them",
                    read_interval),
          where_key(&C::where),
          flag("log_x", &C::log_x, "logarithmic axis along"),
          flag("log_y", &C::log_y, "logarithmic axis up"),
          flag("in_order", &C::in_order, "join rows as they were written, for loops that come back"),
          custom<C>("lines", "boolean|table[]",
                    "whether to join the points: where a fit is drawn or names stand along x they are "
                    "not, unless asked for; or a list of lines across, each with y or x, a number in "
                    "the column's unit or a quantity, and a name",
                    read_lines)
              .defaults_to("true"),
          flag("points", &C::points, "mark the points"),
          custom<C>("fit", "Calibration|Calibration[]",
                    "a result of t:fit for these columns, drawn with the band of the curve", read_fits),
          custom<C>("functions", "table<string, function>",
                    "functions of x drawn as lines under their names, in the units of the columns",
                    read_functions),
          text("title", &C::title, "above the chart"),
          text("x_label", &C::x_label, "instead of the column's name"),
          text("y_label", &C::y_label, "instead of the column's name"),
          choice("legend", &C::legend,
                 {{"right", "right"},
                  {"below", "below"},
                  {"top left", "top left"},
                  {"top right", "top right"},
                  {"bottom left", "bottom left"},
                  {"bottom right", "bottom right"},
                  {"none", "none"}},
                 "the place of the names of lines; default right, of long names or with `width` below")};
}

const Block<NotebookChart> below_block{panel_keys(false)};

struct Wanted {
  bool below;
  FunctionLine* line;
};

// Pushes the functions recursively, then calls `use`.
template <class Use>
void with_functions(const Argument& chart, std::vector<Wanted>& wanted, std::size_t k, Use& use) {
  if (k == wanted.size()) return use();
  const auto go_on = [&](const Argument& panel) {
    with_key(panel, "functions", [&](const Argument& functions) {
      with_key(functions, wanted[k].line->name, [&](const Argument& function) {
        const std::string name = "functions." + wanted[k].line->name;
        wanted[k].line->value = [call = Callback(function), name](double x) { return call({x}, name); };
        with_functions(chart, wanted, k + 1, use);
      });
    });
  };
  if (wanted[k].below)
    with_key(chart, "below", go_on);
  else
    go_on(chart);
}

Values chart_rows(Call& call) {
  NotebookChart options = call.options(notebook_chart_block);
  RunDirectory& run = run_of(call, "draws no charts", "return its results, and draw it after the loop");
  std::vector<Wanted> wanted;
  for (FunctionLine& line : options.functions) wanted.push_back({false, &line});
  if (options.below) {
    if (options.below->x.empty()) {
      options.below->x = options.x;
      options.below->log_x = options.below->log_x || options.log_x;
    }
    for (FunctionLine& line : options.below->functions) wanted.push_back({true, &line});
  }
  const Argument self(call.L, 1);
  const auto* book = self.as<Notebook>();
  const auto table = table_of_self(call);
  DrawnChart drawn;
  const auto draw_it = [&] {
    drawn = draw_chart(run, book != nullptr ? book->name() : "table", *table, options);
  };
  with_functions(call.argument(1), wanted, 0, draw_it);
  warn_of(call, drawn.warnings);
  return {drawn.file.string()};
}

}  // namespace

const Block<NotebookChart> notebook_chart_block = [] {
  std::vector<Option<C>> keys = panel_keys(true);
  Option<C> below = custom<C>(
      "below", "table",
      "a second panel below, with the same keys but for `file`; `x` is that of the first unless given",
      [](const Argument& value, const OptionInfo& info, C& c, Problems& problems) {
        if (!value.is_table()) return detail::wrong_type(value, info, "a table of named keys", problems);
        detail::collect(problems,
                        [&] { c.below = std::make_shared<C>(below_block.read(value, quoted(info.name))); });
      });
  below.info.inner = &below_block;
  append(keys, std::move(below),
         quantity("width", &C::width, dimension::length, inside(0.02, 1),
                  "of the printed figure; text and lines follow `font_size`, a .png has 300 pixels per inch"),
         number("font_size", &C::font_size, inside(3, 40),
                "of the text in print, in points; default 8, with a `width`, or 240 mm without one"),
         text("file", &C::file,
              "an .svg, .png or .pdf under the run directory; default <notebook>-<y>-<x>.svg, of a "
              "table table-<y>-<x>.svg"));
  return Block<C>{std::move(keys)};
}();

Function chart_method() {
  return {.name = "chart",
          .body = chart_rows,
          .sentence = "Draws columns against a column; returns the file.",
          .options = &notebook_chart_block,
          .returns = "string",
          .example = "book:chart{ x=\"D\", y=\"mu\", one_line_per=\"r\" }",
          .heavy = true};
}

}  // namespace asperity::lua
