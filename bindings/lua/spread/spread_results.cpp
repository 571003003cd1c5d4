// SPDX-License-Identifier: GPL-3.0-or-later
// Stored presses over ranks, for resumed runs; without fields, which may exceed one machine.

#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/spread/spread.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/files/byte_string.hpp"
#include "engine/run/ranks.hpp"

namespace asperity::lua {

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

// The digest of the heights includes the number of ranks: bits depend on it.
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

}  // namespace asperity::lua
