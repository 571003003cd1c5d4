// SPDX-License-Identifier: GPL-3.0-or-later
// Surface and contact fields for the page's 3-D view, in single precision. A node is the mean over a block of
// nodes (contact: the contact fraction), at most 256 nodes a side. Views never enter a result.
#pragma once

#include <string>
#include <vector>

#include "engine/contact/state.hpp"
#include "engine/core/files/json.hpp"
#include "engine/core/grid.hpp"
#include "engine/surface/surface.hpp"

namespace asperity::web {

inline constexpr int most_view_nodes = 256;  // a side

struct ReducedField {
  int nx = 0, ny = 0;
  int block_x = 1, block_y = 1;  // nodes; blocks at the far edges may be smaller
  std::vector<float> values;     // row by row, j first
};

// Blocks of ceil(n / most) nodes a side. Cost: one pass.
ReducedField reduced(const Field& field, int most = most_view_nodes);
// "none", "mean of 4 x 4 nodes", "mean of 3 x 3 nodes, fewer at the far edges".
std::string reduction_text(const ReducedField& field, int from_nx, int from_ny);

std::string base64(std::string_view bytes);

struct View {
  std::string title;
  std::int64_t event = 0;
  Json::List fields{};                       // without `data`
  std::vector<std::vector<float>> values{};  // for each field
};
View view_of(const Surface& surface, const std::string& title, std::int64_t event);
// Pressure, gap, contact, and plastic flow if on.
View view_of(const State& state, const std::string& title, std::int64_t event);
// With `data` in base64.
Json to_json(const View& view);

}  // namespace asperity::web
