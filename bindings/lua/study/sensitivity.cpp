// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <span>
#include <utility>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/study/asked_function.hpp"
#include "bindings/lua/study/study.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

struct SensitivityKeys {
  InputKeys given;
  std::optional<std::int64_t> runs;
  std::uint64_t seed = 1;
};

const Block<SensitivityKeys> sensitivity_block{
    {function<SensitivityKeys>("ask", "a function(x)",
                               "function(x) returning the answer, one number, for a table of the inputs; it "
                               "must give the same for the same x, so keep seeds fixed inside")
         .required(),
     inputs_option(&SensitivityKeys::given).required(),
     integer("runs", &SensitivityKeys::runs, between(3, 100000),
             "how often `ask` is called; without it three for each term of degree 2 (64 for five inputs), "
             "doubled up to three times while the leave-one-out error is above 5 %"),
     integer("seed", &SensitivityKeys::seed, at_least(0), "of the values at which `ask` is called")},
    [](SensitivityKeys& keys, Problems& problems) {
      if (!keys.given.correlations.empty())
        problems.emplace_back("`inputs` are correlated, and shares need independent ones; use lab.budget");
    }};

Knobs knobs_of_inputs(const std::vector<UncertainInput>& inputs, const std::vector<double>& values) {
  Knobs knobs;
  for (std::size_t j = 0; j < inputs.size(); ++j) knobs.push_back({inputs[j].name, values[j]});
  sort_knobs(knobs);
  return knobs;
}

Values dry_sensitivity(Call& call, const SensitivityKeys& keys, const AskedFunction& ask) {
  if (!keys.given.unknown) {
    check_inputs(keys.given.inputs);
    std::vector<double> values;
    for (const UncertainInput& input : keys.given.inputs) values.push_back(input.value);
    ask.try_once(knobs_of_inputs(keys.given.inputs, values));
  }
  call.session().gave_placeholders = true;
  return {Object{&class_of<Sensitivity>(), nullptr, false}};
}

Values make_sensitivity(Call& call) {
  SensitivityKeys keys = call.options(sensitivity_block);
  return with_key(call.argument(1), "ask", [&](const Argument& function) -> Values {
    if (call.session().dry_run) return dry_sensitivity(call, keys, AskedFunction(call, function));
    AskedRuns ask(call, function);
    ChaosRequest request{keys.given.inputs, static_cast<std::size_t>(keys.runs.value_or(0)), keys.seed};
    RunProgress progress(call.session().monitor(), "sensitivity");
    std::size_t finished = 0, total = 0;
    const auto batch = [&](std::span<const std::vector<double>> points) {
      std::vector<Knobs> knobs;
      for (const std::vector<double>& values : points)
        knobs.push_back(knobs_of_inputs(keys.given.inputs, values));
      const auto show = [&](double done) {
        const double all = static_cast<double>(finished) + done;
        progress.report("run " + std::to_string(std::min(static_cast<std::size_t>(all) + 1, total)) + " of " +
                            std::to_string(total),
                        all / static_cast<double>(total));
      };
      show(0);
      std::vector<double> answers;
      for (const AskedFunction::Answer& answer : ask(knobs, show)) answers.push_back(answer.value);
      finished += answers.size();
      return answers;
    };
    // The first run decides whether to run in parallel.
    Sensitivity found = sensitivity_of_batches(
        request,
        [&](std::span<const std::vector<double>> points) {
          if (finished > 0 || points.empty()) return batch(points);
          std::vector<double> answers = batch(points.first(1));
          const std::vector<double> others = batch(points.subspan(1));
          answers.insert(answers.end(), others.begin(), others.end());
          return answers;
        },
        [&](std::size_t more) { total += more; });
    if (const auto& run = call.session().run; run && !call.session().is_case) {
      Json shares = Json::object();
      for (const VarianceShare& share : found.chaos.shares) shares.set(share.name, share.total);
      run->journal().write("sensitivity", Json::object({{"runs", static_cast<std::int64_t>(found.chaos.runs)},
                                                        {"mean", found.chaos.mean},
                                                        {"deviation", found.deviation},
                                                        {"total", std::move(shares)}}));
    }
    return {object(std::move(found))};
  });
}

