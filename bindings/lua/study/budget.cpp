// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/study/asked_function.hpp"
#include "bindings/lua/study/study.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

struct BudgetKeys : BudgetRequest {
  InputKeys given;
  std::vector<KnobSweep> replicate;  // equal lengths, in step
  std::vector<KnobSweep> noise;      // one list of seeds
  std::optional<std::int64_t> asked_runs;
};

void refuse_repeats(const std::string& path, std::span<const KnobSweep> lists, Problems& problems) {
  const std::vector<KnobValue>& values = lists.front().values;
  for (std::size_t k = 1; k < values.size(); ++k)
    for (std::size_t j = 0; j < k; ++j) {
      const auto alike = [&](const KnobSweep& of) {
        return of.values.size() > k && of.values[j] == of.values[k];
      };
      if (!std::ranges::all_of(lists, alike)) continue;
      problems.push_back(quoted(path + "[" + std::to_string(k + 1) + "]") + " is " + lua_source(values[k]) +
                         " for the second time; give each value once, or mark repeats by a list `specimen`");
      return;
    }
}

void read_replicate(const Argument& value, const OptionInfo& info, BudgetKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a table such as { seed={ 1, 2, 3, 4, 5 } }", problems);
  value.each([&](const Argument& key, const Argument& list) {
    if (!key.is_text())
      problems.push_back(quoted(info.name) + " has a list without a name; write `seed = { 1, 2, 3 }`");
    else if (list.is_unknown())
      keys.given.unknown = true;
    else
      read_sweep(std::string(key.text()), info.name + "." + std::string(key.text()), list, keys.given.unknown,
                 keys.replicate, problems);
  });
  std::ranges::sort(keys.replicate, {}, &KnobSweep::name);
}

// One number or a list.
template <std::vector<double> BudgetRequest::*member>
void read_numbers(const Argument& value, const OptionInfo& info, BudgetKeys& keys, Problems& problems) {
  const auto take = [&](const Argument& item) {
    if (item.is_unknown())
      keys.given.unknown = true;
    else if (const auto number = detail::read_quantity(item, info, above(0), problems))
      (keys.*member).push_back(*number);
  };
  if (!value.is_table()) return take(value);
  if (value.length() == 0) return detail::wrong_type(value, info, "numbers in a list", problems);
  value.elements(take);
}

void read_cells(const Argument& value, const OptionInfo& info, BudgetKeys& keys, Problems& problems) {
  read_numbers<&BudgetRequest::cells>(value, info, keys, problems);
  for (const double cells : keys.cells)
    if (cells != std::floor(cells) || cells > 1e6) {
      problems.push_back(quoted(info.name) + " holds " + format_short(cells) +
                         "; give whole numbers of cells");
      return;
    }
}

// Reads { { "a", "b", -0.8 }, … }.
void read_correlation(const Argument& value, const OptionInfo& info, BudgetKeys& keys, Problems& problems) {
  std::vector<KnobSweep> rows;
  if (value.is_table())
    value.elements([&](const Argument& row, std::int64_t k) {
      read_sweep("", info.name + "[" + std::to_string(k) + "]", row, keys.given.unknown, rows, problems);
    });
  bool wrong = rows.empty();
  for (KnobSweep& row : rows) {
    row.values.resize(3);
    const auto *one = std::get_if<std::string>(row.values.data()),
               *other = std::get_if<std::string>(&row.values[1]);
    const auto r = number_of({{"r", row.values[2]}}, "r");
    if (one != nullptr && other != nullptr && r)
      keys.given.correlations.push_back({*one, *other, *r});
    else
      wrong = true;
  }
  if (wrong && !keys.given.unknown)
    problems.push_back(quoted(info.name) +
                       " lists two inputs and a number each, such as { { \"a\", \"b\", -0.8 } }");
}

bool names_specimens(const KnobSweep& list) { return list.name == "specimen"; }

