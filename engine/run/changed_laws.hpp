// SPDX-License-Identifier: GPL-3.0-or-later
// The laws that changed from version to version, told once: which, since when, what held before and what
// holds now, and which results that moves. `asperity replay` of a run by an earlier version lists them and
// compares within them (across_versions.hpp); CHANGELOG.md tells them to users, beside all else that changed.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/laws_met.hpp"

namespace asperity {

struct ChangedLaw {
  Law law;
  std::string_view since;  // the first version in which it holds: "0.2.0"
  std::string_view name;   // "shares of unlike bodies"
  std::string_view before, now;
  std::string_view moves;  // the results it moves
};

// In the order of the enumeration, each once.
std::span<const ChangedLaw> changed_laws();
const ChangedLaw& told(Law law);

// Whether one version is earlier than another; none where one of them is not three numbers, "0.1.0".
std::optional<bool> is_earlier(std::string_view version, std::string_view than);

// Those that changed after `then`, up to and with `now`; empty unless `then` is the earlier one.
std::vector<const ChangedLaw*> laws_changed_between(std::string_view then, std::string_view now);

}  // namespace asperity
