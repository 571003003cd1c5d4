// SPDX-License-Identifier: GPL-3.0-or-later
// The states of contacts over the ranks of mpirun, as values of the language.
#include <algorithm>

#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/spread/spread.hpp"
#include "engine/core/quantity.hpp"

namespace asperity::lua {

namespace {

const SlabContactAnswer& answer(const Call& call) { return *call.self<SpreadState>().answer; }

template <auto member>
Values spread_state_read(Call& call) {
  return {Value(answer(call).*member)};
}

double nodes(const Call& call) { return call.self<SpreadState>().surface.slab.all_nodes(); }

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
  if (!state.has_fields) {  // taken from the store
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
std::string state_digest(const void* self) { return static_cast<const SpreadState*>(self)->digest; }

}  // namespace

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
    c.digest = state_digest;
    c.fields = {
        {"load", "number", "force on the whole tile", dimension::force,
         [](Call& call) -> Values {
           return {answer(call).mean_pressure * call.self<SpreadState>().surface.grid.area()};
         }},
        {"pressure", "number", "load over the nominal area", dimension::pressure,
         spread_state_read<&A::mean_pressure>},
        {"approach", "number", "from first touch", dimension::length, spread_state_read<&A::approach>},
        {"area", "number", "real contact area", dimension::area,
         [](Call& call) -> Values {
           return {static_cast<double>(answer(call).contacts) *
                   call.self<SpreadState>().surface.grid.cell_area()};
         }},
        {"area_fraction",
         "number",
         "nodes in contact over all nodes",
         {},
         [](Call& call) -> Values { return {static_cast<double>(answer(call).contacts) / nodes(call)}; }},
        {"contacts", "integer", "nodes in contact", {}, spread_state_read<&A::contacts>},
        {"peak_pressure", "number", "greatest pressure", dimension::pressure,
         spread_state_read<&A::peak_pressure>},
        {"mean_gap", "number", "mean over the tile of the gap where it is open", dimension::length,
         spread_state_read<&A::mean_gap>},
        {"energy", "number", "elastic energy in the tile", dimension::energy, spread_state_read<&A::energy>},
        {"plastic_fraction",
         "number",
         "share of the tile at the cap; needs plasticity",
         {},
         [](Call& call) -> Values {
           require_plasticity(call, "plastic_fraction");
           return {static_cast<double>(answer(call).yielded) / nodes(call)};
         }},
        {"plastic_volume", "number", "volume by which the bodies overlap at the cap; needs plasticity",
         dimension::volume,
         [](Call& call) -> Values {
           require_plasticity(call, "plastic_volume");
           return {answer(call).plastic_volume};
         }},
        {"certificate",
         "SpreadCertificate",
         "how far the contact conditions are from being met, each relative",
         {},
         [](Call& call) -> Values { return {spread_certificate_type()(answer(call).certificate)}; }},
        {"residual",
         "number",
         "greatest entry of the certificate",
         {},
         [](Call& call) -> Values { return {answer(call).certificate.worst()}; }},
        {"converged",
         "boolean",
         "whether every entry of the certificate is within the tolerance",
         {},
         spread_state_read<&A::converged>},
        {"iterations",
         "integer",
         "applications of the half-space on the finest grid",
         {},
         [](Call& call) -> Values { return {std::int64_t{answer(call).iterations}}; }},
        {"solver", "string", "what found the solution", {}, spread_state_read<&A::solver>},
        {"ranks",
         "integer",
         "over which it is spread",
         {},
         [](Call& call) -> Values { return {std::int64_t{call.self<SpreadState>().ranks}}; }},
        {"cost",
         "Cost",
         "seconds and transforms; bytes is the most memory that any rank held at once for this press, its "
         "heights "
         "included",
         {},
         [](Call& call) -> Values { return {cost_type()(call.self<SpreadState>().cost)}; }},
        {"digest",
         "string",
         "of the surface and the numbers found",
         {},
         [](Call& call) -> Values { return {call.self<SpreadState>().digest}; }},
    };
    c.methods = {{.name = "write",
                  .body = spread_state_write,
                  .sentence =
                      "Writes a field as one NPY file of shape (ny, nx), rank after rank: pressure in Pa, "
                      "gap in metres (0 in contact) or contact (1 where it touches).",
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
