// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/run/ledger.hpp"

#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/session.hpp"

namespace asperity::lua {

namespace {

Record line_record(const LedgerLine& line) {
  Record record;
  record.name = "line";
  record.add("call", line.call)
      .add("in_case", line.in_case)
      .add("times", line.calls)
      .add("seconds", line.cost.seconds, dimension::time)
      .add("transforms", line.cost.transforms)
      .add("bytes", line.cost.bytes);
  return record;
}

Values calls_of(Call& call) {
  List list;
  for (const LedgerLine& line : call.self<LedgerReport>().lines) list.items.emplace_back(line_record(line));
  return {std::move(list)};
}

Values effects_of(Call& call) {
  Record record;
  record.name = "cost by effect";
  for (const auto& [effect, cost] : call.self<LedgerReport>().by_effect)
    record.add(effect, cost_record(cost, effect));
  return {std::move(record)};
}

Values ledger(Call& call) { return {object(call.session().ledger->report())}; }

}  // namespace

template <>
const Class& class_of<LedgerReport>() {
  static const Class type = [] {
    using R = LedgerReport;
    Class c;
    c.name = "Ledger";
    c.article_name = "a ledger";
    c.sentence = "What a run has done so far and what it cost; print() shows all of it.";
    c.fields = {{"seconds", "number", "of the run so far", dimension::time,
                 [](Call& call) -> Values { return {call.self<R>().seconds}; }},
                {"unaccounted", "number",
                 "seconds that are in no line: the script itself, and calls too short for one",
                 dimension::time, [](Call& call) -> Values { return {call.self<R>().unaccounted()}; }},
                {"transforms",
                 "number",
                 "Fourier transforms, each in equivalents of its contact's finest grid",
                 {},
                 [](Call& call) -> Values { return {call.self<R>().transforms}; }},
                {"bytes",
                 "integer",
                 "greatest memory of one call",
                 {},
                 [](Call& call) -> Values { return {call.self<R>().bytes}; }},
                {"calls",
                 "table[]",
                 "a line per call: call, in_case, times, seconds, transforms, bytes",
                 {},
                 calls_of},
                {"by_effect", "table", "what the pressed contacts cost, effect by effect", {}, effects_of},
                {"effects_off",
                 "string[]",
                 "effects that no contact named, for which nothing was done",
                 {},
                 [](Call& call) -> Values { return {text_list(call.self<R>().effects_off)}; }},
                {"json", "string", "all of it, as JSON", {}, [](Call& call) -> Values {
                   return {call.self<R>().json().text(2)};
                 }}};
    c.describe = [](const void* self) {
      std::string text = static_cast<const R*>(self)->text();
      text.pop_back();
      return text;
    };
    return c;
  }();
  return type;
}

Function ledger_function() {
  return {.name = "ledger",
          .body = ledger,
          .sentence =
              "What this run has done so far and what it cost, call by call and effect by effect, with what "
              "is in no line at the end.",
          .returns = "Ledger",
          .example = "print(lab.ledger())"};
}

}  // namespace asperity::lua
