// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/surface/surface.hpp"

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "engine/core/grid.hpp"
#include "engine/plot/palette.hpp"
#include "engine/plot/picture.hpp"

namespace asperity::lua {

const Block<PictureOptions> picture_block{
    {text("title", &PictureOptions::title, "above the picture"),
     text("label", &PictureOptions::label, "of the colour bar"),
     text("palette", &PictureOptions::palette,
          "of colours: viridis, cividis, grey, heat, balance or contact"),
     custom<PictureOptions>(
         "range", "{number, number}", "lowest and highest value of the colours, in SI",
         [](const Argument& value, const OptionInfo& info, PictureOptions& o, Problems& problems) {
           OptionInfo bound = info;
           bound.dimension = o.unit == "m" ? dimension::length : dimension::number;
           Range& range = o.range.emplace();
           detail::read_pair(value, info, "{lowest, highest}", problems,
                             [&](const Argument& part, bool first) {
                               if (auto v = detail::read_quantity(part, bound, any(), problems))
                                 (first ? range.min : range.max) = *v;
                             });
         }),
     integer("width", &PictureOptions::width, between(200, 4000), "of the picture in pixels"),
     choice("view", &PictureOptions::view,
            {{"map", PictureOptions::View::map}, {"relief", PictureOptions::View::relief}},
            "from above, or in relief")}};

namespace {

Values field_picture(Call& call) {
  const NamedField& f = call.self<NamedField>();
  PictureOptions options = call.options(picture_block, 2);
  if (options.label == PictureOptions{}.label) options.label = f.name;
  options.unit = si_unit(f.dimension);
  if (options.palette == PictureOptions{}.palette) options.palette = palette_of_field(f.name);
  const std::string path = writable_path(call, call.text(1, "path"));
  warn_of(call, draw(f.grid, *f.values, options, path));
  return {path};
}

}  // namespace

Class make_class(For<NamedField>) {
  using F = NamedField;
  Class c{"Field", "a field",
          "A quantity at every node of the tile; nan where it is missing, as the gap is where nothing faces "
          "the lower body."};
  c.describe = from_value([](const NamedField& f) -> std::string {
    const Range r = known_range(f.values->values());
    return f.name + " field " + std::to_string(f.grid.nx) + " x " + std::to_string(f.grid.ny) + ", from " +
           format_quantity(r.min, f.dimension) + " to " + format_quantity(r.max, f.dimension);
  });
  c.native_bytes = from_value([](const NamedField& of) { return of.values->size() * sizeof(double); });
  c.fields = {
      getter<&F::name>("name", "string", "what it is"),
      getter<F>("unit", "string", "SI unit of its values", [](const F& of) { return si_unit(of.dimension); }),
      getter<F>("min", "number", "least value",
                [](const F& of) { return known_range(of.values->values()).min; }),
      getter<F>("max", "number", "greatest value",
                [](const F& of) { return known_range(of.values->values()).max; }),
      getter<F>("mean", "number", "mean over all nodes that have a value",
                [](const F& of) { return known_mean(of.values->values()); }),
  };
  c.methods = {
      {.name = "value",
       .body = method([](const NamedField& f, Call& call) {
         return node_value(*f.values, call.number(1, "i"), call.number(2, "j"));
       }),
       .sentence = "The value at node (i, j), counted from 0.",
       .parameters = {{"i", "integer", "along x"}, {"j", "integer", "along y"}},
       .returns = "number",
       .example = "print(st:field \"gap\":value(0, 0))"},
      {.name = "values",
       .body = method([](const NamedField& f) { return Value::Rows(f.values); }),
       .sentence = "All values as a table of rows, values[j+1][i+1].",
       .returns = "number[][]",
       .example = "local first_row = st:field \"gap\":values()[1]"},
      {.name = "picture",
       .body = field_picture,
       .sentence = "A picture of the field as PNG, true to scale.",
       .parameters = {{"path", "string", "a .png under the run directory"}},
       .options = optional(picture_block),
       .returns = "string",
       .example = "st:field \"gap\":picture(\"gap.png\", { title=\"the gap\" })",
       .heavy = true},
  };
  return c;
}

}  // namespace asperity::lua