struct SharedInput {
  VarianceShare share;
  UncertainInput input;
  double halved = 0;
};

const RecordType<SharedInput> share_type{
    "InputShare",
    "share",
    "Contribution of an uncertain input to the variance of an answer.",
    {{"name", [](const SharedInput& s) { return s.share.name; }, "of the input"},
     {"value", [](const SharedInput& s) { return s.input.value; }, "that was given, SI"},
     {"u", [](const SharedInput& s) { return s.input.uncertainty; },
      "standard uncertainty that was given, SI"},
     {"first", [](const SharedInput& s) { return s.share.first; },
      "first-order share of the variance, by the input alone"},
     {"first_error", [](const SharedInput& s) { return s.share.first_error; }, "standard error of `first`"},
     {"total", [](const SharedInput& s) { return s.share.total; },
      "total share: all that the input does, together with others too"},
     {"total_error", [](const SharedInput& s) { return s.share.total_error; }, "standard error of `total`"},
     {"deviation_when_halved", &SharedInput::halved,
      "standard deviation of the answer, in its unit, with the input's uncertainty halved, nearly"}}};

std::vector<SharedInput> shared_inputs(const Sensitivity& of) {
  std::vector<SharedInput> list;
  for (const std::size_t j : of.order)
    list.push_back({of.chaos.shares[j], of.chaos.inputs[j], of.deviation_when[j]});
  return list;
}

}  // namespace

Function sensitivity_function() {
  return {.name = "sensitivity",
          .body = make_sensitivity,
          .sentence =
              "Ranks the uncertain inputs of an answer: first-order and total shares of the variance with "
              "their errors, by polynomial chaos, and the input to measure better next. The leave-one-out "
              "error of the fit is printed: below 5 % of the variance shares are good, to 20 % rough, "
              "above they are refused. Inputs are taken as independent.",
          .options = &sensitivity_block,
          .returns = "Sensitivity",
          .example =
              "print(lab.sensitivity{ ask=function(x) return x.alpha + x.tau0 / x.pressure end, inputs={ "
              "alpha={ value=0.2, u=0.02 }, tau0={ value=\"500 MPa\", u=\"50 MPa\" }, pressure={ value=\"2 "
              "GPa\", u=\"5 %\" } } })"};
}

Class make_class(For<Sensitivity>) {
  Class c{"Sensitivity", "a sensitivity",
          "Which uncertain input an answer hangs on. print() shows the table of shares."};
  c.describe = lines_of<Sensitivity>;
  c.fields = {
      getter<&Sensitivity::chaos, &PolynomialChaos::mean>("mean", "number", "of the answer over the inputs"),
      getter<&Sensitivity::deviation>("deviation", "number",
                                      "standard deviation of the answer over the inputs"),
      getter<&Sensitivity::chaos, &PolynomialChaos::runs>("runs", "integer", "how often `ask` was called"),
      getter<&Sensitivity::chaos, &PolynomialChaos::degree>(
          "degree", "integer", "of the polynomial; 0 of an answer that is always the same"),
      getter<&Sensitivity::chaos, &PolynomialChaos::leave_one_out>(
          "leave_one_out", "number",
          "what the fit of the other runs misses each by: mean square over the variance"),
      getter<Sensitivity>("approximate", "boolean",
                          "whether that is above 5 %, so that the shares are known nearly and no better",
                          [](const Sensitivity& of) { return of.chaos.trust() != ChaosTrust::good; }),
      getter<Sensitivity>("measure_next", "string?",
                          "the input whose better measurement narrows the answer most, the first by name in "
                          "a tie; nil if the answer depends on no input",
                          [](const Sensitivity& of) {
                            return (of.chaos.variance != 0)
                                       ? std::optional(of.chaos.shares[of.order.front()].name)
                                       : std::nullopt;
                          }),
      getter<Sensitivity>("inputs", "InputShare[]", "the shares, beginning with the input to measure next",
                          [](const Sensitivity& of) { return share_type.list(shared_inputs(of)); }),
  };
  c.results = {&share_type};
  return c;
}

}  // namespace asperity::lua