void check_budget(BudgetKeys& keys, Problems& problems) {
  if (keys.given.unknown) return;
  for (const KnobSweep& knob : keys.replicate)
    if (knob.values.size() != keys.replicate.front().values.size())
      problems.push_back(
          "the lists of `replicate` need one length, and " + quoted(keys.replicate.front().name) + " has " +
          std::to_string(keys.replicate.front().values.size()) + " values, " + quoted(knob.name) + " " +
          std::to_string(knob.values.size()) + "; give as many of each");
  const bool nested = std::ranges::any_of(keys.replicate, names_specimens);
  for (std::size_t k = 0; k < (nested ? 1 : keys.replicate.size()); ++k)
    refuse_repeats("replicate." + keys.replicate[k].name,
                   std::span(keys.replicate).subspan(k, nested ? keys.replicate.size() : 1), problems);
  if (!keys.noise.empty()) refuse_repeats("noise", keys.noise, problems);
  std::vector<std::string> names;
  for (const UncertainInput& input : keys.given.inputs) names.push_back(input.name);
  for (const KnobSweep& knob : keys.replicate) names.push_back(knob.name);
  if (!keys.cells.empty()) names.emplace_back("cells");
  if (!keys.tolerances.empty()) names.emplace_back("tolerance");
  if (!keys.tips.empty()) names.emplace_back("tip");
  if (!keys.noise.empty()) names.emplace_back("noise");
  std::ranges::sort(names);
  if (const auto twice = std::ranges::adjacent_find(names); twice != names.end())
    problems.push_back(quoted(*twice) + " is given in two ways; `ask` can get only one value by that name");
  for (const char* taken :
       {"sampling", "cells", "solver", "tip", "noise", "inputs", "correlation", "inputs together"})
    for (const UncertainInput& input : keys.given.inputs)
      if (input.name == taken)
        problems.push_back("the input " + quoted(input.name) +
                           " has the name of a part of the budget; rename it");
}

Option<BudgetKeys> tip_option() {
  Option<BudgetKeys> option =
      custom<BudgetKeys>("tip", "length|length[]",
                         "tip radii of a stylus, blunt to sharp, such as { \"5 um\", \"2 um\" }: `ask` gets "
                         "one as x.tip in m, the sharpest in all other runs; the change between the two "
                         "sharpest bounds the error of the sharpest, of order 1 to 2 of the radius",
                         read_numbers<&BudgetRequest::tips>);
  option.info.dimension = dimension::length;
  return option;
}

