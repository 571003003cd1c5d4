// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/preconditioner/line_extension.hpp"

#include <algorithm>

#include "engine/core/parallel.hpp"

namespace asperity {

namespace {
// Longer than wide by so much: of noise and waves on 96 x 96 cells, from 4 to 1000 times longer, sweeps took
// fewer steps below and lines fewer above, or sweeps did not end at all.
constexpr double long_cells = 25, long_cells_of_free_tile = 50;
}  // namespace

bool LineExtension::serves(double aspect, Boundary boundary) {
  const double longest = boundary == Boundary::periodic ? long_cells : long_cells_of_free_tile;
  return aspect >= longest || aspect * longest <= 1;
}

LineExtension::LineExtension(int nx, int ny, Boundary boundary, bool along_x)
    : lines_(along_x ? ny : nx),
      length_(along_x ? nx : ny),
      line_step_(along_x ? static_cast<std::size_t>(nx) : 1),
      node_step_(along_x ? 1 : static_cast<std::size_t>(nx)),
      wraps_(boundary == Boundary::periodic),
      begin_(static_cast<std::size_t>(lines_) + 1),
      beside_(static_cast<std::size_t>(lines_)) {
  free_.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
}

std::int64_t LineExtension::bytes(int nx, int ny) {
  const std::int64_t sides = static_cast<std::int64_t>(nx) + ny;
  return static_cast<std::int64_t>(sizeof(int)) * nx * ny +
         static_cast<std::int64_t>(sizeof(std::size_t) + sizeof(Beside)) * (sides + 1);
}

void LineExtension::set_free(std::span<const std::uint8_t> free) {
  free_.clear();
  for (int line = 0; line < lines_; ++line) {
    begin_[static_cast<std::size_t>(line)] = free_.size();
    for (int k = 0; k < length_; ++k)
      if (free[place(line, k)] != 0) free_.push_back(k);
  }
  begin_[static_cast<std::size_t>(lines_)] = free_.size();

  std::vector<int> held;  // lines that hold free nodes
  for (int line = 0; line < lines_; ++line)
    if (!free_of(line).empty()) held.push_back(line);
  std::fill(beside_.begin(), beside_.end(), Beside{});
  if (held.empty()) return;
  std::size_t next = 0;
  for (int line = 0; line < lines_; ++line) {
    while (next < held.size() && held[next] < line) ++next;
    Beside& beside = beside_[static_cast<std::size_t>(line)];
    if (next < held.size() && held[next] == line) {
      beside = {line, line, 0};
      continue;
    }
    int low = next > 0 ? held[next - 1] : held.back() - lines_;
    int high = next < held.size() ? held[next] : held.front() + lines_;
    if (!wraps_) {
      low = std::max(low, 0) == low ? low : high;
      high = high < lines_ ? high : low;
    }
    const float share = high > low ? static_cast<float>(line - low) / static_cast<float>(high - low) : 0.0f;
    beside = {(low + lines_) % lines_, high % lines_, share};
  }
}

template <class Share>
void LineExtension::each_between(int line, const Share& share) const {
  const std::span<const int> free = free_of(line);
  const auto stretch = [&](int low, int high, int from, int to, int low_place, int high_place) {
    for (int k = from; k < to; ++k)
      share(k % length_, low_place, high_place,
            high > low ? static_cast<float>(k - low) / static_cast<float>(high - low) : 0.0f);
  };
  for (std::size_t i = 0; i + 1 < free.size(); ++i)
    stretch(free[i], free[i + 1], free[i] + 1, free[i + 1], free[i], free[i + 1]);
  const int first = free.front(), last = free.back();
  if (wraps_) {
    stretch(last, first + length_, last + 1, first + length_, last, first);
  } else {
    stretch(first, first, 0, first, first, first);
    stretch(last, last, last + 1, length_, last, last);
  }
}

void LineExtension::extend(std::span<float> field) const {
  parallel_for(lines_, [&](std::int64_t l) {
    const int line = static_cast<int>(l);
    if (free_of(line).empty()) return;
    each_between(line, [&](int k, int low, int high, float t) {
      field[place(line, k)] = (1 - t) * field[place(line, low)] + t * field[place(line, high)];
    });
  });
  parallel_for(lines_, [&](std::int64_t l) {
    const int line = static_cast<int>(l);
    if (!free_of(line).empty()) return;
    const Beside& beside = beside_[static_cast<std::size_t>(line)];
    for (int k = 0; k < length_; ++k)
      field[place(line, k)] = beside.low < 0 ? 0.0f
                                             : (1 - beside.share) * field[place(beside.low, k)] +
                                                   beside.share * field[place(beside.high, k)];
  });
}

void LineExtension::gather(std::span<float> field) const {
  // Not in parallel: several lines may give to the same one.
  for (int line = 0; line < lines_; ++line) {
    const Beside& beside = beside_[static_cast<std::size_t>(line)];
    if (beside.low == line) continue;
    for (int k = 0; k < length_; ++k) {
      const float value = field[place(line, k)];
      if (beside.low >= 0) {
        field[place(beside.low, k)] += (1 - beside.share) * value;
        field[place(beside.high, k)] += beside.share * value;
      }
      field[place(line, k)] = 0;
    }
  }
  parallel_for(lines_, [&](std::int64_t l) {
    const int line = static_cast<int>(l);
    if (free_of(line).empty()) return;
    each_between(line, [&](int k, int low, int high, float t) {
      const float value = field[place(line, k)];
      field[place(line, low)] += (1 - t) * value;
      field[place(line, high)] += t * value;
      field[place(line, k)] = 0;
    });
  });
}

}  // namespace asperity
