// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/parameters/hills.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/blocked_sums.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

using NodeNumber = std::uint32_t;

// Descending flood with a union–find forest of land parts.
class Flood {
 public:
  // 1: hills, -1: dales.
  Flood(const Field& z, double sign) : z_(z), sign_(sign), parent_(z.size()), flooded_(z.size(), false) {}

  // Summits at least `rise` above the saddle to a higher one, highest first.
  std::vector<NodeNumber> summits(double rise) {
    const Array<NodeNumber> order = downwards();
    std::iota(parent_.begin(), parent_.end(), NodeNumber{0});
    std::vector<NodeNumber> kept;
    for (const NodeNumber node : order) {
      flooded_[node] = true;
      NodeNumber own = node;  // the part's root is its summit
      around(node, [&](NodeNumber other) {
        if (!flooded_[other]) return;
        const NodeNumber root = find(other);
        if (root == own) return;
        if (own == node) {
          parent_[node] = own = root;
          return;
        }
        // At a saddle the lower summit ends; ties: the later node.
        const bool other_is_lower = height(root) < height(own) || (height(root) == height(own) && root > own);
        const NodeNumber lower = other_is_lower ? root : own, higher = other_is_lower ? own : root;
        if (height(lower) - height(node) >= rise && height(lower) > height(node)) kept.push_back(lower);
        parent_[lower] = own = higher;
      });
    }
    // Remaining summits end at the lowest node of their part; flat parts are no hills.
    Array<double> lowest(z_.size());
    for (const NodeNumber node : order) lowest[find(node)] = height(node);
    for (const NodeNumber node : order)
      if (parent_[node] == node && height(node) - lowest[node] >= rise && height(node) > lowest[node])
        kept.push_back(node);
    std::erase_if(kept, [this](NodeNumber node) { return at_the_rim(node); });
    sort_downwards(kept);
    return kept;
  }

 private:
  double height(NodeNumber node) const { return sign_ * z_[node]; }

  Array<NodeNumber> downwards() const {
    Array<NodeNumber> order;
    order.reserve(z_.size());
    for (std::size_t k = 0; k < z_.size(); ++k)
      if (!std::isnan(z_[k])) order.push_back(static_cast<NodeNumber>(k));
    sort_downwards(order);
    return order;
  }

  void sort_downwards(auto& nodes) const {
    std::ranges::sort(nodes, [this](NodeNumber a, NodeNumber b) {
      return height(a) > height(b) || (height(a) == height(b) && a < b);
    });
  }

  NodeNumber find(NodeNumber node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }

  template <class Visit>
  void around(NodeNumber node, const Visit& visit) const {
    const int nx = z_.nx(), i = static_cast<int>(node) % nx,
              j = static_cast<int>(node / static_cast<NodeNumber>(nx));
    for (int b = std::max(0, j - 1); b <= std::min(z_.ny() - 1, j + 1); ++b)
      for (int a = std::max(0, i - 1); a <= std::min(nx - 1, i + 1); ++a)
        if (a != i || b != j)
          visit(static_cast<NodeNumber>(b) * static_cast<NodeNumber>(nx) + static_cast<NodeNumber>(a));
  }

  bool at_the_rim(NodeNumber node) const {
    int measured = 0;
    around(node, [&](NodeNumber other) { measured += !std::isnan(z_[other]); });
    return measured < 8;
  }

  const Field& z_;
  double sign_;
  Array<NodeNumber> parent_;
  std::vector<bool> flooded_;
};

// Mean distance of the first five from the mean, upwards or (-1) downwards.
std::optional<double> mean_of_five(const Field& z, const std::vector<NodeNumber>& summits, double mean,
                                   double sign) {
  if (summits.size() < 5) return {};
  double sum = 0;
  for (std::size_t k = 0; k < 5; ++k) sum += sign * (z[summits[k]] - mean);
  return sum / 5;
}

}  // namespace

Hills hills(const Surface& surface, double pruning) {
  require(pruning >= 0 && pruning <= 1, "pruning", pruning, "",
          "give the share of Sz that a hill must rise, from 0 to 1");
  const Field& z = surface.measured_heights();
  const Range r = surface.height_range();
  Hills result;
  if (r.span() == 0) return result;
  std::array<std::vector<NodeNumber>, 2> summits;
  parallel_for(2, [&](std::int64_t side) {
    summits[static_cast<std::size_t>(side)] = Flood(z, side == 0 ? 1 : -1).summits(pruning * r.span());
  });
  const auto& [peaks, pits] = summits;
  result.peaks = peaks.size();
  result.pits = pits.size();
  const Grid& grid = surface.grid();
  const double area = static_cast<double>(surface.measured()) * grid.cell_area();
  result.Spd = static_cast<double>(peaks.size()) / area;
  result.Svd = static_cast<double>(pits.size()) / area;
  if (!peaks.empty()) {
    double sum = 0;
    for (const NodeNumber node : peaks) {
      const int i = static_cast<int>(node) % grid.nx, j = static_cast<int>(node) / grid.nx;
      const double x = (z(i + 1, j) - 2 * z(i, j) + z(i - 1, j)) / (grid.hx() * grid.hx());
      const double y = (z(i, j + 1) - 2 * z(i, j) + z(i, j - 1)) / (grid.hy() * grid.hy());
      sum -= (x + y) / 2;
    }
    result.Spc = sum / static_cast<double>(peaks.size());
  }
  const double mean = exact_mean(MeasuredValues(surface).values(), r);
  result.S5p = mean_of_five(z, peaks, mean, 1);
  result.S5v = mean_of_five(z, pits, mean, -1);
  if (result.S5p && result.S5v) result.S10z = *result.S5p + *result.S5v;
  return result;
}

}  // namespace asperity
