// SPDX-License-Identifier: GPL-3.0-or-later
// The methods and fields of a surface.
#include "bindings/lua/catalogue.hpp"
#include "bindings/lua/files.hpp"
#include "bindings/lua/grid_keys.hpp"
#include "bindings/lua/measure.hpp"
#include "bindings/lua/picture.hpp"
#include "bindings/lua/session.hpp"
#include "bindings/lua/surface.hpp"
#include "engine/metrology/levelling.hpp"
#include "engine/surface/io/write.hpp"
#include "engine/surface/operations.hpp"

namespace asperity::lua {

namespace {

Values height(Call& call) { return {call.self<Surface>().height(call.number(1, "i"), call.number(2, "j"))}; }

Values heights(Call& call) {
  const Surface surface = call.self<Surface>();
  // The field lives in the surface; the pointer shares its ownership.
  auto holder = std::make_shared<const Surface>(surface);
  return {Value::Rows(holder, &holder->heights())};
}

Values roughness_of(Call& call) { return {roughness_record(roughness(call.self<Surface>()), true)}; }

Values spectrum_of(Call& call) {
  return {spectrum_record(spectrum(call.self<Surface>(), call.options(spectrum_block())), true)};
}

Values fractal_dimension_of(Call& call) {
  return {fractal_dimension_record(
      fractal_dimension(call.self<Surface>(), call.options(fractal_dimension_block(true))))};
}

Values filtered(Call& call) {
  return {object(gaussian_filtered(call.self<Surface>(), call.options(filter_block())))};
}
Values level(Call& call) {
  return {object(levelled(call.self<Surface>(), call.options(level_block()).degree))};
}

// --- operations

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
const Block<ShiftKeys>& shift_block() {
  static const Block<ShiftKeys> block{
      "shifted",
      {quantity("x", &ShiftKeys::x, dimension::length, any(), "way along x"),
       quantity("y", &ShiftKeys::y, dimension::length, any(), "way along y")}};
  return block;
}
Values shift(Call& call) {
  const ShiftKeys keys = call.options(shift_block());
  return {object(shifted(call.self<Surface>(), keys.x, keys.y))};
}

Values rotate(Call& call) {
  return {object(rotated(call.self<Surface>(), call.quantity(1, "angle", dimension::angle)))};
}
Values mirror(Call& call) { return {object(mirrored(call.self<Surface>()))}; }
Values add(Call& call) { return {object(plus(call.self<Surface>(), call.object<Surface>(1, "other")))}; }
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
                                           "size of the part; or give cells"),
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
  return {object(cropped_to(s, keys.x, keys.y, size_x, size_y))};
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

// --- lines

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

// --- files

Values write(Call& call) {
  const std::string path = writable_path(call, call.text(1, "path"));
  write_surface(call.self<Surface>(), path, call.session().monitor());
  return {path};
}

Values picture(Call& call) {
  const PictureOptions options = call.options(picture_block(), 2);
  const std::string path = writable_path(call, call.text(1, "path"));
  draw(call.self<Surface>(), options, path);
  return {path};
}

std::string describe(const void* self) {
  const auto& s = *static_cast<const Surface*>(self);
  const Grid& g = s.grid();
  std::string text = "surface " + std::to_string(g.nx) + " x " + std::to_string(g.ny) + " cells, " +
                     format_quantity(g.size_x, dimension::length) + " x " +
                     format_quantity(g.size_y, dimension::length) + ", peak to valley " +
                     format_quantity(s.peak_to_valley(), dimension::length);
  if (s.material()) text += ", " + s.material()->name;
  return text;
}

std::size_t native_bytes(const void* self) {
  return static_cast<const Surface*>(self)->heights().size() * sizeof(double);
}
bool equal(const void* a, const void* b) {
  return static_cast<const Surface*>(a)->digest() == static_cast<const Surface*>(b)->digest();
}
std::string digest(const void* self) { return static_cast<const Surface*>(self)->digest(); }

}  // namespace

