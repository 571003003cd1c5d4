// SPDX-License-Identifier: GPL-3.0-or-later
// Variables of a work-precision study. A knob is a named number, text or boolean; a way is a named list of
// settings from coarse to fine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace asperity {

using KnobValue = std::variant<bool, std::int64_t, double, std::string>;

struct Knob {
  std::string name;
  KnobValue value;
  bool operator==(const Knob&) const = default;
};
using Knobs = std::vector<Knob>;  // unique names, ascending

// Nothing for a missing name or another type.
std::optional<double> number_of(const Knobs& knobs, std::string_view name);

// Lua literals: "256", "1e-06", "math.huge", "\"box\"".
std::string lua_source(const KnobValue& value);
std::string lua_source(const Knobs& knobs);

// One value per way, or one per setting.
struct KnobSweep {
  std::string name;
  std::vector<KnobValue> values;
  bool swept = false;  // a list
};

struct StudyWay {
  std::string name;
  std::vector<Knobs> settings;
};

// Lists advance together; without a list there is one setting. Throws Error{bad_value} for unequal or empty
// lists, repeated knobs and names in row_fields().
StudyWay make_way(std::string name, std::vector<KnobSweep> knobs);

const std::vector<std::string>& row_fields();

// Indices from coarse to fine: the given order, reversed if `cells` falls or `tolerance` rises.
std::vector<std::size_t> coarse_to_fine(const StudyWay& way);

}  // namespace asperity