const Block<BudgetKeys> budget_block{
    {function<BudgetKeys>(
         "ask", "a function(x)",
         "function(x) returning the number, for a table x of the inputs, and of `cells`, `tolerance`, `tip`, "
         "`noise` and the names in `replicate` where they are given. Where it presses or makes surfaces, its "
         "calls are spread over threads, each in a fresh copy of everything it uses")
         .required(),
     inputs_option(&BudgetKeys::given),
     custom<BudgetKeys>("correlation", "{string, string, number}[]",
                        "of inputs, such as { { \"alpha\", \"tau0\", -0.8 } }; other pairs are independent",
                        read_correlation),
     custom<BudgetKeys>(
         "replicate", "table",
         "gives other specimens of the same kind, such as { seed={ 1, 2, 3, 4, 5 } }: its scatter is the "
         "share of sampling; several lists go along together. With a list `specimen`, runs of one are its "
         "repeats: the means of the specimens are the sample, and their number gives the degrees",
         read_replicate),
     custom<BudgetKeys>(
         "cells", "integer|integer[]",
         "cells a side, coarse to fine: the change between two grids shows the error of the cells, three "
         "show its order too. With two and no `replicate`, `ask` gets up to two numbers of cells between "
         "them as well, since two answers may agree by chance. The inputs are varied on the coarsest",
         read_cells),
     pair_option("order", &BudgetRequest::order_low, &BudgetRequest::order_high, dimension::number,
                 between(0.1, 10), "of the error of the cells, the least and the greatest that are possible")
         .defaults_to("{1, 2}"),
     custom<BudgetKeys>("tolerance", "number|number[]",
                        "of the solver, loose to tight: the change between the two tightest bounds its error",
                        read_numbers<&BudgetRequest::tolerances>),
     tip_option(),
     custom<BudgetKeys>(
         "noise", "integer[]",
         "seeds of draws of an instrument's noise: `ask` gets one as x.noise and adds that noise to what is "
         "measured; x.noise is nil in all other runs. The scatter of the answers is the share of noise, "
         "which is that of one measurement",
         [](const Argument& value, const OptionInfo& info, BudgetKeys& keys, Problems& problems) {
           read_sweep("noise", info.name, value, keys.given.unknown, keys.noise, problems);
         }),
     integer("runs", &BudgetKeys::asked_runs, between(3, 100000),
             "how often the inputs are varied; without it three for each term of degree 2 (64 for five "
             "inputs), doubled up to three times while the leave-one-out error is above 5 %"),
     number("confidence", &BudgetRequest::confidence, inside(0, 1), "of the interval"),
     choice("interval", &BudgetRequest::interval,
            {{"student", MeanInterval::student}, {"log", MeanInterval::log_normal}},
            "of the mean over replicates: Student's t, or for positive skewed answers the log interval of "
            "Cox, which assumes that their logarithms are normal"),
     custom<BudgetKeys>(
         "half_width", "number|string",
         "the wanted half-width of the interval, in the unit of the answer or as a share of the answer such "
         "as \"5 %\": the cheapest way is reported",
         [](const Argument& value, const OptionInfo& info, BudgetKeys& keys, Problems& problems) {
           keys.half_width = detail::read_quantity(value, info, above(0), problems);
           keys.of_answer = value.is_text() && value.text().find('%') != std::string_view::npos;
         }),
     quantity("at_most", &BudgetRequest::at_most, dimension::time, above(0),
              "longest time for all runs; refused after the first ones where they will take longer"),
     integer("seed", &BudgetRequest::seed, at_least(0), "of the values of the inputs and of the draws")},
    check_budget};

// From the lists of knobs.
void complete(BudgetKeys& keys) {
  keys.inputs = keys.given.inputs;
  keys.correlations = keys.given.correlations;
  keys.replicates = keys.replicate.empty() ? 0 : keys.replicate.front().values.size();
  for (const KnobSweep& list : keys.replicate)
    for (std::size_t k = 0; names_specimens(list) && k < list.values.size(); ++k)
      keys.specimens.push_back(
          static_cast<std::size_t>(std::ranges::find(list.values, list.values[k]) - list.values.begin()));
  if (!keys.noise.empty()) keys.noises = keys.noise.front().values.size();
  keys.runs = static_cast<std::size_t>(keys.asked_runs.value_or(0));
}

Knobs knobs_of_run(const BudgetKeys& keys, const std::vector<double>& grids, const BudgetSetting& run) {
  Knobs knobs;
  for (std::size_t j = 0; j < keys.inputs.size(); ++j) knobs.push_back({keys.inputs[j].name, run.inputs[j]});
  for (const KnobSweep& knob : keys.replicate) knobs.push_back({knob.name, knob.values[run.replicate]});
  if (!keys.cells.empty()) knobs.push_back({"cells", static_cast<std::int64_t>(grids[run.cells])});
  if (!keys.tolerances.empty()) knobs.push_back({"tolerance", keys.tolerances[run.tolerance]});
  if (!keys.tips.empty()) knobs.push_back({"tip", keys.tips[run.tip]});
  if (run.noise) knobs.push_back({"noise", keys.noise.front().values[*run.noise]});
  sort_knobs(knobs);
  return knobs;
}

