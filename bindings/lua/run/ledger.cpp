// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/run/ledger.hpp"

#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/session.hpp"

namespace asperity::lua {

namespace {

const RecordType<LedgerLine>& ledger_line_type() {
  using L = LedgerLine;
  static const RecordType<L> type{
      "LedgerLine",
      "line",
      "What the calls of a function have cost.",
      {{"call", &L::call, "the function, as \"contact:press\""},
       {"in_case", &L::in_case, "whether cases of an ensemble called it"},
       {"times", &L::calls, "how often it was called"},
       {"seconds", [](const L& l) { return l.cost.seconds; }, dimension::time, "of all calls"},
       {"transforms", [](const L& l) { return l.cost.transforms; }, "Fourier transforms of all calls"},
       {"bytes", [](const L& l) { return l.cost.bytes; }, "greatest memory of one call"}}};
  return type;
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
                 "LedgerLine[]",
                 "a line for each function that was called",
                 {},
                 [](Call& call) -> Values { return {ledger_line_type().list(call.self<R>().lines)}; }},
                {"by_effect",
                 "table<string, Cost>",
                 "what the pressed contacts cost, effect by effect",
                 {},
                 [](Call& call) -> Values { return {cost_by_effect(call.self<R>().by_effect)}; }},
                {"effects_off",
                 "string[]",
                 "effects that no contact named, for which nothing was done",
                 {},
                 [](Call& call) -> Values { return {text_list(call.self<R>().effects_off)}; }},
                {"json", "string", "all of it, as JSON", {}, [](Call& call) -> Values {
                   return {call.self<R>().json().text(2)};
                 }}};
    c.results = {&ledger_line_type(), &cost_type()};
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
