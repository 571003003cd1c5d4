// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/plot/picture_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"

namespace asperity {

namespace {

constexpr int most_stretches = 2000;  // about two per pixel

void add_trace(const Profile& profile, ChartSeries& series) {
  const auto heights = profile.measured_heights();
  const auto at = [&](std::size_t k) { return static_cast<double>(k) * profile.spacing(); };
  const auto add = [&](std::size_t k) {
    series.x.push_back(at(k));
    series.y.push_back(heights[k]);
  };
  // Adds the extremes and the start of a gap.
  const auto add_stretch_with_gap = [&](std::span<const double> part, std::size_t from) {
    std::size_t low = part.size(), high = part.size(), gap = part.size();
    for (std::size_t k = 0; k < part.size(); ++k) {
      if (std::isnan(part[k])) {
        gap = std::min(gap, k);
        continue;
      }
      if (low == part.size() || part[k] < part[low]) low = k;
      if (high == part.size() || part[k] > part[high]) high = k;
    }
    for (std::size_t k = 0; k < part.size(); ++k)
      if (k == low || k == high || k == gap) add(from + k);
  };
  if (heights.size() <= 2 * most_stretches) {
    for (std::size_t k = 0; k < heights.size(); ++k) add(k);
    return;
  }
  for (std::size_t stretch = 0; stretch < most_stretches; ++stretch) {
    const std::size_t from = stretch * heights.size() / most_stretches;
    const std::size_t to = (stretch + 1) * heights.size() / most_stretches;
    const auto part = heights.subspan(from, to - from);
    if (known_count(part) < part.size()) {
      add_stretch_with_gap(part, from);
      continue;
    }
    const auto [low, high] = std::ranges::minmax_element(part);
    const auto a = from + static_cast<std::size_t>(low - part.begin());
    const auto b = from + static_cast<std::size_t>(high - part.begin());
    add(std::min(a, b));
    if (a != b) add(std::max(a, b));
  }
}

void add_outline(const Profile& profile, ChartSeries& series) {
  const auto heights = profile.measured_heights();
  const double radius = *profile.closed_radius();
  // Repeats the first point.
  for (std::size_t k = 0; k <= heights.size(); ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(heights.size());
    const double r = radius + heights[k % heights.size()];
    series.x.push_back(r * elementary::cos(angle));
    series.y.push_back(r * elementary::sin(angle));
  }
}

}  // namespace

LineChart profile_chart(std::span<const NamedProfile> profiles, std::string title) {
  if (profiles.empty())
    throw Error(ErrorCode::bad_value, "a picture of profiles has none", "give at least one");
  const bool closed = profiles.front().profile.closed();
  LineChart chart;
  chart.title = std::move(title);
  chart.x.label = "x";
  chart.y.label = closed ? "y" : "height";
  chart.x.unit = chart.y.unit = "m";
  chart.equal_axes = closed;
  chart.height = closed ? 860 : 480;
  for (const NamedProfile& item : profiles) {
    if (item.profile.closed() != closed)
      throw Error(ErrorCode::bad_value, "a picture has open traces and closed outlines together",
                  "draw them apart");
    ChartSeries series;
    series.name = item.name;
    series.points = item.profile.measured() == 1;
    series.gaps = !item.profile.complete();
    if (closed) {
      add_outline(item.profile, series);
    } else {
      add_trace(item.profile, series);
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

std::vector<std::string> draw(const Profile& profile, const std::string& title,
                              const std::filesystem::path& file) {
  const NamedProfile item{"", profile};
  return draw(profile_chart({&item, 1}, title), file);
}

}  // namespace asperity
