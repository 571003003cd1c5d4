// SPDX-License-Identifier: GPL-3.0-or-later
// The knobs of a run: numbers that a script asks for by name, within bounds that it names, and that whoever
// runs it may set otherwise: on the command line, in the prompt, on the page, or by the record of an earlier
// run. A knob is made where the script asks for it; a value may be given for it before. Values are SI.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "engine/core/files/json.hpp"
#include "engine/core/quantity.hpp"

namespace asperity {

// As a script asks for it.
struct RunKnob {
  std::string name;
  double from = 0, to = 0;  // from < to
  double value = 0;         // of the script; within the bounds
  bool log = false;         // whether equal ways of a slider are equal ratios; needs from > 0
  Dimension dimension{};
  bool operator==(const RunKnob&) const = default;
};

// Throws Error{bad_value} unless it is one: a name without `=` and control characters, from < to, the value
// between them, all finite, from > 0 with `log`.
void require_knob(const RunKnob& knob);

// "1 MPa to 200 MPa"
std::string bounds_text(const RunKnob& knob);

// Values that were given, by the names of their knobs, as text: "50 MPa", or a plain number, which is SI.
using GivenKnobs = std::map<std::string, std::string>;
// Sets one; `text` may stand in quotes. Throws Error{bad_value} for what can be no name, for a text that is
// no quantity, and for a name that was given before.
void give_knob(GivenKnobs& given, const std::string& name, const std::string& text);
// Of the member `knobs` of a manifest.
GivenKnobs given_knobs(const Json& recorded);
// As given_knobs() reads it: each with its value alone.
Json given_knobs_json(const GivenKnobs& given);

// Shared by the states of a run and of its ensembles' cases. Thread-safe.
class RunKnobs {
 public:
  RunKnobs() = default;
  explicit RunKnobs(const GivenKnobs& given);

  // The value in force: what was given for it, or its own. Throws Error{bad_value} unless require_knob()
  // holds, where it was made before otherwise, and where what was given is of another kind or out of bounds.
  double make(const RunKnob& knob);
  // Of a dry run, which does not know the value or the bounds: that the script asks for a knob of this name.
  void met(const std::string& name);
  // What `text` sets it to. Throws Error{unknown_name} where no such knob was made, Error{bad_value} as
  // make().
  double value_of(const std::string& name, const std::string& text) const;

  struct Made {
    RunKnob knob;
    double value = 0;  // in force
  };
  std::vector<Made> made() const;  // in the order in which they were made
  bool empty() const;
  // As if those made after the first `count` had not been: a line that made them failed.
  void keep_first(std::size_t count);

  // Throws Error{unknown_name} for a value that was given and whose knob the script did not make.
  void check_all_made() const;

  // What was given, with exact values, for keys of what depends on it; "" for nothing.
  std::string given_text() const;
  // For a manifest: name -> value, from, to, log, unit (SI); those given that are not made with their value
  // alone.
  Json json() const;

 private:
  struct Given {
    Quantity quantity;
    std::string text;
  };
  double value_for(const RunKnob& knob, const Given& given) const;

  std::map<std::string, Given> given_;  // not changed after it was made
  mutable std::mutex mutex_;            // of what follows
  std::vector<Made> made_;
  std::set<std::string> met_;
};

}  // namespace asperity
