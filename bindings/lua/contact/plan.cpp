// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/plan.hpp"
#include "bindings/lua/contact/state_class.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "engine/core/files/json.hpp"

namespace asperity::lua {

namespace {

const RecordType<PlannedTerm> planned_term_type{
    "PlannedTerm",
    "term",
    "A term of the problem that a press will solve.",
    {{"effect", &PlannedTerm::effect, "that adds it"},
     {"sentence", &PlannedTerm::sentence, "what it is here, with its numbers"}}};

const RecordType<PlannedBuffer> planned_buffer_type{
    "PlannedBuffer",
    "buffer",
    "Expected memory of a press.",
    {{"name", &PlannedBuffer::name, "what it is for"},
     {"bytes", &PlannedBuffer::bytes, "its size"},
     {"kept", &PlannedBuffer::kept,
      "whether for as long as the bodies lie as they do, or only for a moment"}}};

}  // namespace

Class make_class(For<Plan>) {
  Class c{"Plan", "a plan",
          "Plan of a press: the computed terms and the expected cost; print() shows the whole plan."};
  c.fields = {
      getter<&Plan::solver>("solver", "string", "the method of the solution"),
      getter<&Plan::overlap>("overlap_fraction", "number",
                             "share of the tile on which the bodies face each other as they lie"),
      getter<Plan>("terms", "PlannedTerm[]", "the terms of the problem",
                   [](const Plan& of) { return planned_term_type.list(of.terms); }),
      getter<Plan>("buffers", "PlannedBuffer[]", "memory held",
                   [](const Plan& of) { return planned_buffer_type.list(of.buffers); }),
      getter<&Plan::transforms>("transforms", "number",
                                "Fourier transforms expected of a press, in equivalents of the finest grid"),
      getter<&Plan::press>("press", "string",
                           "the press of these numbers and their source; empty if explain had no press"),
      getter<&Plan::bytes_peak>("bytes", "integer", "memory expected, at most"),
      getter<&Plan::seconds>("seconds", "number", "expected for the first press, a rough guess",
                             dimension::time),
      getter<&Plan::effects_run>("effects_run", "string[]", "effects that the scene names"),
      getter<&Plan::effects_off>("effects_off", "string[]",
                                 "effects that it does not name, for which nothing is done"),
      getter<&Plan::warnings>("warnings", "string[]",
                              "of a grid that is too coarse for an effect; the first press gives them too"),
      getter<Plan>("json", "string", "the whole ledger, as JSON",
                   [](const Plan& of) { return to_json(of).text(2); })};
  c.results = {&planned_term_type, &planned_buffer_type};
  c.describe = lines_of<Plan>;
  return c;
}

}  // namespace asperity::lua
