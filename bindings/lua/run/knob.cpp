// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/run/run.hpp"

#include <string>
#include <utility>

#include "bindings/lua/registry/session.hpp"
#include "engine/core/require.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::lua {

namespace {

struct KnobKeys : RunKnob {
  // The key that fixed the dimension; empty after plain numbers.
  std::string told_by, told;
};

// The first quantity with a unit fixes the dimension.
Option<KnobKeys> knob_quantity(StaticText name, double RunKnob::*member, StaticText sentence) {
  return custom<KnobKeys>(
             name, "number|string", sentence,
             [member](const Argument& value, const OptionInfo& info, KnobKeys& keys, Problems& problems) {
               const auto quantity = detail::read_any_quantity(
                   value, info.name, "a number or a quantity such as \"20 MPa\"", problems);
               if (!quantity) return;
               keys.*member = quantity->value;
               if (quantity->dimension == dimension::number) return;
               const std::string text(value.text());
               if (!keys.told_by.empty() && quantity->dimension != keys.dimension)
                 return problems.push_back(quoted(info.name) + " is " + quoted(text) + ", " +
                                           describe(quantity->dimension) + ", and " + quoted(keys.told_by) +
                                           " is " + quoted(keys.told) + ", " + describe(keys.dimension) +
                                           "; give quantities of one kind");
               keys.dimension = quantity->dimension;
               keys.told_by = info.name;
               keys.told = text;
             })
      .required();
}

const Block<KnobKeys> knob_block{
    {text("name", &RunKnob::name, "by which it is set; the same one in a script is the same knob").required(),
     knob_quantity("from", &RunKnob::from, "the lower end of its slider; above 0 with log"),
     knob_quantity("to", &RunKnob::to, "the upper end"),
     knob_quantity("value", &RunKnob::value, "what it is unless it is set otherwise, between the two"),
     flag("log", &RunKnob::log, "equal ways of the slider are equal ratios")},
    [](KnobKeys& keys, Problems& problems) {
      if (problems.empty()) detail::collect(problems, [&] { require_knob(keys); });
    }};

Values make_knob(Call& call) {
  const KnobKeys keys = call.options(knob_block);
  const Session& session = call.session();
  const double value = session.knobs->make(keys);
  if (session.notes != nullptr) session.notes->knobs.push_back(keys);
  note_knobs(session);
  return {value};
}

// Bounds or value may be unknown.
void look_at_knob(const Call& call) {
  if (!call.argument(1).is_table()) return;
  with_key(call.argument(1), "name", [&](const Argument& name) {
    if (name.is_text()) call.session().knobs->met(std::string(name.text()));
  });
}

Values set_knob(Call& call) {
  const std::string name = call.text(1, "name");
  const Argument value = call.argument(2);
  if (!value.is_number() && !value.is_text())
    refuse("`value` is " + value.describe(), "give a number or a quantity such as \"50 MPa\"");
  Session& session = call.session();
  if (!session.move_knob)
    throw Error(ErrorCode::not_permitted, "a script does not move its knobs: it would run itself again",
                "set one from outside, by asperity run SCRIPT --knob " + name +
                    "=..., in the prompt, or on the page");
  const std::string text = value.is_number() ? format_exact(value.number()) : std::string(value.text());
  (void)session.knobs->value_of(name, text);
  session.move_knob(name, text);
  return {};
}

}  // namespace

void note_knobs(const Session& session) {
  if (session.run != nullptr && !session.is_case && !session.knobs->empty())
    session.run->note("knobs", session.knobs->json());
}

Module knob_module() {
  Module m{"lab.knob", "Numbers of a script that whoever runs it may set otherwise."};
  m.functions = {
      {.name = "set",
       .body = set_knob,
       .sentence = "Moves a knob in the prompt. After the line has ended, all entered lines run again from "
                   "the start with the new value; heavy calls with unchanged inputs are taken from memory. "
                   "If the run fails, nothing changes. A script cannot move its own knobs.",
       .parameters = {{"name", "string", "of a knob that was made"},
                      {"value", "number|string", "between its bounds; a plain number is SI"}},
       .example = "-- lab.knob.set(\"pressure\", \"50 MPa\")"}};
  m.call =
      Function{.name = "knob",
               .body = make_knob,
               .sentence =
                   "A number that may be set from outside within bounds; returns its value, in SI. A slider "
                   "on the page, `lab.knob.set` in the prompt, `--knob pressure=\"50 MPa\"` on the command "
                   "line. A run records the values it was made with, and replay and resume take those.",
               .options = &knob_block,
               .returns = "number",
               .example =
                   "local p = lab.knob{ name=\"pressure\", from=\"1 MPa\", to=\"200 MPa\", value=\"20 MPa\", "
                   "log=true }",
               .look = look_at_knob};
  return m;
}

}  // namespace asperity::lua
