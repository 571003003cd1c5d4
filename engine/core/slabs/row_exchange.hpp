// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a field in slabs that a process needs and others hold: the ones beyond its rim, or those of a grid
// that is dealt out in another way. Every process can work out what every other one needs, so nothing is
// asked for. Costs the rows that change hands, and memory for them twice.
#pragma once

#include <functional>
#include <vector>

#include "engine/core/memory.hpp"
#include "engine/core/slabs/team.hpp"

namespace asperity {

class RowExchange {
 public:
  // The rows that rank r needs, in the order in which they are handed to it; any may come more than once.
  using Needs = std::function<std::vector<int>(int rank)>;

  // All processes together.
  RowExchange(Team& team, const Slab& from, const Needs& needs);

  // All together. `pack` gives own row j of this process, counted from its first, `place` takes the k-th
  // needed row. Neither may throw.
  using Pack = std::function<void(int j, double* to)>;
  using Place = std::function<void(std::size_t k, const double* row)>;
  void run(const Pack& pack, const Place& place);

  std::size_t needed() const { return order_.size(); }

 private:
  Team& team_;
  Slab from_;
  std::vector<int> sent_;           // own rows, in the order of the processes that need them
  std::vector<std::size_t> order_;  // place in `in_` of each needed row
  std::vector<int> out_counts_, in_counts_;
  Array<double> out_, in_;
};

// The `depth` rows before a slab, then as many after it, round the rim; none of an empty one.
RowExchange rim_rows(Team& team, const Slab& slab, int depth);

}  // namespace asperity
