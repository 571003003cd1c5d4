// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "bindings/lua/surface/surface_keys.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/generators/bead_blasted.hpp"
#include "engine/surface/generators/grain_profile.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"
#include "engine/surface/io/format.hpp"

namespace asperity::lua {

const Block<SineKeys> sine_block{
    {cells_key().required(), size_key().required(),
     quantity("amplitude", &SineOptions::amplitude, dimension::length, at_least(0),
              "height of a crest above the mean")
         .required(),
     quantity("wavelength", &SineOptions::wavelength, dimension::length, above(0), "length of a wave")
         .defaults_to("size"),
     integer("directions", &SineOptions::directions, between(1, 2),
             "1: cos along x; 2: cos along x times cos along y"),
     material_key()},
    [](SineKeys& keys, Problems&) {
      keys.grid = keys.make();
      (void)sine_factors(keys);
    }};
const Block<SelfAffineKeys> self_affine_block{
    {cells_key().required(), size_key().required(),
     number("hurst", &SelfAffineOptions::hurst, {0, 1, true, false, false}, "Hurst exponent H; D = 3 - H")
         .required(),
     quantity("rms_height", &SelfAffineOptions::rms_height, dimension::length, above(0),
              "root mean square height; or give rms_slope or ra"),
     number("rms_slope", &SelfAffineOptions::rms_slope, above(0),
            "spectral root mean square slope; or give rms_height or ra"),
     quantity("ra", &SelfAffineOptions::ra, dimension::length, above(0),
              "mean absolute height; or give rms_height or rms_slope"),
     quantity("long_wave", &SelfAffineOptions::long_wave, dimension::length, above(0), "longest wave")
         .defaults_to("size"),
     quantity("roll_off", &SelfAffineOptions::roll_off, dimension::length, above(0),
              "wave above which the spectrum is flat")
         .defaults_to("long_wave"),
     quantity("short_wave", &SelfAffineOptions::short_wave, dimension::length, above(0),
              "shortest wave, at least two cells")
         .required(),
     integer("seed", &SelfAffineOptions::seed, at_least(0), "of the random waves"), material_key()},
    [](SelfAffineKeys& keys, Problems& problems) {
      const int given = (keys.rms_height ? 1 : 0) + (keys.rms_slope ? 1 : 0) + (keys.ra ? 1 : 0);
      if (given != 1)
        problems.push_back(
            "give exactly one of `rms_height`, `rms_slope` and `ra`, which sets the amplitude; " +
            std::to_string(given) + " are given");
      keys.grid = keys.make();
      if (problems.empty()) require_makeable(keys);
    }};
const Block<GridKeys> flat_block{{cells_key().required(), size_key().required(), material_key()}};
const Block<GridKeys> from_function_block{
    {cells_key().required(), size_key().required(),
     function<GridKeys>("height", "a function(x, y)", "function(x, y) returning the height, all in metres")
         .required(),
     material_key()}};

namespace {

Values result(Surface surface, const std::optional<Material>& material) {
  return {object(material ? surface.with_material(*material) : std::move(surface))};
}

// Result of a generator whose keys extend its options.
template <const auto& block, auto generate>
Values made(Call& call) {
  const auto keys = call.options(block);
  return result(generate(keys, call.session().monitor()), keys.body_material);
}

const Block<WeierstrassMandelbrotOptions> weierstrass_mandelbrot_block{
    weierstrass_mandelbrot_keys<WeierstrassMandelbrotOptions>()};

Values weierstrass_mandelbrot_body(Call& call) {
  WeierstrassMandelbrotOptions keys = call.options(weierstrass_mandelbrot_block);
  const Argument table = call.argument(1);
  if (keys.phases == WavePhases::function) {
    keys.phase_function = [&](int m, int n) {
      return with_key(table, "phases", [&](const Argument& function) {
        return Callback(function)({static_cast<std::int64_t>(m), static_cast<std::int64_t>(n)}, "phases");
      });
    };
  }
  return {object(weierstrass_mandelbrot(keys, call.session().monitor()))};
}

Values flat_body(Call& call) {
  const GridKeys keys = call.options(flat_block);
  return result(flat_surface({keys.make()}, call.session().monitor()), keys.body_material);
}

struct SphereKeys : GridKeys, SphereOptions {};
const Block<SphereKeys> sphere_block{
    {cells_key().required(), size_key().required(),
     quantity("radius", &SphereOptions::radius, dimension::length, above(0), "radius of curvature")
         .required(),
     choice("shape", &SphereOptions::shape,
            {{"sphere", SphereShape::sphere}, {"paraboloid", SphereShape::paraboloid}},
            "a true sphere, or the paraboloid r^2/2R of the same curvature"),
     material_key()},
    [](SphereKeys& keys, Problems&) {
      keys.grid = keys.make();
      require_makeable(keys);
    }};

const Block<BlastTexture> texture_block{
    {number("hurst", &BlastTexture::hurst, {0, 1, true, false, false}, "Hurst exponent of the texture"),
     quantity("roll_off", &BlastTexture::roll_off, dimension::length, above(0),
              "wave above which its spectrum is flat"),
     quantity("short_wave", &BlastTexture::short_wave, dimension::length, above(0),
              "its shortest wave, at least two cells, better six"),
     number("share", &BlastTexture::share, {0, 1, true, false, false}, "its Ra as a fraction of `ra`")}};

struct BeadBlastedKeys : GridKeys, BeadBlastedOptions {
  BlastTexture texture;
};
Option<BeadBlastedKeys> fine_option() {
  using K = BeadBlastedKeys;
  auto fine = table_of<K>("fine", &K::texture, texture_block,
                          "the fine self-affine texture on top of the dents; false leaves it out");
  fine.info.type = "table|false";
  fine.read = [table = fine.read](const Argument& value, const OptionInfo& info, K& keys,
                                  Problems& problems) {
    if (value.is_boolean() && !value.boolean()) {
      keys.fine.reset();
    } else if (!value.is_table()) {
      detail::wrong_type(value, info, "a table of named keys, or false for none", problems);
    } else {
      table(value, info, keys, problems);
      keys.fine = keys.texture;
    }
  };
  fine.show = [](const K& keys) -> std::string {
    if (!keys.fine) return "false";
    const BlastTexture& t = *keys.fine;
    return "{ hurst=" + format_exact(t.hurst) + ", roll_off=" + format_exact(t.roll_off) +
           ", short_wave=" + format_exact(t.short_wave) + ", share=" + format_exact(t.share) + " }";
  };
  return std::move(fine).defaults_to("{}");
}
const Block<BeadBlastedKeys> bead_blasted_block{
    {cells_key().required(), size_key().required(),
     quantity("ra", &BeadBlastedOptions::ra, dimension::length, above(0), "mean absolute height, met exactly")
         .required(),
     pair_option("bead", &BeadBlastedOptions::bead_low, &BeadBlastedOptions::bead_high, dimension::length,
                 above(0), "diameters of the beads, uniform between the two")
         .defaults_to("{\"250 um\", \"300 um\"}"),
     pair_option("dent", &BeadBlastedOptions::dent_low, &BeadBlastedOptions::dent_high, dimension::length,
                 above(0), "radii of the dents, uniform between the two")
         .defaults_to("{\"25 um\", \"60 um\"}"),
     number("coverage", &BeadBlastedOptions::coverage, above(0),
            "area of all dents over that of the surface"),
     fine_option(), integer("seed", &BeadBlastedOptions::seed, at_least(0), "of the dents and the texture"),
     material_key()},
    [](BeadBlastedKeys& keys, Problems&) {
      keys.grid = keys.make();
      require_makeable(keys);
    }};

const Block<GrainProfileOptions> grain_profile_block{
    {quantity("radius", &GrainProfileOptions::radius, dimension::length, above(0), "mean radius of the grain")
         .required(),
     number("D", &GrainProfileOptions::D, inside(1, 2), "fractal dimension of the outline").required(),
     number("amplitude", &GrainProfileOptions::amplitude, {0, 1, false, true, false},
            "greatest deviation as a fraction of the radius"),
     integer("points", &GrainProfileOptions::points, between(7, 1 << 24), "points on the outline").required(),
     number("gamma", &GrainProfileOptions::gamma, above(1), "ratio of neighbouring wave numbers"),
     integer("seed", &GrainProfileOptions::seed, at_least(0), "of the random phases")}};
Values grain_profile_body(Call& call) {
  return {object(grain_profile(call.options(grain_profile_block), call.session().monitor()))};
}

Field heights_of(const Callback& height, const Grid& grid, Monitor& monitor) {
  Field heights(grid.nx, grid.ny);
  Task task(monitor, "heights from a function", grid.ny);
  for (int j = 0; j < grid.ny; ++j, task.advance())
    for (int i = 0; i < grid.nx; ++i) heights(i, j) = height({i * grid.hx(), j * grid.hy()}, "height");
  return heights;
}

// A script function in a recipe. Only native calls from the same state may call it; it must return equal
// heights at equal places.
class HeldFunction {
 public:
  HeldFunction(const Argument& function, const Grid& grid, const Field& heights)
      : held_(Session::of(function.state()).held_functions),
        grid_(grid),
        x_(grid.nx / 2 * grid.hx()),
        y_(grid.ny / 2 * grid.hy()),
        height_(heights(grid.nx / 2, grid.ny / 2)) {
    lua_State* L = function.state();
    const Argument::StackGuard guard(L);
    const std::lock_guard lock(held_->mutex);
    for (const int gone : held_->released) luaL_unref(L, LUA_REGISTRYINDEX, gone);
    held_->released.clear();
    lua_pushcfunction(L, [](lua_State* in) {
      lua_pushinteger(in, luaL_ref(in, LUA_REGISTRYINDEX));
      return 1;
    });
    lua_pushvalue(L, function.index());
    if (lua_pcall(L, 1, 1, 0) != LUA_OK) throw std::bad_alloc();
    place_ = static_cast<int>(lua_tointeger(L, -1));
  }
  ~HeldFunction() {
    const std::lock_guard lock(held_->mutex);
    held_->released.push_back(place_);
  }
  HeldFunction(const HeldFunction&) = delete;
  HeldFunction& operator=(const HeldFunction&) = delete;

