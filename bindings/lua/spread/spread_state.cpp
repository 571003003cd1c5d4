// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/spread/spread.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/files/byte_string.hpp"
#include "engine/core/quantity.hpp"
#include "engine/run/ranks.hpp"

namespace asperity::lua {

// For resumed runs; without fields, which may exceed one machine.

namespace {

constexpr std::string_view spread_form = "half-space contact over ranks";

template <class Answer, class Visit>
void numbers_of(Answer& answer, Visit visit) {
  visit("mean_pressure", answer.mean_pressure);
  visit("approach", answer.approach);
  visit("offset", answer.offset);
  visit("contacts", answer.contacts);
  visit("yielded", answer.yielded);
  visit("peak_pressure", answer.peak_pressure);
  visit("mean_gap", answer.mean_gap);
  visit("energy", answer.energy);
  visit("plastic_volume", answer.plastic_volume);
  visit("penetration", answer.certificate.penetration);
  visit("tension", answer.certificate.tension);
  visit("complementarity", answer.certificate.complementarity);
  visit("load_error", answer.certificate.load);
  visit("cap_excess", answer.certificate.cap);
  visit("converged", answer.converged);
  visit("iterations", answer.iterations);
}

// Null on ranks other than 0.
ResultStore* own_store(const Call& call) {
  const Ranks* const ranks = call.session().ranks;
  if (ranks == nullptr) return call.session().monitor().results();
  return ranks->leads() ? ranks->own_store : nullptr;
}

// The bits, hence the digest of the heights, depend on the number of ranks.
std::string key_of(const SlabContactProblem& problem, const SpreadRequest& request) {
  Digester digester;
  digester.add(spread_form)
      .add(problem.surface.digest)
      .add(problem.modulus)
      .add(problem.cap)
      .add(problem.tolerance);
  digester.add(problem.best_effort ? 1 : 0).add(request.by_approach ? 1 : 0).add(request.value);
  return digester.hex();
}

const SlabContactAnswer& answer(const SpreadState& of) { return *of.answer; }

double nodes(const SpreadState& of) { return of.surface.slab.all_nodes(); }

const SlabContactAnswer& plastic_answer(const SpreadState& of, const char* name) {
  if (!of.plastic)
    refuse_without(quoted(name), effects_that(Effect::Acts::bounds_pressure),
                   "name it in `effects` of lab.spread.contact");
  return answer(of);
}

const RecordType<Certificate> spread_certificate_type{"SpreadCertificate", "certificate",
                                                      "Violations of the contact conditions, each relative.",
                                                      certificate_fields()};

Values spread_state_write(Call& call) {
  SpreadState& state = call.self<SpreadState>();
  const std::string name = call.text(1, "name"), path = writable_path(call, call.text(2, "path"));
  const bool pressure = name == "pressure", contact = name == "contact";
  if (!pressure && !contact && name != "gap")
    refuse_name("there is no field " + quoted(name), "give \"pressure\", \"gap\" or \"contact\"");
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

std::string describe_spread_state(const SpreadState& s) {
  const SlabContactAnswer& a = *s.answer;
  return "state over " + counted(static_cast<std::size_t>(s.ranks), "rank") + ": pressure " +
         format_quantity(a.mean_pressure, dimension::pressure) + ", approach " +
         format_quantity(a.approach, dimension::length) + ", area fraction " +
         format_short(static_cast<double>(a.contacts) / s.surface.slab.all_nodes()) +
         (a.converged ? "" : ", not converged");
}

}  // namespace

std::optional<Costed<SlabContactAnswer>> recalled_press(const Call& call, Team& team,
                                                        const SlabContactProblem& problem,
                                                        const SpreadRequest& request) {
  std::string bytes;
  team.work([&] {
    ResultStore* const store = own_store(call);
    if (store == nullptr) return;
    const std::optional<FoundResult> found = store->find(key_of(problem, request));
    if (!found) return;
    ByteWriter out;
    SlabContactAnswer names;
    numbers_of(names, [&](const char* name, const auto&) { out.number(found->number(name)); });
    out.number(found->cost.seconds);
    out.number(found->cost.transforms);
    out.number(found->cost.bytes);
    out.text(found->text("solver"));
    bytes = out.take();
  });
  bytes = team.text_of_first(bytes);
  if (bytes.empty()) return {};
  Costed<SlabContactAnswer> press;
  ByteReader in(bytes);
  numbers_of(press.result, [&]<class Number>(const char*, Number& value) {
    value = static_cast<Number>(in.number<double>());
  });
  press.cost.seconds = in.number<double>();
  press.cost.transforms = in.number<double>();
  press.cost.bytes = in.number<std::int64_t>();
  press.result.solver = in.text();
  cost::count_transforms(press.cost.transforms);
  return press;
}

void keep_press(const Call& call, const SlabContactProblem& problem, const SpreadRequest& request,
                const Costed<SlabContactAnswer>& found) {
  ResultStore* const store = own_store(call);
  if (store == nullptr) return;
  ResultFacts facts;
  numbers_of(found.result, [&](const char* name, auto value) {
    facts.numbers.emplace_back(name, static_cast<double>(value));
  });
  facts.texts.emplace_back("solver", found.result.solver);
  facts.cost = found.cost;
  store->keep(key_of(problem, request), spread_form, facts, {});
}

// data table
Class make_class(For<SpreadState>) {
  using A = SlabContactAnswer;
  using S = SpreadState;
  Class c{"SpreadState", "a state over ranks",
          "A contact under load, its pressures and gaps in slabs: the numbers are the same in every rank."};
  c.shareable = false;
  c.describe = text_of<describe_spread_state>;
  c.native_bytes = from_value(
      [](const S& of) { return (answer(of).pressure.size() + answer(of).gap.size()) * sizeof(double); });
  c.digest = text_of<&S::digest>;
  c.fields = {
      getter<S>(
          "load", "number", "force on the whole tile",
          [](const S& of) { return answer(of).mean_pressure * of.surface.grid.area(); }, dimension::force),
      getter<&S::answer, &A::mean_pressure>("pressure", "number", "load over the nominal area",
                                            dimension::pressure),
      getter<&S::answer, &A::approach>("approach", "number", "from first touch", dimension::length),
      getter<S>(
          "area", "number", "real contact area",
          [](const S& of) { return static_cast<double>(answer(of).contacts) * of.surface.grid.cell_area(); },
          dimension::area),
      getter<S>("area_fraction", "number", "nodes in contact over all nodes",
                [](const S& of) { return static_cast<double>(answer(of).contacts) / nodes(of); }),
      getter<&S::answer, &A::contacts>("nodes_in_contact", "integer", "nodes in contact"),
      getter<&S::answer, &A::peak_pressure>("peak_pressure", "number", "greatest pressure",
                                            dimension::pressure),
      getter<&S::answer, &A::mean_gap>("mean_gap", "number", "mean over the tile of the gap where it is open",
                                       dimension::length),
      getter<&S::answer, &A::energy>("energy", "number", "elastic energy in the tile", dimension::energy),
      getter<S>("plastic_fraction", "number", "share of the tile at the cap; needs plasticity",
                [](const S& of) {
                  return static_cast<double>(plastic_answer(of, "plastic_fraction").yielded) / nodes(of);
                }),
      getter<S>(
          "plastic_volume", "number", "volume by which the bodies overlap at the cap; needs plasticity",
          [](const S& of) { return plastic_answer(of, "plastic_volume").plastic_volume; }, dimension::volume),
      getter<S>("certificate", "SpreadCertificate", "violations of the contact conditions, each relative",
                [](const S& of) { return spread_certificate_type(answer(of).certificate); }),
      getter<&S::answer, &A::certificate, &Certificate::worst>("residual", "number",
                                                               "greatest entry of the certificate"),
      getter<&S::answer, &A::converged>("converged", "boolean",
                                        "whether every entry of the certificate is within the tolerance"),
      getter<&S::answer, &A::iterations>("iterations", "integer",
                                         "applications of the half-space on the finest grid"),
      getter<&S::answer, &A::solver>("solver", "string", "the method of the solution"),
      getter<&S::ranks>("ranks", "integer", "over which it is spread"),
      getter<S>("cost", "Cost",
                "seconds and transforms; bytes is the most memory that any rank held at once for this press, "
                "its heights included",
                [](const S& of) { return cost_type()(of.cost); }),
      getter<&S::digest>("digest", "string", "of the surface and the numbers found"),
  };
  c.methods = {{.name = "write",
                .body = spread_state_write,
                .sentence = "Writes a field as one NPY file of shape (ny, nx), rank after rank: pressure in "
                            "Pa, gap in metres (0 in contact) or contact (1 where it touches).",
                .parameters = {{"name", "\"pressure\"|\"gap\"|\"contact\"", "which"},
                               {"path", "string", "a .npy under the run directory"}},
                .returns = "string",
                .example = "under:write(\"pressure\", \"pressure.npy\")",
                .heavy = true}};
  c.results = {&spread_certificate_type, &cost_type()};
  return c;
}

}  // namespace asperity::lua
