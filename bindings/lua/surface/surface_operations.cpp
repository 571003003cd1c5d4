// SPDX-License-Identifier: GPL-3.0-or-later
// Methods and operators that return surfaces and profiles.
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/surface/grid_keys.hpp"
#include "bindings/lua/surface/measure.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/surface/operations/operations.hpp"

namespace asperity::lua {

namespace {

struct ScaleKeys {
  std::optional<double> amplitude, rms, ra;
  ScaleAbout about = ScaleAbout::mean;
};
const Block<ScaleKeys>& scale_block() {
  using K = ScaleKeys;
  static const Block<K> block{
      "scaled",
      {quantity("amplitude", &K::amplitude, dimension::length, at_least(0), "peak to valley to reach"),
       quantity("rms", &K::rms, dimension::length, at_least(0), "root mean square height to reach"),
       quantity("ra", &K::ra, dimension::length, at_least(0), "mean absolute height to reach"),
       choice("about", &K::about, {{"mean", ScaleAbout::mean}, {"base", ScaleAbout::base}},
              "what stays where it is: the mean height or the lowest point")},
      [](K& keys, Problems& problems) {
        const int given = (keys.amplitude ? 1 : 0) + (keys.rms ? 1 : 0) + (keys.ra ? 1 : 0);
        if (given != 1)
          problems.push_back("give exactly one of `amplitude`, `rms` and `ra`; " + std::to_string(given) +
                             " are given");
      }};
  return block;
}
Values scale(Call& call) {
  const ScaleKeys keys = call.options(scale_block());
  const Surface& s = call.self<Surface>();
  if (keys.amplitude) return {object(scaled(s, ScaleTo::amplitude, *keys.amplitude, keys.about))};
  if (keys.rms) return {object(scaled(s, ScaleTo::rms, *keys.rms, keys.about))};
  return {object(scaled(s, ScaleTo::ra, *keys.ra, keys.about))};
}

struct ShiftKeys {
  double x = 0, y = 0;
};
const Block<ShiftKeys>& shift_surface_block() {
  static const Block<ShiftKeys> block{
      "shifted",
      {quantity("x", &ShiftKeys::x, dimension::length, any(), "way along x"),
       quantity("y", &ShiftKeys::y, dimension::length, any(), "way along y")}};
  return block;
}
Values shift_surface(Call& call) {
  const ShiftKeys keys = call.options(shift_surface_block());
  return {object(shifted(call.self<Surface>(), keys.x, keys.y))};
}

Values rotate_surface(Call& call) {
  return {object(rotated(call.self<Surface>(), call.quantity(1, "angle", dimension::angle)))};
}
Values mirror(Call& call) { return {object(mirrored(call.self<Surface>()))}; }
Values add_surfaces(Call& call) {
  return {object(plus(call.self<Surface>(), call.object<Surface>(1, "other")))};
}
Values subtract_surfaces(Call& call) {
  return {object(minus(call.self<Surface>(), call.object<Surface>(1, "other")))};
}

Values of_two_surfaces(const Call& call, Surface (*combine)(const Surface&, const Surface&)) {
  const auto* a = call.argument(1).as<Surface>();
  const auto* b = call.argument(2).as<Surface>();
  if (a == nullptr || b == nullptr)
    throw Error(
        ErrorCode::bad_value,
        "one side is " + call.argument(a == nullptr ? 1 : 2).describe() + ", the other a surface",
        "both must be surfaces of equal cells and size; the mean height goes with `levelled{ degree=0 }`");
  return {object(combine(*a, *b))};
}
Values sum_of(Call& call) { return of_two_surfaces(call, plus); }
Values difference_of(Call& call) { return of_two_surfaces(call, minus); }
Values negative_of(Call& call) { return {object(times(call.object<Surface>(1, "a"), -1))}; }

// Factors are plain numbers: a height times a length would be an area.
Values multiple_of(Call& call) {
  const bool number_first = call.argument(1).is_number();
  const Argument factor = call.argument(number_first ? 1 : 2);
  const auto* surface = call.argument(number_first ? 2 : 1).as<Surface>();
  if (surface == nullptr || !factor.is_number())
    throw Error(ErrorCode::bad_value,
                "the sides are " + call.argument(1).describe() + " and " + call.argument(2).describe(),
                "one must be a surface, the other a plain number");
  return {object(times(*surface, factor.number()))};
}
Values part_of(Call& call) {
  const auto* surface = call.argument(1).as<Surface>();
  if (surface == nullptr || !call.argument(2).is_number())
    throw Error(ErrorCode::bad_value,
                "the sides are " + call.argument(1).describe() + " and " + call.argument(2).describe(),
                "a surface can be divided by a plain number");
  return {object(over(*surface, call.argument(2).number()))};
}

Values cut_off(Call& call) { return {object(cut(call.self<Surface>(), call.options(cut_block()).fraction))}; }

struct CropKeys {
  std::optional<double> size_x, size_y;
  int nx = 0, ny = 0;
  double x = 0, y = 0;
};
const Block<CropKeys>& crop_block() {
  using K = CropKeys;
  static const Block<K> block{"cropped",
                              {pair_option("size", &K::size_x, &K::size_y, dimension::length, above(0),
                                           "size of the part, taken to whole cells; or give cells"),
                               cells_option(&K::nx, &K::ny),
                               quantity("x", &K::x, dimension::length, at_least(0),
                                        "lower left corner of the part, taken to the nearest node"),
                               quantity("y", &K::y, dimension::length, at_least(0),
                                        "lower left corner of the part, taken to the nearest node")},
                              [](K& keys, Problems& problems) {
                                if ((keys.nx > 0) == keys.size_x.has_value())
                                  problems.push_back("give `size` or `cells`, one of the two");
                              }};
  return block;
}
Values crop(Call& call) {
  const CropKeys keys = call.options(crop_block());
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
const Block<CellKeys>& resample_block() {
  static const Block<CellKeys> block{"resampled", {cells_option(&CellKeys::nx, &CellKeys::ny).required()}};
  return block;
}
Values resample(Call& call) {
  const CellKeys keys = call.options(resample_block());
  return {object(resampled(call.self<Surface>(), keys.nx, keys.ny))};
}

struct WithKeys {
  std::optional<Material> material;
};
const Block<WithKeys>& with_block() {
  static const Block<WithKeys> block{"with", {material_key(&WithKeys::material).required()}};
  return block;
}
Values with(Call& call) {
  return {object(call.self<Surface>().with_material(*call.options(with_block()).material))};
}

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
        if (!value.is_table() || value.length() != 2)
          return detail::wrong_type(value, info, "a point {x, y}", problems);
        OptionInfo length = info;
        length.dimension = dimension::length;
        Point point;
        for (int k = 1; k <= 2; ++k)
          value.element(k, [&](const Argument& part) {
            if (auto v = detail::read_quantity(part, length, any(), problems))
              (k == 1 ? point.x : point.y) = *v;
          });
        keys.*member = point;
      });
}
const Block<ProfileKeys>& profile_block() {
  using K = ProfileKeys;
  static const Block<K> block{
      "profile",
      {number("row", &K::row, at_least(0), "row j, a profile along x"),
       number("column", &K::column, at_least(0), "column i, a profile along y"),
       point_key("from", &K::from, "where a straight line begins, {x, y}"),
       point_key("to", &K::to, "where it ends"),
       number("points", &K::points, between(2, 1 << 24), "heights on the line, both ends included")},
      [](K& keys, Problems& problems) {
        const int given = (keys.row ? 1 : 0) + (keys.column ? 1 : 0) + (keys.from || keys.to ? 1 : 0);
        if (given != 1) problems.push_back("give `row`, or `column`, or `from` and `to`");
        if (keys.from.has_value() != keys.to.has_value()) problems.push_back("`from` and `to` go together");
      }};
  return block;
}
Values profile(Call& call) {
  const ProfileKeys keys = call.options(profile_block());
  const Surface& s = call.self<Surface>();
  if (keys.row) return {object(profile_row(s, *keys.row))};
  if (keys.column) return {object(profile_column(s, *keys.column))};
  return {object(profile_between(s, *keys.from, *keys.to, keys.points))};
}

