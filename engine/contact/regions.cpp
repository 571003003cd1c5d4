// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/regions.hpp"

#include "engine/core/monitor.hpp"

namespace asperity {

namespace {

class Forest {
 public:
  std::uint32_t add(std::int64_t nodes) {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    nodes_.push_back(nodes);
    return parent_.back();
  }
  // Lowest number as root: regions keep the order of first runs.
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    nodes_[a] += nodes_[b];
  }
  Array<std::int64_t> sizes() const {
    Array<std::int64_t> result;
    for (std::size_t k = 0; k < parent_.size(); ++k)
      if (parent_[k] == k) result.push_back(nodes_[k]);
    return result;
  }

 private:
  std::uint32_t root(std::uint32_t k) {
    while (parent_[k] != k) {
      parent_[k] = parent_[parent_[k]];
      k = parent_[k];
    }
    return k;
  }
  Array<std::uint32_t> parent_;
  Array<std::int64_t> nodes_;
};

struct Run {
  int begin, end;  // columns [begin, end)
  std::uint32_t number;
};
using Row = std::vector<Run>;

void cut_into_runs(std::span<const std::uint8_t> row, Forest& forest, Row& runs) {
  runs.clear();
  const auto nx = static_cast<int>(row.size());
  for (int i = 0; i < nx;) {
    if (row[static_cast<std::size_t>(i)] == 0) {
      ++i;
      continue;
    }
    const int begin = i;
    while (i < nx && row[static_cast<std::size_t>(i)] != 0) ++i;
    runs.push_back({begin, i, forest.add(i - begin)});
  }
}

// `diagonal`: 1 joins corners.
void join_rows(const Row& above, const Row& below, int diagonal, int nx, bool wrap, Forest& forest) {
  std::size_t a = 0, b = 0;
  while (a < above.size() && b < below.size()) {
    if (above[a].begin < below[b].end + diagonal && below[b].begin < above[a].end + diagonal)
      forest.join(above[a].number, below[b].number);
    if (above[a].end < below[b].end)
      ++a;
    else
      ++b;
  }
  if (!wrap || diagonal == 0 || above.empty() || below.empty()) return;
  if (above.front().begin == 0 && below.back().end == nx)
    forest.join(above.front().number, below.back().number);
  if (below.front().begin == 0 && above.back().end == nx)
    forest.join(below.front().number, above.back().number);
}

}  // namespace

Array<std::int64_t> region_sizes(std::span<const std::uint8_t> mask, int nx, int ny, Neighbours neighbours,
                                 bool wrap) {
  const int diagonal = neighbours == Neighbours::eight ? 1 : 0;
  const auto width = static_cast<std::size_t>(nx);
  Forest forest;
  Row first, previous, current;
  for (int j = 0; j < ny; ++j) {
    if (j % 256 == 0) stop_flag().check();
    cut_into_runs(mask.subspan(static_cast<std::size_t>(j) * width, width), forest, current);
    if (wrap && current.size() > 1 && current.front().begin == 0 && current.back().end == nx)
      forest.join(current.front().number, current.back().number);
    if (j == 0)
      first = current;
    else
      join_rows(previous, current, diagonal, nx, wrap, forest);
    std::swap(previous, current);
  }
  if (wrap && ny > 1) join_rows(previous, first, diagonal, nx, wrap, forest);
  return forest.sizes();
}

bool has_open_path(std::span<const std::uint8_t> mask, int nx, int ny, PathDirection along, bool wrap) {
  const bool by_columns = along == PathDirection::x;
  const int length = by_columns ? nx : ny, width = by_columns ? ny : nx;
  const auto node = [&](int step, int across) {
    return by_columns ? static_cast<std::size_t>(across) * static_cast<std::size_t>(nx) +
                            static_cast<std::size_t>(step)
                      : static_cast<std::size_t>(step) * static_cast<std::size_t>(nx) +
                            static_cast<std::size_t>(across);
  };
  struct Place {
    int step, across;
  };
  Array<std::uint8_t> seen(mask.begin(), mask.end());
  std::vector<Place> next;
  const auto visit = [&](int step, int across) {
    if (wrap) across = (across + width) % width;
    if (step < 0 || across < 0 || across >= width || seen[node(step, across)] != 0) return;
    seen[node(step, across)] = 1;
    next.push_back({step, across});
  };
  for (int across = 0; across < width; ++across) visit(0, across);
  while (!next.empty()) {
    const Place at = next.back();
    next.pop_back();
    if (at.step == length - 1) return true;
    visit(at.step + 1, at.across);
    visit(at.step, at.across + 1);
    visit(at.step, at.across - 1);
    visit(at.step - 1, at.across);
  }
  return false;
}

BoundaryEdges boundary_edges(std::span<const std::uint8_t> mask, int nx, int ny, bool wrap) {
  BoundaryEdges edges;
  const auto width = static_cast<std::size_t>(nx);
  auto differ = [](const std::uint8_t* a, const std::uint8_t* b, std::size_t n) {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < n; ++i) count += (a[i] != 0) != (b[i] != 0) ? 1 : 0;
    return count;
  };
  for (int j = 0; j < ny; ++j) {
    const std::uint8_t* row = mask.data() + static_cast<std::size_t>(j) * width;
    edges.between_columns += differ(row, row + 1, width - 1);
    if (wrap && nx > 1) edges.between_columns += differ(row + width - 1, row, 1);
    if (j + 1 < ny) edges.between_rows += differ(row, row + width, width);
  }
  if (wrap && ny > 1)
    edges.between_rows += differ(mask.data() + static_cast<std::size_t>(ny - 1) * width, mask.data(), width);
  return edges;
}

}  // namespace asperity