Values dry_budget(Call& call, const BudgetKeys& keys, const AskedFunction& ask) {
  if (!keys.given.unknown) {
    BudgetSetting first;
    for (const UncertainInput& input : keys.inputs) first.inputs.push_back(input.value);
    check_request(keys);
    ask.try_once(knobs_of_run(keys, keys.cells, first));
  }
  call.session().gave_placeholders = true;
  return {Object{&class_of<Budget>(), nullptr, false}};
}

void record_budget(Session& session, const Budget& budget) {
  if (!session.run) return;
  Json shares = Json::object(), seconds = Json::object();
  for (const BudgetPart& part : budget.parts) {
    shares.set(part.name, part.share);
    if (part.halving_seconds) seconds.set(part.name, *part.halving_seconds);
  }
  session.run->journal().write(
      "budget",
      Json::object(
          {{"runs", static_cast<std::int64_t>(budget.runs)},
           {"value", budget.value},
           {"low", budget.low},
           {"high", budget.high},
           {"shares", std::move(shares)},
           {"unhashed", Json::object({{"seconds", budget.seconds}, {"halving", std::move(seconds)}})}}));
}

Values make_budget(Call& call) {
  BudgetKeys keys = call.options(budget_block);
  complete(keys);
  Session& session = call.session();
  if (session.is_case)
    throw Error(
        ErrorCode::not_permitted,
        "a case of an ensemble cannot measure the times of a budget: other cases run at the same time",
        "go over the cases in a `for` loop, one budget after the other");
  return with_key(call.argument(1), "ask", [&](const Argument& function) -> Values {
    if (session.dry_run) return dry_budget(call, keys, AskedFunction(call, function));
    AskedRuns ask(call, function);
    RunProgress progress(session.monitor(), "budget");
    keys.at_a_time = ask.at_a_time();
    const std::vector<double> grids = budget_grids(keys);
    Budget found = budget_of_batches(keys, [&](std::span<const BudgetSetting> runs) {
      std::vector<Knobs> knobs;
      for (const BudgetSetting& run : runs) knobs.push_back(knobs_of_run(keys, grids, run));
      // Shows the first unfinished run.
      const auto show = [&](double done) {
        const auto k = std::min(static_cast<std::size_t>(done), runs.size() - 1);
        const BudgetSetting& run = runs[k];
        progress.report(
            "run " + std::to_string(run.number) + " of " + std::to_string(run.of) + ", " + run.part,
            run.done_before + (done - static_cast<double>(k)) * (run.done_after - run.done_before));
      };
      show(0);
      std::vector<BudgetAnswer> answers;
      for (const AskedFunction::Answer& answer : ask(knobs, show))
        answers.push_back({answer.value, answer.seconds});
      return answers;
    });
    for (const std::string& warning : found.warnings) session.monitor().warn(warning);
    record_budget(session, found);
    return {object(std::move(found))};
  });
}

const RecordType<BudgetPart> part_type{
    "BudgetPart",
    "part",
    "A part of the error of a number.",
    {{"name", &BudgetPart::name,
      "sampling, cells, solver, tip, noise, an input, `correlation`, or `inputs together`: joint effects of "
      "inputs, and the misfit of their polynomial"},
     {"u", &BudgetPart::uncertainty, "standard uncertainty from this part, in the unit of the answer"},
     {"degrees", &BudgetPart::degrees, "degrees of freedom of u; infinite where it is taken as known"},
     {"sensitivity",
      [](const BudgetPart& p) { return p.input ? std::optional(p.sensitivity) : std::nullopt; },
      "of an input: derivative of the answer at the values of all"},
     {"share", &BudgetPart::share,
      "of the variance; the shares sum to 1, and the share of a correlation may be negative"},
     {"share_error", &BudgetPart::share_error, "standard error of the share of an input; 0 of other parts"},
     {"halving", &BudgetPart::halving, "what halves it"},
     {"seconds", &BudgetPart::halving_seconds,
      "computing time that halving takes; nil where it takes a measurement"},
     {"half_width_after", &BudgetPart::half_width_after,
      "half the width of the whole interval with this part halved, nearly"}}};

