// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/contact/plan.hpp"

#include "engine/run/plan_json.hpp"

namespace asperity::lua {

namespace {

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
        {"press",
         "string",
         "which press these are of and how that is known; empty where explain was told none",
         {},
         [](Call& call) -> Values { return {call.self<Plan>().press}; }},
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
         [](Call& call) -> Values { return {text_list(call.self<Plan>().effects_run)}; }},
        {"effects_off",
         "string[]",
         "effects that it does not name, for which nothing is done",
         {},
         [](Call& call) -> Values { return {text_list(call.self<Plan>().effects_off)}; }},
        {"warnings",
         "string[]",
         "of a grid that is too coarse for an effect; the first press gives them too",
         {},
         [](Call& call) -> Values { return {text_list(call.self<Plan>().warnings)}; }},
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

}  // namespace asperity::lua