  Surface surface(int nx, int ny, Monitor& monitor) const {
    const Session::Running* const now = Session::Running::innermost;
    if (now == nullptr || now->session.held_functions != held_)
      refuse("only its own script can call a function");
    const Argument::StackGuard guard(now->L);
    lua_rawgeti(now->L, LUA_REGISTRYINDEX, place_);
    const Callback height{Argument(now->L, -1)};
    if (height({x_, y_}, "height") != height_)
      refuse("the function `height` gave another height at the same place");
    const Grid grid = make_grid(nx, ny, grid_.size_x, grid_.size_y);
    return {grid, heights_of(height, grid, monitor)};
  }

 private:
  std::shared_ptr<Session::HeldFunctions> held_;
  Grid grid_;
  double x_, y_, height_;
  int place_ = 0;
};

Values from_function_body(Call& call) {
  const GridKeys keys = call.options(from_function_block);
  const Grid grid = keys.make();
  return with_key(call.argument(1), "height", [&](const Argument& function) -> Values {
    Field heights = heights_of(Callback(function), grid, call.session().monitor());
    const auto held = std::make_shared<const HeldFunction>(function, grid, heights);
    return result(Surface(grid, std::move(heights)).made_by([held](int nx, int ny, Monitor& monitor) {
      return held->surface(nx, ny, monitor);
    }),
                  keys.body_material);
  });
}

const Block<GridKeys> from_table_block{
    {size_key().required(),
     custom<GridKeys>("heights", "number[][]", "rows of heights in metres, heights[j+1][i+1]",
                      [](const Argument& value, const OptionInfo& info, GridKeys& keys, Problems& problems) {
                        if (!value.is_table() || value.length() == 0)
                          return detail::wrong_type(value, info, "a table of rows of numbers", problems);
                        keys.ny = static_cast<int>(std::min<std::int64_t>(value.length(), max_cells + 1));
                        value.element(1, [&](const Argument& row) {
                          if (!row.is_table() || row.length() == 0) {
                            problems.push_back(quoted(info.name) +
                                               " must be rows of numbers, heights[j+1][i+1], and " +
                                               (row.is_table() ? "its first row is empty"
                                                               : "its first element is " + row.describe()) +
                                               "; of one row write { { 1, 2, 3 } }");
                          } else {
                            keys.nx = static_cast<int>(std::min<std::int64_t>(row.length(), max_cells + 1));
                          }
                        });
                      })
         .required(),
     material_key()}};
Values from_table_body(Call& call) {
  const GridKeys keys = call.options(from_table_block);
  const Grid grid = keys.make();
  Field heights(grid.nx, grid.ny);
  with_key(call.argument(1), "heights", [&](const Argument& rows) {
    for (int j = 0; j < grid.ny; ++j) {
      stop_flag().check();
      rows.element(j + 1, [&](const Argument& row) {
        if (!row.is_table() || row.length() != grid.nx)
          refuse("row " + std::to_string(j + 1) + " of `heights` is " +
                     (row.is_table() ? "a table of " + std::to_string(row.length()) : row.describe()),
                 "every row must have " + std::to_string(grid.nx) + " heights, as the first has");
        for (int i = 0; i < grid.nx; ++i)
          row.element(i + 1, [&](const Argument& height) {
            if (!height.is_number())
              refuse("heights[" + std::to_string(j + 1) + "][" + std::to_string(i + 1) + "] is " +
                         height.describe(),
                     "give a number of metres");
            heights(i, j) = height.number();
          });
      });
    }
  });
  return result(Surface(grid, std::move(heights)), keys.body_material);
}

Listing formats_listing() {
  Listing listing{
      "Formats", {"format", "endings", "read", "refused", "checked against", "first line stored"}, {}};
  for (const Format* format : formats()) {
    std::vector<std::string> endings;
    for (const std::string_view ending : format->extensions) endings.push_back("." + std::string(ending));
    const FormatAccount& account = format->account;
    listing.rows.push_back({std::string(format->name), joined(endings, ", "), std::string(account.read),
                            std::string(account.refused), std::string(account.checked),
                            std::string(format->lines.first == FirstLine::top ? "top. " : "bottom. ") +
                                std::string(format->lines.source)});
  }
  return listing;
}

const Block<ReadOptions> read_block{
    {pair_option("size", &ReadOptions::size_x, &ReadOptions::size_y, dimension::length, above(0),
                 "size of the map, where the file has none"),
     unit_key(&ReadOptions::unit), unit_xy_key(&ReadOptions::unit_xy), fill_key(&ReadOptions::fill),
     format_key(&ReadOptions::format), channel_key(&ReadOptions::channel),
     material_key(&ReadOptions::material)}};
}  // namespace

// data table
Module surface_module() {
  Module m{"lab.surface", "Rough surfaces: generated, from functions and tables, or read from files."};
  auto add = [&](const char* name, Body body, const char* sentence, const BlockInfo& block,
                 const char* returns, const char* example) {
    m.functions.push_back({.name = name,
                           .body = body,
                           .sentence = sentence,
                           .options = &block,
                           .returns = returns,
                           .example = example,
                           .heavy = true});
  };
  add("weierstrass_mandelbrot", weierstrass_mandelbrot_body,
      "The fractal surface of the source paper, a sum of cosine waves (Yan and Komvopoulos 1998; Hanaor, Gan "
      "and Einav 2013, eq. 2), with exact phases.",
      weierstrass_mandelbrot_block, "Surface",
      "local s = lab.surface.weierstrass_mandelbrot{ cells=150, D=2.5, seed=1 }");
  add("self_affine", made<self_affine_block, self_affine_surface>,
      "A Gaussian surface with power-law spectrum, flat below the roll-off; rms height, rms slope or Ra is "
      "met exactly.",
      self_affine_block, "Surface",
      "local s = lab.surface.self_affine{ cells=256, size=\"1 mm\", hurst=0.8, rms_height=\"1 um\", "
      "short_wave=\"16 um\" }");
  add("bead_blasted", made<bead_blasted_block, bead_blasted_surface>,
      "A surface blasted with glass beads, as the specimens of the source paper: overlapping dents with "
      "piled-up rims, and a fine self-affine texture.",
      bead_blasted_block, "Surface",
      "local s = lab.surface.bead_blasted{ cells=512, size=\"1 mm\", ra=\"3 um\" }");
  add("flat", flat_body, "A flat surface at height 0.", flat_block, "Surface",
      "local s = lab.surface.flat{ cells=64, size=\"1 mm\" }");
  add("sine", made<sine_block, sine_surface>,
      "A cosine wave along x, or the product of two such waves, along x and along y; crest at node 0.",
      sine_block, "Surface", "local s = lab.surface.sine{ cells=64, size=\"1 mm\", amplitude=\"1 um\" }");
  add("sphere", made<sphere_block, sphere_surface>,
      "A sphere or paraboloid with its apex at node (nx//2, ny//2), height 0.", sphere_block, "Surface",
      "local s = lab.surface.sphere{ cells=128, size=\"1 mm\", radius=\"10 mm\" }");
  add("grain_profile", grain_profile_body,
      "The outline of a quasi-spherical grain with fractal roughness (the source paper's Fig. 1), as a "
      "closed profile.",
      grain_profile_block, "Profile",
      "local g = lab.surface.grain_profile{ radius=\"100 um\", D=1.3, points=2048 }");
  add("from_function", from_function_body, "Heights from a function of x and y.", from_function_block,
      "Surface",
      "local s = lab.surface.from_function{ cells=64, size=1e-3, height=function(x, y) return 1e-6 * x / "
      "1e-3 end }");
  add("from_table", from_table_body, "Heights from a table of rows; the first row is j = 0.",
      from_table_block, "Surface",
      "local s = lab.surface.from_table{ size=1e-3, heights={ {0, 1e-6}, {2e-6, 0} } }");
  m.functions.push_back(
      {.name = "read",
       .body = read_file<read_block, read_surface>,
       .sentence =
           "A measured surface from a file: " + format_names() +
           ", known by its content, then by its extension, as it is or packed with gzip. Points marked as "
           "not measured stay missing. y runs upwards: j = 0 is the lowest line, whichever a format stores "
           "first. Over x y z triples a line such as \"x [mm];y [mm];z [um]\" says their units.",
       .parameters = {{"path", "string", "the file"}},
       .options = optional(read_block),
       .returns = "Surface",
       .example = "local s = lab.surface.read(\"specimen.txt\", { size=\"1 mm\", unit=\"um\" })",
       .heavy = true,
       .listing = formats_listing});
  return m;
}

}  // namespace asperity::lua
