// SPDX-License-Identifier: GPL-3.0-or-later
// show(value): maps and charts, in the terminal or in a file.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "bindings/lua/editor/prompt.hpp"
#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/library.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/require.hpp"
#include "engine/plot/palette.hpp"
#include "engine/plot/picture.hpp"
#include "engine/plot/text_picture.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

void say(const Call& call, const std::string& text) {
  std::FILE* output = call.session().output;
  std::fwrite(text.data(), 1, text.size(), output);
  std::fflush(output);
}

std::optional<std::string> file_given(const Call& call) {
  if (!call.given(2) || !call.argument(2).is_text()) return {};
  return call.text(2, "file");
}

void show_map(const Call& call, const Grid& grid, const Field& values, const std::string& label,
              Dimension dimension) {
  const std::optional<std::string> file = file_given(call);
  PictureOptions options = file ? PictureOptions{} : call.options(picture_block, 2);
  options.label = options.label == PictureOptions{}.label ? label : options.label;
  options.unit = si_unit(dimension);
  if (options.palette == PictureOptions{}.palette) options.palette = palette_of_field(label);
  if (!file) return say(call, text_map(grid, values, options, dimension, text_canvas()));
  const std::string path = writable_path(call, *file);
  warn_of(call, draw(grid, values, options, path));
  say(call, "drawn in " + path + "\n");
}

void show_chart(const Call& call, const LineChart& chart) {
  std::vector<std::string> warnings;
  const std::string text = text_chart(chart, text_canvas(), warnings);
  warn_of(call, warnings);
  say(call, text);
}

void show_profile(const Call& call, const Profile& profile) {
  if (const auto file = file_given(call)) {
    const std::string path = writable_path(call, *file);
    warn_of(call, draw(profile, "", path));
    return say(call, "drawn in " + path + "\n");
  }
  LineChart chart;
  chart.x.label = profile.closed() ? "angle around" : "along";
  chart.x.unit = profile.closed() ? "rad" : "m";
  chart.y.label = "height";
  chart.y.unit = "m";
  ChartSeries& line = chart.series.emplace_back();
  line.points = false;
  line.gaps = !profile.complete();
  const double step = profile.closed() ? 6.283185307179586 / profile.size() : profile.spacing();
  for (int k = 0; k < profile.size(); ++k) {
    line.x.push_back(k * step);
    line.y.push_back(profile.measured_heights()[static_cast<std::size_t>(k)]);
  }
  show_chart(call, chart);
}

void show_notebook(const Call& call, const Notebook& notebook) {
  const NotebookChart options = call.options(notebook_chart_block, 2);
  std::vector<std::string> warnings;
  if (options.file) {
    const DrawnChart drawn = draw_chart(*call.session().run, notebook, options);
    for (const std::string& warning : drawn.warnings) call.session().monitor().warn(warning);
    return say(call, "drawn in " + drawn.file.string() + "\n");
  }
  const LineChart chart = chart_of(notebook.table(), options, warnings);
  for (const std::string& warning : warnings) call.session().monitor().warn(warning);
  show_chart(call, chart);
}

void show_numbers(const Call& call, const Argument& table) {
  LineChart chart;
  chart.x.label = "number";
  chart.y.label = "value";
  ChartSeries& line = chart.series.emplace_back();
  table.elements([&](const Argument& value, std::int64_t k) {
    if (!value.is_number())
      refuse("element " + std::to_string(k) + " of the list is " + value.describe(),
             "give a list of numbers");
    line.x.push_back(static_cast<double>(k));
    line.y.push_back(value.number());
  });
  show_chart(call, chart);
}

Values show_value(const Call& call) {
  if (call.count() > 2) refuse("show takes at most 2 arguments");
  const Argument value = call.argument(1);
  if (const Surface* surface = call.given(1) ? value.as<Surface>() : nullptr) {
    show_map(call, surface->grid(), surface->measured_heights(), "height", dimension::length);
    if (const std::string missing = missing_text(surface->measured(), surface->grid().nodes());
        !missing.empty())
      say(call, missing.substr(2) + "\n");
  } else if (const NamedField* field = call.given(1) ? value.as<NamedField>() : nullptr) {
    show_map(call, field->grid, *field->values, field->name, field->dimension);
  } else if (const asperity::State* state = call.given(1) ? value.as<asperity::State>() : nullptr) {
    show_map(call, state->grid(), *state->field("pressure"), "pressure", dimension::pressure);
  } else if (const Profile* profile = call.given(1) ? value.as<Profile>() : nullptr) {
    show_profile(call, *profile);
  } else if (const Notebook* notebook = call.given(1) ? value.as<Notebook>() : nullptr) {
    show_notebook(call, *notebook);
  } else if (call.given(1) && value.is_table() && value.length() > 0) {
    show_numbers(call, value);
  } else {
    refuse("this is " + (call.given(1) ? value.describe() : "nothing"),
           "show draws a surface, a state, a field, a profile, a list of numbers, or a notebook with "
           "show(book, { x=\"N\", y=\"Ra\" })");
  }
  return {};
}

int guarded_show(lua_State* L) {
  static const std::string name = "show";
  return guarded(L, name, [&]() -> Values { return show_value(Call(L, name, false)); });
}

int outer_show(lua_State* L) {
  const int results = guarded_show(L);
  return results < 0 ? lua_error(L) : results;
}

}  // namespace

void push_show(lua_State* L) { lua_pushcfunction(L, outer_show); }

std::string shown_quantity(double value, Dimension dimension) {
  const std::string readable = format_quantity(value, dimension);
  const std::string plain = format_short(value + 0.0, 8) + " " + si_unit(dimension);
  return readable == plain ? readable : readable + " (" + plain + ")";
}

}  // namespace asperity::lua