const Class& surface_class() {
  static const Class type = [] {
    Class c;
    c.name = "Surface";
    c.article_name = "a surface";
    c.sentence = "Heights on a regular grid of cells; an immutable value whose methods return new ones.";
    c.describe = describe;
    c.native_bytes = native_bytes;
    c.equal = equal;
    c.digest = digest;
    c.fields = {
        {"cells",
         "{nx, ny}",
         "cells along x and y",
         {},
         [](Call& call) -> Values {
           const Grid& g = call.self<Surface>().grid();
           return {List{{g.nx, g.ny}}};
         }},
        {"size", "{number, number}", "length along x and y", dimension::length,
         [](Call& call) -> Values {
           const Grid& g = call.self<Surface>().grid();
           return {List{{g.size_x, g.size_y}}};
         }},
        {"material",
         "Material",
         "what the body is made of, or nil",
         {},
         [](Call& call) -> Values {
           const auto& m = call.self<Surface>().material();
           return {m ? object(*m) : Value()};
         }},
        {"periodic",
         "boolean",
         "whether the heights continue smoothly across the rim",
         {},
         [](Call& call) -> Values { return {call.self<Surface>().traits().periodic}; }},
        {"aliased_share",
         "number",
         "share of the variance past Nyquist; nil where it is not known",
         {},
         [](Call& call) -> Values { return {Value(call.self<Surface>().traits().aliased_share)}; }},
        {"peak_to_valley", "number", "greatest less least height", dimension::length,
         [](Call& call) -> Values { return {call.self<Surface>().peak_to_valley()}; }},
        {"digest",
         "string",
         "of grid and heights: equal surfaces have equal digests",
         {},
         [](Call& call) -> Values { return {call.self<Surface>().digest()}; }},
    };
    c.methods = {
        {.name = "height",
         .body = height,
         .sentence = "Height of node (i, j) in metres, counted from 0.",
         .parameters = {{"i", "integer", "along x"}, {"j", "integer", "along y"}},
         .returns = "number",
         .example = "s:height(0, 0)"},
        {.name = "heights",
         .body = heights,
         .sentence = "All heights as a table of rows, heights[j+1][i+1].",
         .returns = "number[][]",
         .example = "local h = s:heights()"},
        {.name = "roughness",
         .body = roughness_of,
         .sentence =
             "Amplitude and slope statistics of all nodes (ISO 25178-2), nothing levelled or filtered first.",
         .returns = "table",
         .example = "print(s:roughness().Ra)"},
        {.name = "spectrum",
         .body = spectrum_of,
         .sentence = "Radially averaged power spectral density.",
         .options = &spectrum_block(),
         .options_optional = true,
         .returns = "table",
         .example = "local c = s:spectrum().C"},
        {.name = "fractal_dimension",
         .body = fractal_dimension_of,
         .sentence = "Fractal dimension of the profiles of the surface, with its scatter over them.",
         .options = &fractal_dimension_block(true),
         .options_optional = true,
         .returns = "table",
         .example = "print(s:fractal_dimension{ method=\"structure\" }.D)"},
        {.name = "filtered",
         .body = filtered,
         .sentence = "ISO 16610 Gaussian filter.",
         .options = &filter_block(),
         .returns = "Surface",
         .example = "s:filtered{ short_wave=\"2.5 um\", long_wave=\"0.8 mm\" }"},
        {.name = "scaled",
         .body = scale,
         .sentence = "Stretched in height to an amplitude, rms height or Ra.",
         .options = &scale_block(),
         .returns = "Surface",
         .example = "s:scaled{ amplitude=\"1 um\" }"},
        {.name = "shifted",
         .body = shift,
         .sentence = "Moved along x and y, cyclically: whole cells exactly, fractions of a cell on periodic "
                     "surfaces.",
         .options = &shift_block(),
         .returns = "Surface",
         .example = "s:shifted{ x=\"10 um\" }"},
        {.name = "rotated",
         .body = rotate,
         .sentence = "Turned counter-clockwise seen from above: quarter turns exactly, other angles by "
                     "interpolation.",
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
         .sentence = "The same surface on other cells: through the spectrum if periodic, else by cubic "
                     "interpolation.",
         .options = &resample_block(),
         .returns = "Surface",
         .example = "s:resampled{ cells=512 }"},
        {.name = "plus",
         .body = add,
         .sentence = "The sum of two surfaces of equal cells and size.",
         .parameters = {{"other", "Surface", "what to add"}},
         .returns = "Surface",
         .example = "s:plus(fine)"},
        {.name = "cut",
         .body = cut_off,
         .sentence = "Heights above a plane brought down to it.",
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
        {.name = "write",
         .body = write,
         .sentence = "Writes the heights: .npy, .x3p, .txt, .asc or .csv by the extension of the path.",
         .parameters = {{"path", "string", "under the run directory"}},
         .returns = "string",
         .example = "s:write \"specimen.x3p\"",
         .heavy = true},
        {.name = "picture",
         .body = picture,
         .sentence = "A picture of the heights as PNG, true to scale, with scale and colour bars.",
         .parameters = {{"path", "string", "a .png under the run directory"}},
         .options = &picture_block(),
         .options_optional = true,
         .returns = "string",
         .example = "s:picture(\"surface.png\", { title=\"D = 2.5\" })",
         .heavy = true},
        {.name = "levelled",
         .body = level,
         .sentence = "Less the least-squares polynomial of a degree.",
         .options = &level_block(),
         .options_optional = true,
         .returns = "Surface",
         .example = "s:levelled{ degree=1 }"},
    };
    return c;
  }();
  return type;
}

template <>
const Class& class_of<Surface>() {
  return surface_class();
}

}  // namespace asperity::lua
