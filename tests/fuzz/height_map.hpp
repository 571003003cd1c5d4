// SPDX-License-Identifier: GPL-3.0-or-later
// Calls a reader for surfaces and profiles: without options, with usual and extreme ones, with holes left.
// Results have finite heights or permitted holes, on a grid of positive size.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/fuzz/target.hpp"

namespace asperity::fuzz {

inline void require_heights(std::span<const double> heights, std::size_t measured, bool filled) {
  require(!heights.empty(), "there are heights");
  const auto finite =
      std::count_if(heights.begin(), heights.end(), [](double h) { return std::isfinite(h); });
  const auto missing = std::count_if(heights.begin(), heights.end(), [](double h) { return std::isnan(h); });
  require(static_cast<std::size_t>(finite + missing) == heights.size(), "heights are finite or missing");
  require(static_cast<std::size_t>(finite) == measured && finite > 0, "what was measured is counted");
  require(!filled || missing == 0, "no hole is left where they are filled");
}

struct Knobs {
  std::string format{};                       // "": detected
  std::string name = "input";                 // the extension counts
  std::size_t bytes_per_byte = 512;           // counted memory per byte of the file
  std::size_t beside = std::size_t{1} << 16;  // fixed allowance
  HoleFill fill = HoleFill::interpolate();
};

inline void read_every_way(std::string_view bytes, const Knobs& knobs) {
  const std::size_t room = knobs.beside + knobs.bytes_per_byte * bytes.size();
  ListeningMonitor monitor;
  ReadOptions surface;
  ReadProfileOptions profile;
  surface.format = profile.format = knobs.format;
  for (const int told : {0, 1, 2, 3, 4}) {
    if (told > 0) {
      const bool usual = told == 1 || told == 4;
      surface.size_x = usual ? 1e-3 : 5e-324;
      surface.size_y = usual ? 1e-3 : 1e308;
      surface.unit = profile.unit = usual ? 1e-6 : 1.0;
      profile.spacing = surface.size_x;
      surface.fill = profile.fill = told == 4 ? HoleFill{} : knobs.fill;
    }
    if (told == 3) {  // for files with positions
      surface.size_x.reset();
      surface.size_y.reset();
      profile.spacing.reset();
      surface.unit_xy = profile.unit_xy = 1e-6;
    }
    const bool filled = surface.fill.kind != HoleFill::Kind::none;
    if (told == 4) surface.unit_xy = profile.unit_xy = std::nullopt;
    refused(room, [&] {
      const Surface found = read_surface(SourceFile(knobs.name, bytes), surface, monitor);
      const Grid& grid = found.grid();
      require(grid.nx >= 1 && grid.ny >= 1 && grid.hx() > 0 && grid.hy() > 0, "the grid has cells");
      require(grid.nodes() == found.measured_heights().size(), "the heights fill the grid");
      require_heights(found.measured_heights().values(), found.measured(), filled);
    });
    refused(room, [&] {
      const Profile found = read_profile(SourceFile(knobs.name, bytes), profile, monitor);
      require(found.spacing() > 0 && std::isfinite(found.spacing()), "the spacing is a length");
      require_heights(found.measured_heights(), found.measured(), filled);
    });
  }
}

inline std::string_view view(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace asperity::fuzz