struct ProfilesKeys {
  LineDirection along = LineDirection::x;
};
const Block<ProfilesKeys>& profiles_block() {
  static const Block<ProfilesKeys> block{
      "profiles",
      {choice("along", &ProfilesKeys::along, {{"x", LineDirection::x}, {"y", LineDirection::y}},
              "rows or columns")}};
  return block;
}
Values all_profiles(Call& call) {
  List list;
  for (Profile& p : profiles(call.self<Surface>(), call.options(profiles_block()).along))
    list.items.push_back(object(std::move(p)));
  return {std::move(list)};
}

}  // namespace

// data table
std::vector<Function> surface_operations() {
  return {
      {.name = "scaled",
       .body = scale,
       .sentence = "Stretched in height to an amplitude, rms height or Ra.",
       .options = &scale_block(),
       .returns = "Surface",
       .example = "s:scaled{ amplitude=\"1 um\" }"},
      {.name = "shifted",
       .body = shift_surface,
       .sentence =
           "Moved along x and y, cyclically: whole cells exactly, fractions of a cell on periodic surfaces.",
       .options = &shift_surface_block(),
       .returns = "Surface",
       .example = "s:shifted{ x=\"10 um\" }"},
      {.name = "rotated",
       .body = rotate_surface,
       .sentence =
           "Turned counter-clockwise seen from above: quarter turns exactly, other angles by interpolation, "
           "which takes from short waves: there and back Rq falls by 0.02 % at waves of 16 cells, 0.2 % at 8 "
           "and 3 % at 4. Where it touches a point that was not measured there is none.",
       .parameters = {{"angle", "an angle", "to turn by"}},
       .returns = "Surface",
       .example = "s:rotated \"90 deg\""},
      {.name = "mirrored",
       .body = mirror,
       .sentence = "Node i becomes node nx-1-i.",
       .returns = "Surface",
       .example = "s:mirrored()"},
      {.name = "cropped",
       .body = crop,
       .sentence = "A rectangular part.",
       .options = &crop_block(),
       .returns = "Surface",
       .example = "s:cropped{ size=\"100 um\", x=\"20 um\" }"},
      {.name = "resampled",
       .body = resample,
       .sentence =
           "The same surface on other cells: through the spectrum if periodic, else by cubic interpolation, "
           "as it is wherever there are points not measured; where that touches one there is none.",
       .options = &resample_block(),
       .returns = "Surface",
       .example = "s:resampled{ cells=512 }"},
      {.name = "plus",
       .body = add_surfaces,
       .sentence = "The sum of two surfaces of equal cells and size; a point that was not measured on one of "
                   "them is none of the sum.",
       .parameters = {{"other", "Surface", "what to add"}},
       .returns = "Surface",
       .example = "s:plus(fine)"},
      {.name = "minus",
       .body = subtract_surfaces,
       .sentence = "The difference of two surfaces of equal cells and size: heights less those of the other. "
                   "A point that was not measured on one of them is none of the difference.",
       .parameters = {{"other", "Surface", "what to take away"}},
       .returns = "Surface",
       .example = "local worn = s:minus(fine)"},
      {.name = "cut",
       .body = cut_off,
       .sentence =
           "Heights above a plane brought down to it; the tile keeps its size, which `cropped` changes.",
       .options = &cut_block(),
       .returns = "Surface",
       .example = "s:cut{ fraction=0.2 }"},
      {.name = "with",
       .body = with,
       .sentence = "The same heights of another material.",
       .options = &with_block(),
       .returns = "Surface",
       .example = "s:with{ material=lab.material \"quartz\" }"},
      {.name = "profile",
       .body = profile,
       .sentence = "Heights along a row, a column or a straight line.",
       .options = &profile_block(),
       .returns = "Profile",
       .example = "local p = s:profile{ row=0 }"},
      {.name = "profiles",
       .body = all_profiles,
       .sentence = "Every row or every column as a profile.",
       .options = &profiles_block(),
       .options_optional = true,
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
           .body = sum_of},
          {.event = "__sub",
           .form = "a - b",
           .operand = "Surface",
           .sentence = "The difference of two surfaces, as minus gives it.",
           .returns = "Surface",
           .example = "local worn = s - fine",
           .body = difference_of},
          {.event = "__unm",
           .form = "-a",
           .sentence = "The surface with every height of the other sign.",
           .returns = "Surface",
           .example = "local below = -s",
           .body = negative_of},
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
