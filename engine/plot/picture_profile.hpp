// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of profiles: heights along the trace, or closed outlines to scale. Long traces keep the extremes
// of stretches.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/plot/chart.hpp"
#include "engine/surface/profile.hpp"

namespace asperity {

struct NamedProfile {
  std::string name;  // in the key; "": not in the key
  Profile profile;
};

// Throws Error{bad_value} for no profile, or open and closed ones mixed.
LineChart profile_chart(std::span<const NamedProfile> profiles, std::string title = {});

// Writes `file` (.svg or .png); returns the warnings. Throws like profile_chart and draw(LineChart).
std::vector<std::string> draw(const Profile& profile, const std::string& title,
                              const std::filesystem::path& file);

}  // namespace asperity
