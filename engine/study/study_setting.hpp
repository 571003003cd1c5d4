// SPDX-License-Identifier: GPL-3.0-or-later
// What a study of work and precision varies: knobs, which are named numbers, texts and booleans that the
// studied function understands, and ways, which are named rows of settings from coarse to fine. Also
// the knobs as Lua source, to be pasted into a script.
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
using Knobs = std::vector<Knob>;  // each name once, in ascending order

// The number under that name; nothing if there is none or it is no number.
std::optional<double> number_of(const Knobs& knobs, std::string_view name);

// "256", "1e-06", "math.huge", "true", "\"box\"": reads back as the same value.
std::string lua_source(const KnobValue& value);
// "{ cells=256, tolerance=1e-06 }".
std::string lua_source(const Knobs& knobs);

// A knob of a way as a script gives it: one value for all settings, or a list of one for each.
struct KnobSweep {
  std::string name;
  std::vector<KnobValue> values;
  bool swept = false;  // a list
};

struct StudyWay {
  std::string name;
  std::vector<Knobs> settings;
};

// The settings of a way; lists go along together. Without a list there is one setting. Throws
// Error{bad_value} for lists of unequal length, an empty list, a knob given twice, and one named like a
// column of the rows that come out (row_fields).
StudyWay make_way(std::string name, std::vector<KnobSweep> knobs);

// What a row has besides its knobs.
const std::vector<std::string>& row_fields();

// Places of the settings from coarse to fine: the order given, turned round where `cells` falls or
// `tolerance` rises along it.
std::vector<std::size_t> coarse_to_fine(const StudyWay& way);

}  // namespace asperity
