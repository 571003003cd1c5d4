// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of surfaces and contacts as the page shows them in 3-D: at most 256 nodes a side, each the mean
// over a block of nodes (of the contact: the share of it that touches), in single precision. The reduction is
// said with each. Made only of what is shown; nothing here enters a result.
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
  int block_x = 1, block_y = 1;  // nodes of a block; those at the far edges may have fewer
  std::vector<float> values;     // row by row, j first
};

// Blocks of ceil(n / most) nodes a side. Cost: one pass over the field.
ReducedField reduced(const Field& field, int most = most_view_nodes);
// "none", "mean of 4 x 4 nodes", "mean of 3 x 3 nodes, fewer at the far edges".
std::string reduction_text(const ReducedField& field, int from_nx, int from_ny);

std::string base64(std::string_view bytes);

// A view whose numbers stand beside what is said of them.
struct View {
  std::string title;
  std::int64_t event = 0;
  Json::List fields{};                       // each without its member `data`
  std::vector<std::vector<float>> values{};  // of each field
};
View view_of(const Surface& surface, const std::string& title, std::int64_t event);
// Pressure, gap, contact, and what is plastic where that was asked for.
View view_of(const State& state, const std::string& title, std::int64_t event);
// With the numbers of each field as `data`, in base64.
Json to_json(const View& view);

}  // namespace asperity::web
