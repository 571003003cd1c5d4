// SPDX-License-Identifier: GPL-3.0-or-later
// The result of contact:explain: the plan of a press and its expected cost.
#include "engine/contact/plan.hpp"
#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "engine/core/files/json.hpp"

namespace asperity::lua {

namespace {

const RecordType<PlannedTerm>& planned_term_type() {
  using T = PlannedTerm;
  static const RecordType<T> type{"PlannedTerm",
                                  "term",
                                  "A term of the problem that a press will solve.",
                                  {{"effect", &T::effect, "that adds it"},
                                   {"sentence", &T::sentence, "what it is here, with its numbers"}}};
  return type;
}

const RecordType<PlannedBuffer>& planned_buffer_type() {
  using B = PlannedBuffer;
  static const RecordType<B> type{
      "PlannedBuffer",
      "buffer",
      "What a press will hold in memory.",
      {{"name", &B::name, "what it is for"},
       {"bytes", &B::bytes, "its size"},
       {"kept", &B::kept, "whether for as long as the bodies lie as they do, or only for a moment"}}};
  return type;
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
        getter<&Plan::solver>("solver", "string", "how it is solved"),
        getter<&Plan::overlap>("overlap_fraction", "number",
                               "share of the tile on which the bodies face each other as they lie"),
        getter<Plan>("terms", "PlannedTerm[]", "the terms of the problem",
                     [](const Plan& of) { return planned_term_type().list(of.terms); }),
        getter<Plan>("buffers", "PlannedBuffer[]", "what is held in memory",
                     [](const Plan& of) { return planned_buffer_type().list(of.buffers); }),
        getter<&Plan::transforms>(
            "transforms", "number",
            "Fourier transforms expected of a press, in equivalents of the finest grid"),
        getter<&Plan::press>(
            "press", "string",
            "which press these are of and how that is known; empty where explain was told none"),
        getter<&Plan::bytes_peak>("bytes", "integer", "memory expected, at most"),
        getter<&Plan::seconds>("seconds", "number", "expected for the first press, a rough guess",
                               dimension::time),
        getter<Plan>("effects_run", "string[]", "effects that the scene names",
                     [](const Plan& of) { return text_list(of.effects_run); }),
        getter<Plan>("effects_off", "string[]", "effects that it does not name, for which nothing is done",
                     [](const Plan& of) { return text_list(of.effects_off); }),
        getter<Plan>("warnings", "string[]",
                     "of a grid that is too coarse for an effect; the first press gives them too",
                     [](const Plan& of) { return text_list(of.warnings); }),
        getter<Plan>("json", "string", "all of it, as JSON",
                     [](const Plan& of) { return to_json(of).text(2); })};
    c.results = {&planned_term_type(), &planned_buffer_type()};
    c.describe = lines_of<Plan>;
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
