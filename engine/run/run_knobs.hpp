// SPDX-License-Identifier: GPL-3.0-or-later
// Bounded numbers of a script, set by the command line, the prompt, the page, or an earlier run. Values are
// SI.
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

struct RunKnob {
  std::string name;
  double from = 0, to = 0;  // from < to
  double value = 0;         // default, within the bounds
  bool log = false;         // logarithmic slider; needs from > 0
  Dimension dimension{};
  bool operator==(const RunKnob&) const = default;
};

// Throws Error{bad_value} unless the name has no `=` and control characters, from < to, from <= value <= to,
// all finite, and from > 0 with `log`.
void require_knob(const RunKnob& knob);

// "1 MPa to 200 MPa"
std::string bounds_text(const RunKnob& knob);

// By name: "50 MPa", or a number in SI.
using GivenKnobs = std::map<std::string, std::string>;
// `text` may be quoted. Throws Error{bad_value} for an invalid name, no quantity, or a second value.
void give_knob(GivenKnobs& given, const std::string& name, const std::string& text);
// From the member `knobs` of a manifest.
GivenKnobs given_knobs(const Json& recorded);
Json given_knobs_json(const GivenKnobs& given);

// Shared by a run and its ensembles' cases. Thread-safe.
class RunKnobs {
 public:
  RunKnobs() = default;
  explicit RunKnobs(const GivenKnobs& given);

  // The given value, else the default. Throws as require_knob(); Error{bad_value} for a second knob with
  // other keys, another dimension, or a value out of bounds.
  double make(const RunKnob& knob);
  // For a dry run, without value and bounds.
  void met(const std::string& name);
  // Throws Error{unknown_name} without such a knob, Error{bad_value} as make().
  double value_of(const std::string& name, const std::string& text) const;

  struct Made {
    RunKnob knob;
    double value = 0;  // in force
  };
  std::vector<Made> made() const;  // in order
  bool empty() const;
  // After a failed line.
  void keep_first(std::size_t count);

  // Throws Error{unknown_name} for a value without knob.
  void check_all_made() const;

  // Exact, for keys of dependent results.
  std::string given_text() const;
  // Manifest: name -> value, from, to, log, unit (SI); value alone if not made.
  Json json() const;

 private:
  struct Given {
    Quantity quantity;
    std::string text;
  };
  double value_for(const RunKnob& knob, const Given& given) const;

  std::map<std::string, Given> given_;  // constant
  mutable std::mutex mutex_;            // guards all below
  std::vector<Made> made_;
  std::set<std::string> met_;
};

}  // namespace asperity
