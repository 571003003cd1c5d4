// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ledger.hpp"

#include "bindings/lua/contact.hpp"
#include "bindings/lua/state_error.hpp"
#include "engine/experiment/plan_json.hpp"

namespace asperity::lua {

namespace {

Values texts(const std::vector<std::string>& items) {
  List list;
  for (const std::string& item : items) list.items.emplace_back(item);
  return {std::move(list)};
}

// --- the plan

Values terms_of(Call& call) {
  List list;
  for (const PlannedTerm& term : call.self<Plan>().terms) {
    Record record;
    record.name = "term";
    record.add("effect", term.effect).add("sentence", term.sentence);
    list.items.emplace_back(std::move(record));
  }
  return {std::move(list)};
}

Values buffers_of(Call& call) {
  List list;
  for (const PlannedBuffer& buffer : call.self<Plan>().buffers) {
    Record record;
    record.name = "buffer";
    record.add("name", buffer.name).add("bytes", buffer.bytes).add("kept", buffer.kept);
    list.items.emplace_back(std::move(record));
  }
  return {std::move(list)};
}

// --- the ledger

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
const Class& class_of<Plan>() {
  static const Class type = [] {
    Class c;
    c.name = "Plan";
    c.article_name = "a plan";
    c.sentence = "What a press will compute, and what it is expected to cost; print() shows all of it.";
    c.fields = {
        {"solver",
         "string",
         "how it is solved",
         {},
         [](Call& call) -> Values { return {call.self<Plan>().solver}; }},
        {"overlap_fraction",
         "number",
         "share of the tile on which the bodies face each other as they lie",
         {},
         [](Call& call) -> Values { return {call.self<Plan>().overlap}; }},
        {"terms", "table[]", "the terms of the problem: effect and sentence", {}, terms_of},
        {"buffers", "table[]", "what is held in memory: name, bytes, and whether it is kept", {}, buffers_of},
        {"transforms",
         "number",
         "Fourier transforms expected of a press, in equivalents of the finest grid",
         {},
         [](Call& call) -> Values { return {call.self<Plan>().transforms}; }},
        {"bytes",
         "integer",
         "memory expected, at most",
         {},
         [](Call& call) -> Values { return {call.self<Plan>().bytes_peak()}; }},
        {"seconds", "number", "expected for the first press, a rough guess", dimension::time,
         [](Call& call) -> Values { return {call.self<Plan>().seconds}; }},
        {"effects_run",
         "string[]",
         "effects that the scene names",
         {},
         [](Call& call) { return texts(call.self<Plan>().effects_run); }},
        {"effects_off",
         "string[]",
         "effects that it does not name, for which nothing is done",
         {},
         [](Call& call) { return texts(call.self<Plan>().effects_off); }},
        {"warnings",
         "string[]",
         "of a grid that is too coarse for an effect; the first press gives them too",
         {},
         [](Call& call) { return texts(call.self<Plan>().warnings); }},
        {"json", "string", "all of it, as JSON", {}, [](Call& call) -> Values {
           return {to_json(call.self<Plan>()).text(2)};
         }}};
    c.describe = [](const void* self) {
      std::string text = static_cast<const Plan*>(self)->text();
      text.pop_back();
      return text;
    };
    return c;
  }();
  return type;
}

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
                 [](Call& call) { return texts(call.self<R>().effects_off); }},
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

void enter_effects(const Session& session, const Values& results) {
  for (const Value& result : results) {
    const auto* object = std::get_if<Object>(&result.data);
    if (object == nullptr || object->pointer == nullptr || object->type != &class_of<asperity::State>())
      continue;
    session.ledger->add_effects(static_cast<const asperity::State*>(object->pointer.get())->cost().by_effect);
  }
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
