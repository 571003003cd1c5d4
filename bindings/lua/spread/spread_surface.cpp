// SPDX-License-Identifier: GPL-3.0-or-later
// lab.spread: surfaces over MPI ranks, for a contact too large for one process.
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/spread/spread.hpp"
#include "bindings/lua/surface/surface_keys.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/quantity.hpp"
#include "engine/run/ranks.hpp"

namespace asperity::lua {

namespace {

Values spread_result(SlabSurface surface, const std::optional<Material>& material) {
  surface.material = material;
  return {object(std::move(surface))};
}

const Block<SelfAffineKeys>& spread_self_affine_block() {
  static const Block<SelfAffineKeys> block{"lab.spread.self_affine", self_affine_keys(),
                                           check_self_affine_keys};
  return block;
}
Values spread_self_affine_body(Call& call) {
  SelfAffineKeys keys = call.options(spread_self_affine_block());
  return spread_result(slab_self_affine(team_of(call), keys, call.session().monitor()), keys.body_material);
}

const Block<SineKeys>& spread_sine_block() {
  static const Block<SineKeys> block{"lab.spread.sine", sine_keys(), check_sine_keys};
  return block;
}
Values spread_sine_body(Call& call) {
  SineKeys keys = call.options(spread_sine_block());
  return spread_result(slab_sine(team_of(call), keys, call.session().monitor()), keys.body_material);
}

const Block<GridKeys>& spread_flat_block() {
  static const Block<GridKeys> block{"lab.spread.flat",
                                     {cells_key().required(), size_key().required(), material_key()}};
  return block;
}
Values spread_flat_body(Call& call) {
  const GridKeys keys = call.options(spread_flat_block());
  return spread_result(slab_flat(team_of(call), keys.make(), call.session().monitor()), keys.body_material);
}

// During a Lua call on which other ranks wait.
class WaitedFor {
 public:
  explicit WaitedFor(Session& session) : session_(session) {
    session_.with_other_ranks = session_.ranks != nullptr;
  }
  ~WaitedFor() { session_.with_other_ranks = false; }
  WaitedFor(const WaitedFor&) = delete;
  WaitedFor& operator=(const WaitedFor&) = delete;

