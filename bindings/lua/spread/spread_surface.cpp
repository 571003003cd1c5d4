// SPDX-License-Identifier: GPL-3.0-or-later
// lab.spread: surfaces for a contact too large for one process.
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

template <const auto& block, auto generate>
Values spread_made(Call& call) {
  const auto keys = call.options(block);
  return spread_result(generate(team_of(call), keys, call.session().monitor()), keys.body_material);
}

Values spread_flat_body(Call& call) {
  const GridKeys keys = call.options(flat_block);
  return spread_result(slab_flat(team_of(call), keys.make(), call.session().monitor()), keys.body_material);
}

Values spread_from_function_body(Call& call) {
  const GridKeys keys = call.options(from_function_block);
  const Grid grid = keys.make();
  Team& team = team_of(call);
  return with_key(call.argument(1), "height", [&](const Argument& function) {
    const Callback height(function);
    Session& session = call.session();
    const Temporarily waits(session.with_other_ranks, session.ranks != nullptr);
    const auto row = [&](int j, double* to) {
      for (int i = 0; i < grid.nx; ++i) to[i] = height({i * grid.hx(), j * grid.hy()}, "height");
    };
    return spread_result(slab_surface(team, grid, row, call.session().monitor()), keys.body_material);
  });
}

struct spread_ReadKeys : SlabFileOptions {
  std::optional<Material> material;
};
const Block<spread_ReadKeys> spread_read_block{
    {pair_option("size", &spread_ReadKeys::size_x, &spread_ReadKeys::size_y, dimension::length, above(0),
                 "size of the map")
         .required(),
     unit_key(&spread_ReadKeys::unit).defaults_to("1 m"), material_key(&spread_ReadKeys::material)}};
Values spread_read_body(Call& call) {
  const std::string path = readable_path(call, call.text(1, "path"));
  const spread_ReadKeys keys = call.options(spread_read_block, 2);
  const Ranks* const ranks = call.session().ranks;
  if (ranks == nullptr || ranks->leads()) note_input(call, path);
  // At the path of the first rank.
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

Module spread_module() {
  Module m{"lab.spread",
           "One contact that does not fit one process: surfaces, the half-space and its states in slabs over "
           "the ranks of `mpirun -n K asperity run`; no rank holds the whole grid. In a process alone the "
           "same with one slab. Over several ranks last digits hang on the processor and the C library."};
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
  add("self_affine", spread_made<self_affine_block, slab_self_affine>,
      "The heights of lab.surface.self_affine, to rounding, made in slabs by a transform over the ranks.",
      self_affine_block,
      "local s = lab.spread.self_affine{ cells=64, size=\"1 mm\", hurst=0.8, rms_height=\"1 um\", "
      "short_wave=\"50 um\", seed=1, material=al }");
  add("sine", spread_made<sine_block, slab_sine>, "The heights of lab.surface.sine.", sine_block,
      "local s = lab.spread.sine{ cells=64, size=\"1 mm\", amplitude=\"1 um\" }");
  add("flat", spread_flat_body, "A flat.", flat_block,
      "local s = lab.spread.flat{ cells=64, size=\"1 mm\" }");
  add("from_function", spread_from_function_body,
      "Heights from a function of x and y, which each rank calls for its own rows.", from_function_block,
      "local s = lab.spread.from_function{ cells=64, size=1e-3, height=function(x, y) return 1e-6 * x / 1e-3 "
      "end }");
  m.functions.push_back(
      {.name = "read",
       .body = spread_read_body,
       .sentence = "A surface from a NPY file of shape (ny, nx); each rank reads its own rows.",
       .parameters = {{"path", "string", "the file, which every rank must be able to read"}},
       .options = &spread_read_block,
       .returns = "SpreadSurface",
       .example =
           "tile:write \"map.npy\" local s = lab.spread.read(\"map.npy\", { size=\"1 mm\", unit=\"m\" })",
       .heavy = true});
  m.functions.push_back(spread_contact_function());
  return m;
}

Class make_class(For<SlabSurface>) {
  using S = SlabSurface;
  Class c{"SpreadSurface", "a surface over ranks", "A rough surface; each rank holds some rows."};
  c.shareable = false;
  c.describe = from_value([](const SlabSurface& s) -> std::string {
    return "surface of " + std::to_string(s.grid.nx) + " x " + std::to_string(s.grid.ny) + " cells over " +
           std::to_string(s.slab.ranks) + (s.slab.ranks == 1 ? " rank" : " ranks") + ", rms height " +
           format_quantity(s.rms, dimension::length);
  });
  c.native_bytes = from_value([](const SlabSurface& of) { return of.heights->size() * sizeof(double); });
  c.digest = text_of<&SlabSurface::digest>;
  c.fields = {
      getter<S>("cells", "integer[]", "cells along x and y",
                [](const S& of) { return along_axes(of.grid.nx, of.grid.ny); }),
      getter<S>(
          "size", "number[]", "length of the sides",
          [](const S& of) { return along_axes(of.grid.size_x, of.grid.size_y); }, dimension::length),
      getter<&S::rms>("rms_height", "number", "root mean square height about the mean", dimension::length),
      getter<&S::mean>("mean", "number", "mean height", dimension::length),
      getter<&S::peak>("peak", "number", "greatest height", dimension::length),
      getter<&S::valley>("valley", "number", "least height", dimension::length),
      getter<&S::slab, &Slab::ranks>("ranks", "integer", "over which it is spread"),
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
}

}  // namespace asperity::lua
