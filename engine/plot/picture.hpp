// SPDX-License-Identifier: GPL-3.0-or-later
// PNG pictures of a field by gnuplot: maps to scale, y upwards, with scale bar and colour bar; or reliefs.
// Large grids are reduced first.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/grid.hpp"
#include "engine/plot/chart.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

struct PictureOptions {
  std::string title;
  std::string label = "height";     // of the colour bar
  std::string unit = "m";           // of the values; "" for plain numbers
  std::string palette = "viridis";  // "contact": a mask of 0 and 1 with a key
  std::optional<Range> range;       // of the colours, in `unit`; default: of the values
  int width = 1000;                 // pixels, 200 … 4000; tall maps take less
  enum class View { map, relief } view = View::map;
};

// The script, and the bytes of its data file `cells` (32-bit floats).
struct PictureScript {
  std::string script;
  std::string cells;
};

// Non-finite values stay blank; strips (aspect above 20) are not to scale. Throws Error{bad_value} for a
// field unlike the grid, no finite value, a bad `width` or `range`; Error{unknown_name} for the palette.
PictureScript picture_script(const Grid& grid, const Field& field, const PictureOptions& options);

// Replaces `file` (.png) atomically; returns gnuplot's complaints. Throws like picture_script, run_gnuplot,
// write_atomically.
std::vector<std::string> draw(const Grid& grid, const Field& field, const PictureOptions& options,
                              const std::filesystem::path& file);
// Holes stay blank.
std::vector<std::string> draw(const Surface& surface, const PictureOptions& options,
                              const std::filesystem::path& file);

// Area-weighted means of finite values over columns × rows patches or fewer.
Field reduced(const Field& field, int columns, int rows);

// Heights along the trace, or closed outlines to scale. Long traces keep the extremes of stretches.
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
