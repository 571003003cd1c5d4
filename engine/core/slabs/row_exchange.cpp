// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/slabs/row_exchange.hpp"

namespace asperity {

RowExchange::RowExchange(Team& team, const Slab& from, const Needs& needs) : team_(team), from_(from) {
  team.work([&] {
    const auto ranks = static_cast<std::size_t>(from.ranks);
    const auto own = static_cast<std::size_t>(from.rank);
    std::vector<std::size_t> from_each(ranks);
    const std::vector<int> needed = needs(from.rank);
    for (const int row : needed) ++from_each[static_cast<std::size_t>(from.owner(row))];
    std::vector<std::size_t> next(ranks);
    for (std::size_t r = 1; r < ranks; ++r) next[r] = next[r - 1] + from_each[r - 1];
    for (const int row : needed) order_.push_back(next[static_cast<std::size_t>(from.owner(row))]++);
    for (std::size_t r = 0; r < ranks; ++r) {
      int count = 0;
      for (const int row : r == own ? needed : needs(static_cast<int>(r)))
        if (from.owner(row) == from.rank) {
          sent_.push_back(row - from.first());
          ++count;
        }
      out_counts_.push_back(count * from.nx);
      in_counts_.push_back(static_cast<int>(from_each[r]) * from.nx);
    }
    out_.resize(sent_.size() * from.width());
    in_.resize(order_.size() * from.width());
  });
  team.agree();
}

void RowExchange::run(const Pack& pack, const Place& place) {
  for (std::size_t k = 0; k < sent_.size(); ++k) pack(sent_[k], out_.data() + k * from_.width());
  team_.exchange(out_.data(), out_counts_.data(), in_.data(), in_counts_.data());
  for (std::size_t k = 0; k < order_.size(); ++k) place(k, in_.data() + order_[k] * from_.width());
}

RowExchange rim_rows(Team& team, const Slab& slab, int depth) {
  return RowExchange(team, slab, [slab, depth](int rank) {
    std::vector<int> rows;
    const int first = slab.first_of(rank), after = first + slab.rows_of(rank);
    if (after == first) return rows;
    const auto wrapped = [&](int row) { return (row % slab.ny + slab.ny) % slab.ny; };
    for (int k = -depth; k < 0; ++k) rows.push_back(wrapped(first + k));
    for (int k = 0; k < depth; ++k) rows.push_back(wrapped(after + k));
    return rows;
  });
}

}  // namespace asperity