const RecordType<BudgetPlan> plan_type{
    "BudgetPlan",
    "plan",
    "The cheapest way to the requested interval.",
    {{"replicates", &BudgetPlan::replicates, "how many; 0 where there is nothing to sample"},
     {"cells", [](const BudgetPlan& p) { return p.cells > 0 ? std::optional(p.cells) : std::nullopt; },
      "a side, of the finest grid; nil where there is no list of cells"},
     {"seconds", &BudgetPlan::seconds, dimension::time, "that it takes, from nothing"},
     {"half_width", &BudgetPlan::half_width, "half the width of the interval that is expected"}}};

}  // namespace

Function budget_function() {
  return {
      .name = "budget",
      .body = make_budget,
      .sentence =
          "The whole error of a number: `ask` is called again with other seeds, on coarser grids, to looser "
          "tolerances and over the range of uncertain inputs. Gives the value, its interval, the share of "
          "each part, the cost of halving each, and the cheapest way to an interval. print() adds a sheet of "
          "the inputs as the GUM has it. Presses computed before in the run are taken from its store.",
      .options = &budget_block,
      .returns = "Budget",
      .example =
          "print(lab.budget{ ask=function(x) return lab.surface.self_affine{ cells=x.cells, size=\"640 um\", "
          "hurst=0.8, rms_height=\"1 um\", short_wave=\"80 um\", seed=x.seed }:roughness().Ra * x.gain end, "
          "cells={ 32, 64 }, replicate={ seed={ 1, 2, 3, 4, 5 } }, inputs={ gain={ value=1, u=\"2 %\" } } "
          "})"};
}

Class make_class(For<Budget>) {
  Class c{"Budget", "a budget", "A number with its whole error. print() shows the table of parts."};
  c.describe = lines_of<Budget>;
  c.fields = {
      getter<&Budget::value>("value", "number", "the number, corrected for the error of the cells"),
      getter<&Budget::low>("low", "number", "lower end of its interval"),
      getter<&Budget::high>("high", "number", "upper end of its interval"),
      getter<&Budget::confidence>("confidence", "number", "of the interval"),
      getter<&Budget::uncertainty>("u", "number", "its standard uncertainty"),
      getter<&Budget::degrees>("degrees", "number", "of freedom of u, by Welch and Satterthwaite"),
      getter<&Budget::replicates>(
          "n", "integer", "replicates, or specimens with repeats; 0 where there is nothing to sample"),
      getter<Budget>("skewness", "number?", "of the answers over the replicates",
                     [](const Budget& of) { return of.sample ? of.sample->skewness : std::nullopt; }),
      getter<Budget>(
          "leave_one_out", "number?",
          "error of the polynomial of the inputs over their variance: shares are rough from 5 %, and refused "
          "from 20 % on",
          [](const Budget& of) { return of.chaos ? std::optional(of.chaos->leave_one_out) : std::nullopt; }),
      getter<&Budget::order_observed>("order_observed", "number?",
                                      "order of the error of the cells over the three finest grids"),
      getter<&Budget::runs>("runs", "integer", "how often `ask` was called"),
      getter<&Budget::seconds>("seconds", "number", "time inside `ask`", dimension::time),
      getter<Budget>("parts", "BudgetPart[]", "the parts of its error, greatest share first",
                     [](const Budget& of) { return part_type.list(of.parts); }),
      getter<Budget>("plan", "BudgetPlan?",
                     "the cheapest way to `half_width`; nil if not requested or out of reach of computing",
                     [](const Budget& of) { return of.plan ? Value(plan_type(*of.plan)) : Value(); }),
      getter<&Budget::warnings>("warnings", "string[]", "warnings: few replicates, skewed ones, a rough fit"),
  };
  c.results = {&part_type, &plan_type};
  return c;
}

}  // namespace asperity::lua
