// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of profiles: heights along the trace, or for a closed outline its shape in the plane, true to
// scale. Several profiles may share a picture. Long traces are drawn by the least and greatest height of
// each stretch, so that no peak is lost.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/plot/chart.hpp"
#include "engine/surface/profile.hpp"

namespace asperity {

struct NamedProfile {
  std::string name;  // in the key; "" keeps it out
  Profile profile;
};

// Throws Error{bad_value} for no profile, or for open and closed ones together.
LineChart profile_chart(std::span<const NamedProfile> profiles, std::string title = {});

// Draws into `file` (.svg or .png). Returns the warnings. Throws as profile_chart and draw(LineChart) do.
std::vector<std::string> draw(const Profile& profile, const std::string& title,
                              const std::filesystem::path& file);

}  // namespace asperity
