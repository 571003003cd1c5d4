// SPDX-License-Identifier: GPL-3.0-or-later
// lab.surface: generators, and surfaces from functions, tables and files.
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/surface/grid_keys.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "bindings/lua/surface/surface_keys.hpp"
#include "bindings/lua/surface/weierstrass_mandelbrot_keys.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/surface/generators/bead_blasted.hpp"
#include "engine/surface/generators/flat.hpp"
#include "engine/surface/generators/grain_profile.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"
#include "engine/surface/io/format.hpp"

namespace asperity::lua {

namespace {

Values result(Surface surface, const std::optional<Material>& material) {
  return {object(material ? surface.with_material(*material) : std::move(surface))};
}

// Result of a generator whose keys extend its options.
template <auto block, auto generate>
Values made(Call& call) {
  const auto keys = call.options(block());
  return result(generate(keys, call.session().monitor()), keys.body_material);
}

const Block<WeierstrassMandelbrotOptions>& weierstrass_mandelbrot_block() {
  static const Block<WeierstrassMandelbrotOptions> block{
      "lab.surface.weierstrass_mandelbrot", weierstrass_mandelbrot_keys<WeierstrassMandelbrotOptions>()};
  return block;
}

Values weierstrass_mandelbrot_body(Call& call) {
  WeierstrassMandelbrotOptions keys = call.options(weierstrass_mandelbrot_block());
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

const Block<SineKeys>& sine_block() {
  static const Block<SineKeys> block{"lab.surface.sine", sine_keys(), check_sine_keys};
  return block;
}

const Block<GridKeys>& flat_block() {
  static const Block<GridKeys> block{"lab.surface.flat",
                                     {cells_key().required(), size_key().required(), material_key()}};
  return block;
}
Values flat_body(Call& call) {
  const GridKeys keys = call.options(flat_block());
  return result(flat_surface({keys.make()}, call.session().monitor()), keys.body_material);
}

struct SphereKeys : GridKeys, SphereOptions {};
const Block<SphereKeys>& sphere_block() {
  static const Block<SphereKeys> block{
      "lab.surface.sphere",
      {Option<SphereKeys>(cells_key()).required(), Option<SphereKeys>(size_key()).required(),
       Option<SphereKeys>(
           quantity("radius", &SphereOptions::radius, dimension::length, above(0), "radius of curvature"))
           .required(),
       choice("shape", &SphereOptions::shape,
              {{"sphere", SphereShape::sphere}, {"paraboloid", SphereShape::paraboloid}},
              "a true sphere, or the paraboloid r^2/2R of the same curvature"),
       material_key()},
      [](SphereKeys& keys, Problems&) {
        keys.grid = keys.make();
        require_makeable(keys);
      }};
  return block;
}

const Block<SelfAffineKeys>& self_affine_block() {
  static const Block<SelfAffineKeys> block{"lab.surface.self_affine", self_affine_keys(),
                                           check_self_affine_keys};
  return block;
}

const Block<BlastTexture>& texture_block() {
  using O = BlastTexture;
  static const Block<O> block{
      "fine",
      {number("hurst", &O::hurst, {0, 1, true, false, false}, "Hurst exponent of the texture"),
       quantity("roll_off", &O::roll_off, dimension::length, above(0),
                "wave above which its spectrum is flat"),
       quantity("short_wave", &O::short_wave, dimension::length, above(0),
                "its shortest wave, at least two cells, better six"),
       number("share", &O::share, {0, 1, true, false, false}, "its Ra as a fraction of `ra`")}};
  return block;
}

struct BeadBlastedKeys : GridKeys, BeadBlastedOptions {
  BlastTexture texture;
};
const Block<BeadBlastedKeys>& bead_blasted_block() {
  using O = BeadBlastedOptions;
  using K = BeadBlastedKeys;
  auto fine = table_of<K>("fine", &K::texture, texture_block(),
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
  static const Block<K> block{
      "lab.surface.bead_blasted",
      {Option<K>(cells_key()).required(), Option<K>(size_key()).required(),
       Option<K>(quantity("ra", &O::ra, dimension::length, above(0), "mean absolute height, met exactly"))
           .required(),
       Option<K>(pair_option("bead", &O::bead_low, &O::bead_high, dimension::length, above(0),
                             "diameters of the beads, uniform between the two"))
           .defaults_to("{\"250 um\", \"300 um\"}"),
       Option<K>(pair_option("dent", &O::dent_low, &O::dent_high, dimension::length, above(0),
                             "radii of the dents, uniform between the two"))
           .defaults_to("{\"25 um\", \"60 um\"}"),
       number("coverage", &O::coverage, above(0), "area of all dents over that of the surface"),
       std::move(fine).defaults_to("{}"),
       integer("seed", &O::seed, at_least(0), "of the dents and the texture"), material_key()},
      [](K& keys, Problems&) {
        keys.grid = keys.make();
        require_makeable(keys);
      }};
  return block;
}

const Block<GrainProfileOptions>& grain_profile_block() {
  using O = GrainProfileOptions;
  static const Block<O> block{
      "lab.surface.grain_profile",
      {quantity("radius", &O::radius, dimension::length, above(0), "mean radius of the grain").required(),
       number("D", &O::D, inside(1, 2), "fractal dimension of the outline").required(),
       number("amplitude", &O::amplitude, {0, 1, false, true, false},
              "greatest deviation as a fraction of the radius"),
       integer("points", &O::points, between(7, 1 << 24), "points on the outline").required(),
       number("gamma", &O::gamma, above(1), "ratio of neighbouring wave numbers"),
       integer("seed", &O::seed, at_least(0), "of the random phases")}};
  return block;
}
Values grain_profile_body(Call& call) {
  return {object(grain_profile(call.options(grain_profile_block()), call.session().monitor()))};
}

const Block<GridKeys>& from_function_block() {
  static const Block<GridKeys> block{"lab.surface.from_function", from_function_keys()};
  return block;
}

Field heights_of(const Callback& height, const Grid& grid, Monitor& monitor) {
  Field heights(grid.nx, grid.ny);
  Task task(monitor, "heights from a function", grid.ny);
  for (int j = 0; j < grid.ny; ++j, task.advance())
    for (int i = 0; i < grid.nx; ++i) heights(i, j) = height({i * grid.hx(), j * grid.hy()}, "height");
  return heights;
}

// A script function in a recipe. Only native calls from the same state may call the function, which must
// return equal heights at equal places.
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
      throw Error(ErrorCode::bad_value, "a function can be called by its own script alone");
    const Argument::StackGuard guard(now->L);
    lua_rawgeti(now->L, LUA_REGISTRYINDEX, place_);
    const Callback height{Argument(now->L, -1)};
    if (height({x_, y_}, "height") != height_)
      throw Error(ErrorCode::bad_value, "the function `height` gave another height at the same place");
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
  const GridKeys keys = call.options(from_function_block());
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

const Block<GridKeys>& from_table_block() {
  static const Block<GridKeys> block{
      "lab.surface.from_table",
      {size_key().required(),
       custom<GridKeys>(
           "heights", "number[][]", "rows of heights in metres, heights[j+1][i+1]",
           [](const Argument& value, const OptionInfo& info, GridKeys& keys, Problems& problems) {
             if (!value.is_table() || value.length() == 0)
               return detail::wrong_type(value, info, "a table of rows of numbers", problems);
             keys.ny = static_cast<int>(std::min<std::int64_t>(value.length(), max_cells + 1));
             value.element(1, [&](const Argument& row) {
               if (!row.is_table() || row.length() == 0) {
                 problems.push_back(
                     quoted(info.name) + " must be rows of numbers, heights[j+1][i+1], and " +
                     (row.is_table() ? "its first row is empty" : "its first element is " + row.describe()) +
                     "; of one row write { { 1, 2, 3 } }");
               } else {
                 keys.nx = static_cast<int>(std::min<std::int64_t>(row.length(), max_cells + 1));
               }
             });
           })
           .required(),
       material_key()}};
  return block;
}
Values from_table_body(Call& call) {
  const GridKeys keys = call.options(from_table_block());
  const Grid grid = keys.make();
  Field heights(grid.nx, grid.ny);
  with_key(call.argument(1), "heights", [&](const Argument& rows) {
    for (int j = 0; j < grid.ny; ++j) {
      stop_flag().check();
      rows.element(j + 1, [&](const Argument& row) {
        if (!row.is_table() || row.length() != grid.nx)
          throw Error(ErrorCode::bad_value,
                      "row " + std::to_string(j + 1) + " of `heights` is " +
                          (row.is_table() ? "a table of " + std::to_string(row.length()) : row.describe()),
                      "every row must have " + std::to_string(grid.nx) + " heights, as the first has");
        for (int i = 0; i < grid.nx; ++i)
          row.element(i + 1, [&](const Argument& height) {
            if (!height.is_number())
              throw Error(ErrorCode::bad_value,
                          "heights[" + std::to_string(j + 1) + "][" + std::to_string(i + 1) + "] is " +
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

const Block<ReadOptions>& read_block() {
  using O = ReadOptions;
  static const Block<O> block{"lab.surface.read",
                              {pair_option("size", &O::size_x, &O::size_y, dimension::length, above(0),
                                           "size of the map, where the file has none"),
                               unit_key(&O::unit), unit_xy_key(&O::unit_xy), fill_key(&O::fill),
                               format_key(&O::format), channel_key(&O::channel), material_key(&O::material)}};
  return block;
}
Values read_body(Call& call) {
  const std::string path = readable_path(call, call.text(1, "path"));
  const ReadOptions options = call.options(read_block(), 2);
  // The size check precedes the digest, so that a file too large for memory is not read.
  const SourceFile file(path, call.session().monitor());
  note_input(call, path);
  return {object(read_surface(file, options, call.session().monitor()))};
}

}  // namespace

// data table
const Module& surface_module() {
  static const Module module = [] {
    Module m;
    m.path = "lab.surface";
    m.sentence = "Rough surfaces: generated, from functions and tables, or read from files.";
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
        "The fractal surface of the source paper, a sum of cosine waves (Yan and Komvopoulos 1998; Hanaor, "
        "Gan and Einav 2013, eq. 2), with exact phases.",
        weierstrass_mandelbrot_block(), "Surface",
        "local s = lab.surface.weierstrass_mandelbrot{ cells=150, D=2.5, seed=1 }");
    add("self_affine", made<self_affine_block, self_affine_surface>,
        "A Gaussian surface with power-law spectrum, flat below the roll-off; rms height, rms slope or Ra is "
        "met exactly.",
        self_affine_block(), "Surface",
        "local s = lab.surface.self_affine{ cells=256, size=\"1 mm\", hurst=0.8, rms_height=\"1 um\", "
        "short_wave=\"16 um\" }");
    add("bead_blasted", made<bead_blasted_block, bead_blasted_surface>,
        "A surface blasted with glass beads, as the specimens of the source paper: overlapping dents with "
        "piled-up rims, and a fine self-affine texture.",
        bead_blasted_block(), "Surface",
        "local s = lab.surface.bead_blasted{ cells=512, size=\"1 mm\", ra=\"3 um\" }");
    add("flat", flat_body, "A flat surface at height 0.", flat_block(), "Surface",
        "local s = lab.surface.flat{ cells=64, size=\"1 mm\" }");
    add("sine", made<sine_block, sine_surface>,
        "A cosine wave along x, or the product of one along x and one along y; crest at node 0.",
        sine_block(), "Surface", "local s = lab.surface.sine{ cells=64, size=\"1 mm\", amplitude=\"1 um\" }");
    add("sphere", made<sphere_block, sphere_surface>,
        "A sphere or paraboloid with its apex at node (nx//2, ny//2), height 0.", sphere_block(), "Surface",
        "local s = lab.surface.sphere{ cells=128, size=\"1 mm\", radius=\"10 mm\" }");
    add("grain_profile", grain_profile_body,
        "The outline of a quasi-spherical grain with fractal roughness (the source paper's Fig. 1), as a "
        "closed profile.",
        grain_profile_block(), "Profile",
        "local g = lab.surface.grain_profile{ radius=\"100 um\", D=1.3, points=2048 }");
    add("from_function", from_function_body, "Heights from a function of x and y.", from_function_block(),
        "Surface",
        "local s = lab.surface.from_function{ cells=64, size=1e-3, height=function(x, y) return 1e-6 * x / "
        "1e-3 end }");
    add("from_table", from_table_body, "Heights from a table of rows; the first row is j = 0.",
        from_table_block(), "Surface",
        "local s = lab.surface.from_table{ size=1e-3, heights={ {0, 1e-6}, {2e-6, 0} } }");
    m.functions.push_back(
        {.name = "read",
         .body = read_body,
         .sentence = "A measured surface from a file: " + format_names() +
                     ", known by its content, then by its extension, as it is or packed with gzip. Points "
                     "marked as not measured stay missing. y runs upwards: j = 0 is the lowest line, "
                     "whichever a format stores first. Over x y z triples a line such as \"x [mm];y [mm];z "
                     "[um]\" says their units.",
         .parameters = {{"path", "string", "the file"}},
         .options = &read_block(),
         .options_optional = true,
         .returns = "Surface",
         .example = "local s = lab.surface.read(\"specimen.txt\", { size=\"1 mm\", unit=\"um\" })",
         .heavy = true,
         .listing = formats_listing});
    return m;
  }();
  return module;
}

}  // namespace asperity::lua
