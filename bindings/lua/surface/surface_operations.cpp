// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/surface/measure.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/operations/operations.hpp"

namespace asperity::lua {

namespace {

struct ScaleKeys {
  std::optional<double> amplitude, rms, ra;
  ScaleAbout about = ScaleAbout::mean;
};
const Block<ScaleKeys> scale_block{
    {quantity("amplitude", &ScaleKeys::amplitude, dimension::length, at_least(0), "peak to valley to reach"),
     quantity("rms", &ScaleKeys::rms, dimension::length, at_least(0), "root mean square height to reach"),
     quantity("ra", &ScaleKeys::ra, dimension::length, at_least(0), "mean absolute height to reach"),
     choice("about", &ScaleKeys::about, {{"mean", ScaleAbout::mean}, {"base", ScaleAbout::base}},
            "the fixed height: the mean or the lowest point")},
    [](ScaleKeys& keys, Problems& problems) {
      const int given = (keys.amplitude ? 1 : 0) + (keys.rms ? 1 : 0) + (keys.ra ? 1 : 0);
      if (given != 1)
        problems.push_back("give exactly one of `amplitude`, `rms` and `ra`; " + std::to_string(given) +
                           " are given");
    }};
Values scale(Call& call) {
  const ScaleKeys keys = call.options(scale_block);
  const Surface& s = call.self<Surface>();
  if (keys.amplitude) return {object(scaled(s, ScaleTo::amplitude, *keys.amplitude, keys.about))};
  if (keys.rms) return {object(scaled(s, ScaleTo::rms, *keys.rms, keys.about))};
  return {object(scaled(s, ScaleTo::ra, *keys.ra, keys.about))};
}

struct SurfaceShiftKeys {
  double x = 0, y = 0;
};
const Block<SurfaceShiftKeys> shift_surface_block{
    {quantity("x", &SurfaceShiftKeys::x, dimension::length, any(), "way along x"),
     quantity("y", &SurfaceShiftKeys::y, dimension::length, any(), "way along y")}};
Values of_two_surfaces(const Call& call, Surface (*combine)(const Surface&, const Surface&)) {
  const auto* a = call.argument(1).as<Surface>();
  const auto* b = call.argument(2).as<Surface>();
  if (a == nullptr || b == nullptr)
    refuse("one side is " + call.argument(a == nullptr ? 1 : 2).describe() + ", the other a surface",
           "give two surfaces of equal cells and size; `levelled{ degree=0 }` removes the mean height");
  return {object(combine(*a, *b))};
}
// Factors are plain numbers: height times length is an area.
Values multiple_of(Call& call) {
  const bool number_first = call.argument(1).is_number();
  const Argument factor = call.argument(number_first ? 1 : 2);
  const auto* surface = call.argument(number_first ? 2 : 1).as<Surface>();
  if (surface == nullptr || !factor.is_number())
    refuse("the sides are " + call.argument(1).describe() + " and " + call.argument(2).describe(),
           "one must be a surface, the other a plain number");
  return {object(times(*surface, factor.number()))};
}
Values part_of(Call& call) {
  const auto* surface = call.argument(1).as<Surface>();
  if (surface == nullptr || !call.argument(2).is_number())
    refuse("the sides are " + call.argument(1).describe() + " and " + call.argument(2).describe(),
           "a surface can be divided by a plain number");
  return {object(over(*surface, call.argument(2).number()))};
}

struct CropKeys {
  std::optional<double> size_x, size_y;
  int nx = 0, ny = 0;
  double x = 0, y = 0;
};
const Block<CropKeys> crop_block{
    {pair_option("size", &CropKeys::size_x, &CropKeys::size_y, dimension::length, above(0),
                 "size of the part, taken to whole cells; or give cells"),
     cells_option(&CropKeys::nx, &CropKeys::ny),
     quantity("x", &CropKeys::x, dimension::length, at_least(0),
              "lower left corner of the part, taken to the nearest node"),
     quantity("y", &CropKeys::y, dimension::length, at_least(0),
              "lower left corner of the part, taken to the nearest node")},
    [](CropKeys& keys, Problems& problems) {
      if ((keys.nx > 0) == keys.size_x.has_value())
        problems.push_back("give `size` or `cells`, one of the two");
    }};
Values crop(Call& call) {
  const CropKeys keys = call.options(crop_block);
  const Surface& s = call.self<Surface>();
  const double size_x = keys.size_x ? *keys.size_x : keys.nx * s.grid().hx();
  const double size_y = keys.size_y ? *keys.size_y : keys.ny * s.grid().hy();
  Surface part = cropped_to(s, keys.x, keys.y, size_x, size_y);
  const Grid &whole = s.grid(), &found = part.grid();
  if (std::abs(found.size_x - size_x) > 1e-6 * whole.hx() ||
      std::abs(found.size_y - size_y) > 1e-6 * whole.hy())
    call.session().monitor().warn(
        where(call.L) + "cropped: `size` is not a whole number of cells, so the part is " +
        format_quantity(found.size_x, dimension::length) + " x " +
        format_quantity(found.size_y, dimension::length) + "; give `cells` to choose it exactly");
  return {object(std::move(part))};
}

struct CellKeys {
  int nx = 0, ny = 0;
};
const Block<CellKeys> resample_block{{cells_option(&CellKeys::nx, &CellKeys::ny).required()}};
struct WithKeys {
  std::optional<Material> material;
};
const Block<WithKeys> with_block{{material_key(&WithKeys::material).required()}};
struct ProfileKeys {
  std::optional<double> row, column;
  std::optional<Point> from, to;
  std::optional<double> points;
};
Option<ProfileKeys> point_key(const char* name, std::optional<Point> ProfileKeys::*member,
                              const char* sentence) {
  return custom<ProfileKeys>(
      name, "{a length, a length}", sentence,
      [member](const Argument& value, const OptionInfo& info, ProfileKeys& keys, Problems& problems) {
        OptionInfo length = info;
        length.dimension = dimension::length;
        Point& point = (keys.*member).emplace();
        detail::read_pair(value, info, "a point {x, y}", problems, [&](const Argument& part, bool first) {
          if (auto v = detail::read_quantity(part, length, any(), problems)) (first ? point.x : point.y) = *v;
        });
      });
}
const Block<ProfileKeys> profile_block{
    {number("row", &ProfileKeys::row, at_least(0), "row j, a profile along x"),
     number("column", &ProfileKeys::column, at_least(0), "column i, a profile along y"),
     point_key("from", &ProfileKeys::from, "where a straight line begins, {x, y}"),
     point_key("to", &ProfileKeys::to, "where it ends"),
     number("points", &ProfileKeys::points, between(2, 1 << 24), "heights on the line, both ends included")},
    [](ProfileKeys& keys, Problems& problems) {
      const int given = (keys.row ? 1 : 0) + (keys.column ? 1 : 0) + (keys.from || keys.to ? 1 : 0);
      if (given != 1) problems.push_back("give `row`, or `column`, or `from` and `to`");
      if (keys.from.has_value() != keys.to.has_value()) problems.push_back("`from` and `to` go together");
    }};
Values profile(Call& call) {
  const ProfileKeys keys = call.options(profile_block);
  const Surface& s = call.self<Surface>();
  if (keys.row) return {object(profile_row(s, *keys.row))};
  if (keys.column) return {object(profile_column(s, *keys.column))};
  return {object(profile_between(s, *keys.from, *keys.to, keys.points))};
}

struct ProfilesKeys {
  LineDirection along = LineDirection::x;
};
const Block<ProfilesKeys> profiles_block{{choice(
    "along", &ProfilesKeys::along, {{"x", LineDirection::x}, {"y", LineDirection::y}}, "rows or columns")}};
}  // namespace

// data table
std::vector<Function> surface_operations() {
  return {
      {.name = "scaled",
       .body = scale,
       .sentence = "Stretched in height to an amplitude, rms height or Ra.",
       .options = &scale_block,
       .returns = "Surface",
       .example = "s:scaled{ amplitude=\"1 um\" }"},
      {.name = "shifted",
       .body = method([](const Surface& s, Call& call) {
         const SurfaceShiftKeys keys = call.options(shift_surface_block);
         return shifted(s, keys.x, keys.y);
       }),
       .sentence =
           "Moved along x and y, cyclically: whole cells exactly, fractions of a cell on periodic surfaces.",
       .options = &shift_surface_block,
       .returns = "Surface",
       .example = "s:shifted{ x=\"10 um\" }"},
      {.name = "rotated",
       .body = method([](const Surface& s, Call& call) {
         return rotated(s, call.quantity(1, "angle", dimension::angle));
       }),
       .sentence =
           "Turned counter-clockwise seen from above: quarter turns exactly, other angles by "
           "interpolation, which takes from short waves: there and back Rq falls by 0.02 % at waves of 16 "
           "cells, 0.2 % at 8 and 3 % at 4. Points interpolated from an unmeasured point are missing.",
       .parameters = {{"angle", "an angle", "to turn by"}},
       .returns = "Surface",
       .example = "s:rotated \"90 deg\""},
      {.name = "mirrored",
       .body = method([](const Surface& s) { return mirrored(s); }),
       .sentence = "Node i becomes node nx-1-i.",
       .returns = "Surface",
       .example = "s:mirrored()"},
      {.name = "cropped",
       .body = crop,
       .sentence = "A rectangular part.",
       .options = &crop_block,
       .returns = "Surface",
       .example = "s:cropped{ size=\"100 um\", x=\"20 um\" }"},
      {.name = "resampled",
       .body = method([](const Surface& s, Call& call) {
         const CellKeys keys = call.options(resample_block);
         return resampled(s, keys.nx, keys.ny);
       }),
       .sentence =
           "The same surface on other cells: through the spectrum if periodic, else by cubic interpolation, "
           "as it is wherever there are points not measured; where that touches one there is none.",
       .options = &resample_block,
       .returns = "Surface",
       .example = "s:resampled{ cells=512 }"},
      {.name = "plus",
       .body = method([](const Surface& s, Call& call) { return plus(s, call.object<Surface>(1, "other")); }),
       .sentence = "The sum of two surfaces of equal cells and size; a point unmeasured on either surface "
                   "is missing in the sum.",
       .parameters = {{"other", "Surface", "the surface to add"}},
       .returns = "Surface",
       .example = "s:plus(fine)"},
      {.name = "minus",
       .body =
           method([](const Surface& s, Call& call) { return minus(s, call.object<Surface>(1, "other")); }),
       .sentence = "The difference of two surfaces of equal cells and size: heights less those of the "
                   "other. A point unmeasured on either surface is missing in the difference.",
       .parameters = {{"other", "Surface", "the surface to subtract"}},
       .returns = "Surface",
       .example = "local worn = s:minus(fine)"},
      {.name = "cut",
       .body = method([](const Surface& s, Call& call) { return cut(s, call.options(cut_block).fraction); }),
       .sentence =
           "Heights above a plane brought down to it; the tile keeps its size, which `cropped` changes.",
       .options = &cut_block,
       .returns = "Surface",
       .example = "s:cut{ fraction=0.2 }"},
      {.name = "with",
       .body = method(
           [](const Surface& s, Call& call) { return s.with_material(*call.options(with_block).material); }),
       .sentence = "The same heights of another material.",
       .options = &with_block,
       .returns = "Surface",
       .example = "s:with{ material=lab.material \"quartz\" }"},
      {.name = "profile",
       .body = profile,
       .sentence = "Heights along a row, a column or a straight line.",
       .options = &profile_block,
       .returns = "Profile",
       .example = "local p = s:profile{ row=0 }"},
      {.name = "profiles",
       .body = method(
           [](const Surface& s, Call& call) { return profiles(s, call.options(profiles_block).along); }),
       .sentence = "Every row or every column as a profile.",
       .options = optional(profiles_block),
       .returns = "Profile[]",
       .example = "for _, p in ipairs(s:profiles{ along=\"y\" }) do print(p:roughness().Ra) end"},
  };
}

std::vector<Operator> surface_operators() {
  return {{.event = "__add",
           .form = "a + b",
           .operand = "Surface",
           .sentence = "The sum of two surfaces, as plus gives it.",
           .returns = "Surface",
           .example = "local both = s + fine",
           .body = [](Call& call) { return of_two_surfaces(call, plus); }},
          {.event = "__sub",
           .form = "a - b",
           .operand = "Surface",
           .sentence = "The difference of two surfaces, as minus gives it.",
           .returns = "Surface",
           .example = "local worn = s - fine",
           .body = [](Call& call) { return of_two_surfaces(call, minus); }},
          {.event = "__unm",
           .form = "-a",
           .sentence = "The surface with every height of the other sign.",
           .returns = "Surface",
           .example = "local below = -s",
           .body = method([](const Surface& s) { return times(s, -1); })},
          {.event = "__mul",
           .form = "a * 2",
           .operand = "number",
           .sentence = "The surface with every height times a plain number, on either side: 2 * a.",
           .returns = "Surface",
           .example = "local steep = 2 * s",
           .body = multiple_of},
          {.event = "__div",
           .form = "a / 2",
           .operand = "number",
           .sentence = "The surface with every height divided by a plain number.",
           .returns = "Surface",
           .example = "local middle = (s + fine) / 2",
           .body = part_of}};
}

}  // namespace asperity::lua
