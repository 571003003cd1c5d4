// SPDX-License-Identifier: GPL-3.0-or-later
// States of contacts over MPI ranks.
#include <algorithm>

#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/spread/spread.hpp"
#include "engine/core/quantity.hpp"

namespace asperity::lua {

namespace {

const SlabContactAnswer& answer(const SpreadState& of) { return *of.answer; }

template <auto member>
Getter answered(const char* name, const char* type, const char* sentence, Dimension dimension = {}) {
  return getter<SpreadState>(
      name, type, sentence, [](const SpreadState& of) { return answer(of).*member; }, dimension);
}

double nodes(const SpreadState& of) { return of.surface.slab.all_nodes(); }

void require_plasticity(const Call& call, const char* name) {
  if (!call.self<SpreadState>().plastic)
    refuse_without(quoted(name), effects_that(Effect::Acts::bounds_pressure),
                   "name it in `effects` of lab.spread.contact");
}

const RecordType<Certificate>& spread_certificate_type() {
  static const RecordType<Certificate> type{
      "SpreadCertificate", "certificate", "How far the contact conditions are from being met, each relative.",
      certificate_fields()};
  return type;
}

Values spread_state_write(Call& call) {
  SpreadState& state = call.self<SpreadState>();
  const std::string name = call.text(1, "name"), path = writable_path(call, call.text(2, "path"));
  const bool pressure = name == "pressure", contact = name == "contact";
  if (!pressure && !contact && name != "gap")
    throw Error(ErrorCode::unknown_name, "there is no field " + quoted(name),
                "give \"pressure\", \"gap\" or \"contact\"");
  Team& team = team_of(call);
  if (!state.has_fields) {  // from the store
    state.answer = std::make_shared<const SlabContactAnswer>(
        solve(team, state.problem, state.request, call.session().monitor()));
    state.has_fields = true;
  }
  const SlabContactAnswer& a = *state.answer;
  const Slab& slab = state.surface.slab;
  const auto row = [&](int j, double* to) {
    const std::size_t begin = static_cast<std::size_t>(j - slab.first()) * slab.width();
    for (std::size_t i = 0; i < slab.width(); ++i) {
      const double p = a.pressure[begin + i];
      to[i] = pressure ? p : contact ? (p > 0 ? 1.0 : 0.0) : p > 0 ? 0.0 : std::max(0.0, a.gap[begin + i]);
    }
  };
  write_slabs(team, slab, row, path, call.session().monitor());
  return {path};
}

std::string describe_spread_state(const void* self) {
  const auto& s = *static_cast<const SpreadState*>(self);
  const SlabContactAnswer& a = *s.answer;
  return "state over " + std::to_string(s.ranks) + (s.ranks == 1 ? " rank" : " ranks") + ": pressure " +
         format_quantity(a.mean_pressure, dimension::pressure) + ", approach " +
         format_quantity(a.approach, dimension::length) + ", area fraction " +
         format_short(static_cast<double>(a.contacts) / s.surface.slab.all_nodes()) +
         (a.converged ? "" : ", not converged");
}
std::size_t spread_state_bytes(const void* self) {
  const SlabContactAnswer& a = *static_cast<const SpreadState*>(self)->answer;
  return (a.pressure.size() + a.gap.size()) * sizeof(double);
}

}  // namespace

// data table
template <>
const Class& class_of<SpreadState>() {
  using A = SlabContactAnswer;
  static const Class type = [] {
    Class c;
    c.name = "SpreadState";
    c.article_name = "a state over ranks";
    c.sentence =
        "A contact under load, its pressures and gaps in slabs: the numbers are the same in every rank.";
    c.shareable = false;
    c.describe = describe_spread_state;
    c.native_bytes = spread_state_bytes;
    c.digest = text_of<&SpreadState::digest>;
    c.fields = {
        getter<SpreadState>(
            "load", "number", "force on the whole tile",
            [](const SpreadState& of) { return answer(of).mean_pressure * of.surface.grid.area(); },
            dimension::force),
        answered<&A::mean_pressure>("pressure", "number", "load over the nominal area", dimension::pressure),
        answered<&A::approach>("approach", "number", "from first touch", dimension::length),
        getter<SpreadState>(
            "area", "number", "real contact area",
            [](const SpreadState& of) {
              return static_cast<double>(answer(of).contacts) * of.surface.grid.cell_area();
            },
            dimension::area),
        getter<SpreadState>(
            "area_fraction", "number", "nodes in contact over all nodes",
            [](const SpreadState& of) { return static_cast<double>(answer(of).contacts) / nodes(of); }),
        answered<&A::contacts>("contacts", "integer", "nodes in contact"),
        answered<&A::peak_pressure>("peak_pressure", "number", "greatest pressure", dimension::pressure),
        answered<&A::mean_gap>("mean_gap", "number", "mean over the tile of the gap where it is open",
                               dimension::length),
        answered<&A::energy>("energy", "number", "elastic energy in the tile", dimension::energy),
        {"plastic_fraction",
         "number",
         "share of the tile at the cap; needs plasticity",
         {},
         [](Call& call) -> Values {
           require_plasticity(call, "plastic_fraction");
           return {static_cast<double>(answer(call.self<SpreadState>()).yielded) /
                   nodes(call.self<SpreadState>())};
         }},
        {"plastic_volume", "number", "volume by which the bodies overlap at the cap; needs plasticity",
         dimension::volume,
         [](Call& call) -> Values {
           require_plasticity(call, "plastic_volume");
           return {answer(call.self<SpreadState>()).plastic_volume};
         }},
        getter<SpreadState>(
            "certificate", "SpreadCertificate",
            "how far the contact conditions are from being met, each relative",
            [](const SpreadState& of) { return spread_certificate_type()(answer(of).certificate); }),
        getter<SpreadState>("residual", "number", "greatest entry of the certificate",
                            [](const SpreadState& of) { return answer(of).certificate.worst(); }),
        answered<&A::converged>("converged", "boolean",
                                "whether every entry of the certificate is within the tolerance"),
        getter<SpreadState>("iterations", "integer", "applications of the half-space on the finest grid",
                            [](const SpreadState& of) { return answer(of).iterations; }),
        answered<&A::solver>("solver", "string", "what found the solution"),
        getter<&SpreadState::ranks>("ranks", "integer", "over which it is spread"),
        getter<SpreadState>("cost", "Cost",
                            "seconds and transforms; bytes is the most memory that any rank held at once for "
                            "this press, its heights included",
                            [](const SpreadState& of) { return cost_type()(of.cost); }),
        getter<&SpreadState::digest>("digest", "string", "of the surface and the numbers found"),
    };
    c.methods = {{.name = "write",
                  .body = spread_state_write,
                  .sentence = "Writes a field as one NPY file of shape (ny, nx), rank after rank: pressure "
                              "in Pa, gap in metres (0 in contact) or contact (1 where it touches).",
                  .parameters = {{"name", "\"pressure\"|\"gap\"|\"contact\"", "which"},
                                 {"path", "string", "a .npy under the run directory"}},
                  .returns = "string",
                  .example = "under:write(\"pressure\", \"pressure.npy\")",
                  .heavy = true}};
    c.results = {&spread_certificate_type(), &cost_type()};
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
