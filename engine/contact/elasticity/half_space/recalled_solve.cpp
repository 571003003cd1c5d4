// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/recalled_solve.hpp"

#include <cstdint>
#include <string>
#include <utility>

#include "engine/core/digest.hpp"

namespace asperity {

namespace {

// One list for writing and reading, so that nothing is kept that is not read and the other way about.
template <class Answer, class Visit>
void numbers_of(Answer& answer, Visit visit) {
  visit("offset", answer.offset);
  visit("mean_pressure", answer.mean_pressure);
  visit("approach", answer.approach);
  visit("contacts", answer.contacts);
  visit("yielded", answer.yielded);
  visit("peak_pressure", answer.peak_pressure);
  visit("penetration", answer.certificate.penetration);
  visit("tension", answer.certificate.tension);
  visit("complementarity", answer.certificate.complementarity);
  visit("load_error", answer.certificate.load);
  visit("cap_excess", answer.certificate.cap);
  visit("attraction_error", answer.certificate.attraction);
  visit("converged", answer.converged);
  visit("iterations", answer.iterations);
}

// Counts are far below 2^53, so that a double holds them.
void write_numbers(const HalfSpaceAnswer& answer, ResultFacts& facts) {
  numbers_of(answer, [&](const char* name, auto value) {
    facts.numbers.emplace_back(name, static_cast<double>(value));
  });
  facts.texts.emplace_back("solver", answer.solver);
}

HalfSpaceAnswer read_answer(FoundResult& found) {
  HalfSpaceAnswer answer;
  numbers_of(answer, [&]<class Number>(const char* name, Number& value) {
    value = static_cast<Number>(found.number(name));
  });
  answer.solver = found.text("solver");
  answer.pressure = found.take("pressure");
  answer.gap = found.take("gap");
  return answer;
}

const ResultForm<HalfSpaceAnswer> half_space_form = {
    "half-space contact",
    [](const HalfSpaceAnswer& answer, ResultFacts& facts, KeptFields& fields) {
      write_numbers(answer, facts);
      fields = {{"pressure", &answer.pressure}, {"gap", &answer.gap}};
    },
    read_answer};

const ResultForm<AdhesiveAnswer> adhesive_form = {
    "half-space contact with attraction",
    [](const AdhesiveAnswer& answer, ResultFacts& facts, KeptFields& fields) {
      write_numbers(answer.contact, facts);
      facts.numbers.emplace_back("mean_attraction", answer.mean_attraction);
      facts.numbers.emplace_back("stationarity", answer.stationarity);
      facts.numbers.emplace_back("steps", answer.steps);
      facts.numbers.emplace_back("shares", static_cast<double>(answer.shares.size()));
      for (std::size_t k = 0; k < answer.shares.size(); ++k)
        facts.numbers.emplace_back("share_" + std::to_string(k + 1), answer.shares[k]);
      facts.numbers.emplace_back("first_contact_seconds", answer.first_contact.seconds);
      facts.numbers.emplace_back("first_contact_transforms", answer.first_contact.transforms);
      facts.numbers.emplace_back("first_contact_bytes", static_cast<double>(answer.first_contact.bytes));
      fields = {{"pressure", &answer.contact.pressure},
                {"gap", &answer.contact.gap},
                {"attraction", &answer.attraction}};
    },
    [](FoundResult& found) {
      AdhesiveAnswer answer;
      answer.contact = read_answer(found);
      answer.attraction = found.take("attraction");
      answer.mean_attraction = found.number("mean_attraction");
      answer.stationarity = found.number("stationarity");
      answer.steps = static_cast<int>(found.number("steps"));
      const auto shares = static_cast<std::size_t>(found.number("shares"));
      for (std::size_t k = 0; k < shares; ++k)
        answer.shares.push_back(found.number("share_" + std::to_string(k + 1)));
      answer.first_contact = {found.number("first_contact_seconds"), found.number("first_contact_transforms"),
                              static_cast<std::int64_t>(found.number("first_contact_bytes"))};
      return answer;
    }};

void add(Digester& digester, const HalfSpaceProblem& problem) {
  const Grid& grid = problem.grid;
  digester.add(grid.nx).add(grid.ny).add(grid.size_x).add(grid.size_y);
  digester.add(static_cast<int>(problem.boundary)).add(problem.modulus);
  digester.add(problem.heights->values()).add(problem.rms);
  const YieldLaw& law = problem.yield;
  digester.add(law.cap).add(law.hardening).add(law.yield ? law.yield->values() : std::span<const double>());
  digester.add(problem.tolerance).add(problem.best_effort).add(problem.single);
  if (const auto& share = problem.share)
    digester.add("share")
        .add(share->length)
        .add(share->uniform)
        .add(std::span<const double>(share->parameters));
}

}  // namespace

Costed<HalfSpaceAnswer> recall_or_solve(const HalfSpaceProblem& problem, std::string_view by, double value,
                                        Monitor& monitor, const std::function<HalfSpaceAnswer()>& solve) {
  const auto key = [&] {
    Digester digester;
    digester.add(half_space_form.call);
    add(digester, problem);
    return digester.add(by).add(value).hex();
  };
  return recall_or(monitor, half_space_form, key, solve);
}

Costed<AdhesiveAnswer> recall_or_adhere(const AdhesiveProblem& problem, std::string_view by, double value,
                                        const AdhesiveAnswer* start, Monitor& monitor,
                                        const std::function<AdhesiveAnswer()>& solve) {
  const auto key = [&] {
    Digester digester;
    digester.add(adhesive_form.call);
    add(digester, problem.contact);
    for (const GapTerm& term : problem.attraction)
      digester.add(term.effect).add(static_cast<int>(term.law)).add(term.work).add(term.range).add(term.edge);
    if (start != nullptr)
      digester.add("from").add(start->contact.pressure.values()).add(start->attraction.values());
    return digester.add(by).add(value).hex();
  };
  return recall_or(monitor, adhesive_form, key, solve);
}

}  // namespace asperity
