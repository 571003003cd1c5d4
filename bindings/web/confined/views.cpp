// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/views.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/core/error.hpp"

namespace asperity::web {

namespace {

static_assert(std::endian::native == std::endian::little, "views are little-endian, as this machine must be");

void add_field(View& view, const std::string& name, const std::string& unit, const Field& field,
               const Grid& grid) {
  ReducedField small = reduced(field);
  view.fields.push_back(Json::object({{"name", name},
                                      {"unit", unit},
                                      {"nx", small.nx},
                                      {"ny", small.ny},
                                      {"size_x", grid.size_x},
                                      {"size_y", grid.size_y},
                                      {"from_nx", grid.nx},
                                      {"from_ny", grid.ny},
                                      {"reduction", reduction_text(small, grid.nx, grid.ny)}}));
  view.values.push_back(std::move(small.values));
}

}  // namespace

ReducedField reduced(const Field& field, int most) {
  const auto block_of = [&](int nodes) { return std::max(1, (nodes + most - 1) / most); };
  ReducedField small;
  small.block_x = block_of(field.nx());
  small.block_y = block_of(field.ny());
  small.nx = (field.nx() + small.block_x - 1) / small.block_x;
  small.ny = (field.ny() + small.block_y - 1) / small.block_y;
  std::vector<double> sums(static_cast<std::size_t>(small.nx));
  std::vector<int> missing(sums.size());
  for (int j = 0; j < small.ny; ++j) {
    std::ranges::fill(sums, 0.0);
    std::ranges::fill(missing, 0);
    const int first = j * small.block_y, end = std::min(first + small.block_y, field.ny());
    for (int row = first; row < end; ++row) {
      const auto values = field.row(row);
      for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t block = i / static_cast<std::size_t>(small.block_x);
        if (std::isnan(values[i]))
          ++missing[block];
        else
          sums[block] += values[i];
      }
    }
    for (int i = 0; i < small.nx; ++i) {
      const int wide = std::min(small.block_x, field.nx() - i * small.block_x);
      const int there = wide * (end - first) - missing[static_cast<std::size_t>(i)];
      small.values.push_back(there > 0 ? static_cast<float>(sums[static_cast<std::size_t>(i)] / there)
                                       : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return small;
}

std::string reduction_text(const ReducedField& field, int from_nx, int from_ny) {
  if (field.block_x == 1 && field.block_y == 1) return "none";
  const bool even = from_nx % field.block_x == 0 && from_ny % field.block_y == 0;
  return "mean of " + std::to_string(field.block_x) + " x " + std::to_string(field.block_y) + " nodes" +
         (even ? "" : ", fewer at the far edges");
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - k);
    unsigned word = 0;
    for (std::size_t b = 0; b < 3; ++b)
      word = word << 8 | (b < count ? static_cast<unsigned char>(bytes[k + b]) : 0U);
    for (std::size_t d = 0; d < 4; ++d) text += d <= count ? digits[word >> (18 - 6 * d) & 63] : '=';
  }
  return text;
}

View view_of(const Surface& surface, const std::string& title, std::int64_t event) {
  View view{title, event};
  add_field(view, "height", "m", surface.measured_heights(), surface.grid());
  if (!surface.complete())
    view.fields[0].set("not_measured",
                       static_cast<std::int64_t>(surface.grid().nodes() - surface.measured()));
  return view;
}

View view_of(const State& state, const std::string& title, std::int64_t event) {
  View view{title, event};
  struct Shown {
    const char *name, *unit;
  };
  for (const Shown& shown :
       {Shown{"pressure", "Pa"}, Shown{"gap", "m"}, Shown{"contact", ""}, Shown{"plastic", "m"}}) {
    try {
      add_field(view, shown.name, shown.unit, *state.field(shown.name), state.grid());
    } catch (const Error& error) {
      // The contact lacks this effect.
      if (error.code() != ErrorCode::bad_state) throw;
    }
  }
  return view;
}

Json to_json(const View& view) {
  Json::List fields = view.fields;
  for (std::size_t k = 0; k < fields.size(); ++k)
    fields[k].set("data", base64({reinterpret_cast<const char*>(view.values[k].data()),
                                  view.values[k].size() * sizeof(float)}));
  return Json::object({{"title", view.title}, {"event", view.event}, {"fields", std::move(fields)}});
}

}  // namespace asperity::web