 private:
  Session& session_;
};

const Block<GridKeys>& spread_from_function_block() {
  static const Block<GridKeys> block{"lab.spread.from_function", from_function_keys()};
  return block;
}
Values spread_from_function_body(Call& call) {
  const GridKeys keys = call.options(spread_from_function_block());
  const Grid grid = keys.make();
  Team& team = team_of(call);
  return with_key(call.argument(1), "height", [&](const Argument& function) {
    const Callback height(function);
    const WaitedFor waited_for(call.session());
    const auto row = [&](int j, double* to) {
      for (int i = 0; i < grid.nx; ++i) to[i] = height({i * grid.hx(), j * grid.hy()}, "height");
    };
    return spread_result(slab_surface(team, grid, row, call.session().monitor()), keys.body_material);
  });
}

struct spread_ReadKeys : SlabFileOptions {
  std::optional<Material> material;
};
const Block<spread_ReadKeys>& spread_read_block() {
  using K = spread_ReadKeys;
  static const Block<K> block{
      "lab.spread.read",
      {pair_option("size", &K::size_x, &K::size_y, dimension::length, above(0), "size of the map").required(),
       unit_key(&K::unit).defaults_to("1 m"), material_key(&K::material)}};
  return block;
}
Values spread_read_body(Call& call) {
  const std::string path = readable_path(call, call.text(1, "path"));
  const spread_ReadKeys keys = call.options(spread_read_block(), 2);
  const Ranks* const ranks = call.session().ranks;
  if (ranks == nullptr || ranks->leads()) note_input(call, path);
  // Files of the run are at the path of the first rank.
  Team& team = team_of(call);
  return spread_result(slab_read(team, team.text_of_first(path), keys, call.session().monitor()),
                       keys.material);
}

Values spread_write(Call& call) {
  const SlabSurface& surface = call.self<SlabSurface>();
  const std::string path = writable_path(call, call.text(1, "path"));
  const auto row = [&](int j, double* to) {
    std::copy_n(
        surface.heights->data() + static_cast<std::size_t>(j - surface.slab.first()) * surface.slab.width(),
        surface.slab.width(), to);
  };
  write_slabs(team_of(call), surface.slab, row, path, call.session().monitor());
  return {path};
}

std::string spread_describe(const void* self) {
  const auto& s = *static_cast<const SlabSurface*>(self);
  return "surface of " + std::to_string(s.grid.nx) + " x " + std::to_string(s.grid.ny) + " cells over " +
         std::to_string(s.slab.ranks) + (s.slab.ranks == 1 ? " rank" : " ranks") + ", rms height " +
         format_quantity(s.rms, dimension::length);
}
std::size_t bytes(const void* self) {
  return static_cast<const SlabSurface*>(self)->heights->size() * sizeof(double);
}

}  // namespace

Team& team_of(const Call& call) {
  Session& session = call.session();
  if (session.is_case)
    throw Error(
        ErrorCode::not_permitted,
        call.function_name() + " was called in a case of an ensemble, whose cases the ranks share out",
        "call it outside the ensemble, or use lab.surface and lab.contact in the case");
  if (session.ranks == nullptr) return Team::alone();
  Digester inputs;
  for (const auto& [key, value] : call.inputs()) inputs.add(key).add(value);
  session.ranks->meet(call.function_name() + " (" + inputs.hex().substr(0, 8) + ")", session.ensembles);
  return session.ranks->team();
}

const Module& spread_module() {
  static const Module module = [] {
    Module m;
    m.path = "lab.spread";
    m.sentence =
        "One contact that does not fit one process: surfaces, the half-space and its states in slabs over "
        "the ranks of `mpirun -n K asperity run`, none of which holds the whole grid. In a process alone the "
        "same with one slab. Over several ranks last digits hang on the processor and the C library.";
    auto add = [&](const char* name, Body body, const char* sentence, const BlockInfo& block,
                   const char* example) {
      m.functions.push_back({.name = name,
                             .body = body,
                             .sentence = sentence,
                             .options = &block,
                             .returns = "SpreadSurface",
                             .example = example,
                             .heavy = true});
    };
    add("self_affine", spread_self_affine_body,
        "The heights of lab.surface.self_affine, to rounding, made in slabs by a transform over the ranks.",
        spread_self_affine_block(),
        "local s = lab.spread.self_affine{ cells=64, size=\"1 mm\", hurst=0.8, rms_height=\"1 um\", "
        "short_wave=\"50 um\", seed=1, material=al }");
    add("sine", spread_sine_body, "The heights of lab.surface.sine.", spread_sine_block(),
        "local s = lab.spread.sine{ cells=64, size=\"1 mm\", amplitude=\"1 um\" }");
    add("flat", spread_flat_body, "A flat.", spread_flat_block(),
        "local s = lab.spread.flat{ cells=64, size=\"1 mm\" }");
    add("from_function", spread_from_function_body,
        "Heights from a function of x and y, which each rank calls for its own rows.",
        spread_from_function_block(),
        "local s = lab.spread.from_function{ cells=64, size=1e-3, height=function(x, y) return 1e-6 * x / "
        "1e-3 end }");
    m.functions.push_back(
        {.name = "read",
         .body = spread_read_body,
         .sentence = "A surface from a NPY file of shape (ny, nx), of which each rank reads its own rows.",
         .parameters = {{"path", "string", "the file, which every rank must be able to read"}},
         .options = &spread_read_block(),
         .returns = "SpreadSurface",
         .example =
             "tile:write \"map.npy\" local s = lab.spread.read(\"map.npy\", { size=\"1 mm\", unit=\"m\" })",
         .heavy = true});
    m.functions.push_back(spread_contact_function());
    return m;
  }();
  return module;
}

template <>
const Class& class_of<SlabSurface>() {
  using S = SlabSurface;
  static const Class type = [] {
    Class c;
    c.name = "SpreadSurface";
    c.article_name = "a surface over ranks";
    c.sentence = "A rough surface of which each rank holds some rows.";
    c.shareable = false;
    c.describe = spread_describe;
    c.native_bytes = bytes;
    c.digest = text_of<&SlabSurface::digest>;
    c.fields = {
        getter<S>("cells", "integer[]", "cells along x and y",
                  [](const S& of) {
                    return List{{of.grid.nx, of.grid.ny}};
                  }),
        getter<S>(
            "size", "number[]", "length of the sides",
            [](const S& of) {
              return List{{of.grid.size_x, of.grid.size_y}};
            },
            dimension::length),
        getter<&S::rms>("rms_height", "number", "root mean square height about the mean", dimension::length),
        getter<&S::mean>("mean", "number", "mean height", dimension::length),
        getter<&S::peak>("peak", "number", "greatest height", dimension::length),
        getter<&S::valley>("valley", "number", "least height", dimension::length),
        getter<S>("ranks", "integer", "over which it is spread", [](const S& of) { return of.slab.ranks; }),
        getter<&S::digest>("digest", "string", "of its heights and how they are spread"),
    };
    c.methods = {
        {.name = "write",
         .body = spread_write,
         .sentence = "Writes the heights in metres as one NPY file of shape (ny, nx), rank after rank.",
         .parameters = {{"path", "string", "a .npy under the run directory"}},
         .returns = "string",
         .example = "tile:write \"heights.npy\"",
         .heavy = true}};
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
