// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/run/run.hpp"

#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"

namespace asperity::lua {

namespace {

const RecordType<LedgerLine> ledger_line_type{
    "LedgerLine",
    "line",
    "Cost of the calls of a function.",
    {{"call", &LedgerLine::call, "the function, as \"contact:press\""},
     {"in_case", &LedgerLine::in_case, "whether cases of an ensemble called it"},
     {"times", &LedgerLine::calls,
      "how often it was called; of functions that are not heavy, calls of 50 us and longer"},
     {"seconds", [](const LedgerLine& l) { return l.cost.seconds; }, dimension::time, "of all calls"},
     {"transforms", [](const LedgerLine& l) { return l.cost.transforms; }, "Fourier transforms of all calls"},
     {"bytes", [](const LedgerLine& l) { return l.cost.bytes; }, "greatest memory of one call"}}};

Values ledger(Call& call) { return {object(call.session().ledger->report())}; }

}  // namespace

Class make_class(For<LedgerReport>) {
  using R = LedgerReport;
  Class c{"Ledger", "a ledger", "Work and cost of a run so far; print() shows the whole ledger."};
  c.fields = {
      getter<&R::seconds>("seconds", "number", "of the run so far", dimension::time),
      getter<&R::unaccounted>("unaccounted", "number",
                              "seconds that are in no line: the script itself, and calls too short for one",
                              dimension::time),
      getter<&R::transforms>("transforms", "number",
                             "Fourier transforms, each in equivalents of its contact's finest grid"),
      getter<&R::bytes>("bytes", "integer", "greatest memory of one call"),
      getter<R>("calls", "LedgerLine[]", "a line for each function that was called",
                [](const R& of) { return ledger_line_type.list(of.lines); }),
      getter<R>("by_effect", "table<string, Cost>", "cost of the pressed contacts, effect by effect",
                [](const R& of) { return cost_by_effect(of.by_effect); }),
      getter<R>("effects_off", "string[]", "effects that no contact named, for which nothing was done",
                [](const R& of) { return of.effects_off; }),
      getter<R>("json", "string", "the whole ledger, as JSON",
                [](const R& of) { return of.json().text(2); })};
  c.results = {&ledger_line_type, &cost_type()};
  c.describe = lines_of<R>;
  return c;
}

Function ledger_function() {
  return {.name = "ledger",
          .body = ledger,
          .sentence =
              "Work and cost of this run so far, call by call and effect by effect; the remainder is at "
              "the end.",
          .returns = "Ledger",
          .example = "print(lab.ledger())"};
}

}  // namespace asperity::lua
