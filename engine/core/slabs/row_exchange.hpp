// SPDX-License-Identifier: GPL-3.0-or-later
// Exchange of rows of a field in slabs: beyond the rim, or between differently divided grids. Every process
// computes the needs of all.
#pragma once

#include <functional>
#include <vector>

#include "engine/core/memory.hpp"
#include "engine/core/slabs/team.hpp"

namespace asperity {

class RowExchange {
 public:
  // Rows for `rank`, in the order of delivery; repetitions allowed.
  using Needs = std::function<std::vector<int>(int rank)>;

  // All processes together.
  RowExchange(Team& team, const Slab& from, const Needs& needs);

  // Collective. `pack` gives own row j, `place` receives the k-th needed row. Neither may throw.
  using Pack = std::function<void(int j, double* to)>;
  using Place = std::function<void(std::size_t k, const double* row)>;
  void run(const Pack& pack, const Place& place);

  std::size_t needed() const { return order_.size(); }

 private:
  Team& team_;
  Slab from_;
  std::vector<int> sent_;           // own rows, in the order of the receivers
  std::vector<std::size_t> order_;  // position of each needed row in `in_`
  std::vector<int> out_counts_, in_counts_;
  Array<double> out_, in_;
};

// `depth` rows before and after a slab, around the rim; none for an empty slab.
RowExchange rim_rows(Team& team, const Slab& slab, int depth);

}  // namespace asperity
