// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/recording_marks.hpp"

#include <algorithm>

namespace asperity {

void LineMoments::add(double time, double value) { *this = joined({1, time, value, 0, 0, 0}); }

LineMoments LineMoments::joined(const LineMoments& next) const {
  if (n == 0) return next;
  if (next.n == 0) return *this;
  const double all = n + next.n, dt = next.t - t, dy = next.y - y, weight = n * next.n / all;
  return {all,
          t + dt * next.n / all,
          y + dy * next.n / all,
          tt + next.tt + weight * dt * dt,
          ty + next.ty + weight * dt * dy,
          yy + next.yy + weight * dy * dy};
}

double LineMoments::misfit() const { return std::max(0.0, tt > 0 ? yy - ty * (ty / tt) : yy); }

namespace {

// Outdated once a piece has changed.
struct Join {
  double cost;
  std::uint32_t left, right, left_last, right_last;
  bool operator>(const Join& other) const {
    return cost != other.cost ? cost > other.cost : left > other.left;
  }
};

class Joiner {
 public:
  Joiner(std::span<const double> time, std::span<const double> value, Monitor& monitor)
      : task_(monitor, "detecting events", static_cast<std::int64_t>(time.size())) {
    pieces_.reserve((time.size() + 1) / 2);
    for (std::size_t k = 0; k < time.size(); k += 2) {
      StraightPiece piece{k, std::min(k + 1, time.size() - 1), {}};
      for (std::size_t i = piece.first; i <= piece.last; ++i) piece.line.add(time[i], value[i]);
      pieces_.push_back(piece);
    }
    next_.resize(pieces_.size());
    previous_.resize(pieces_.size());
    for (std::uint32_t k = 0; k < pieces_.size(); ++k) {
      next_[k] = k + 1;
      previous_[k] = k - 1;  // wraps for the first
    }
  }

  Array<StraightPiece> join(double most) {
    const auto count = static_cast<std::uint32_t>(pieces_.size());
    Array<Join> first;
    first.reserve(2 * pieces_.size());
    most_ = most;
    for (std::uint32_t k = 0; k + 1 < count; ++k) offer(first, k, k + 1);
    std::make_heap(first.begin(), first.end(), std::greater<>());
    while (!first.empty()) {
      const Join best = first.front();
      std::pop_heap(first.begin(), first.end(), std::greater<>());
      first.pop_back();
      StraightPiece& left = pieces_[best.left];
      StraightPiece& right = pieces_[best.right];
      if (left.line.n == 0 || right.line.n == 0 || left.last != best.left_last ||
          right.last != best.right_last)
        continue;
      left.line = left.line.joined(right.line);
      left.last = right.last;
      right.line.n = 0;
      const std::uint32_t after = next_[best.right];
      next_[best.left] = after;
      if (after < count) previous_[after] = best.left;
      if (const std::uint32_t before = previous_[best.left]; before < count)
        offer_on_heap(first, before, best.left);
      if (after < count) offer_on_heap(first, best.left, after);
      task_.advance(2);
    }
    Array<StraightPiece> left;
    for (std::uint32_t k = 0; k < count; k = next_[k]) left.push_back(pieces_[k]);
    return left;
  }

 private:
  void offer(Array<Join>& joins, std::uint32_t left, std::uint32_t right) const {
    const LineMoments& a = pieces_[left].line;
    const LineMoments& b = pieces_[right].line;
    const double cost = a.joined(b).misfit() - a.misfit() - b.misfit();
    if (cost <= most_)
      joins.push_back({cost, left, right, static_cast<std::uint32_t>(pieces_[left].last),
                       static_cast<std::uint32_t>(pieces_[right].last)});
  }
  void offer_on_heap(Array<Join>& joins, std::uint32_t left, std::uint32_t right) const {
    const std::size_t before = joins.size();
    offer(joins, left, right);
    if (joins.size() > before) std::push_heap(joins.begin(), joins.end(), std::greater<>());
  }

  Task task_;
  double most_ = 0;
  Array<StraightPiece> pieces_;
  Array<std::uint32_t> next_, previous_;
};

// To the least total misfit.
void move_cut(std::span<const double> time, std::span<const double> value, StraightPiece& left,
              StraightPiece& right, Array<double>& after) {
  const std::size_t first = left.first, last = right.last, count = last - first + 1;
  after.assign(count, 0);
  LineMoments sums;
  for (std::size_t k = count; k-- > 1;) {
    sums.add(time[first + k], value[first + k]);
    after[k] = sums.misfit();
  }
  sums = {};
  std::size_t best = left.last;
  double least = left.line.misfit() + right.line.misfit();
  least -= 1e-12 * least;
  for (std::size_t k = 0; k + 1 < count; ++k) {
    sums.add(time[first + k], value[first + k]);
    const double both = sums.misfit() + after[k + 1];
    if (both < least) {
      least = both;
      best = first + k;
    }
  }
  if (best == left.last) return;
  left = {first, best, {}};
  right = {best + 1, last, {}};
  for (std::size_t i = first; i <= best; ++i) left.line.add(time[i], value[i]);
  for (std::size_t i = best + 1; i <= last; ++i) right.line.add(time[i], value[i]);
}

}  // namespace

Array<StraightPiece> straight_pieces(std::span<const double> time, std::span<const double> value,
                                     double noise, double evidence, Monitor& monitor) {
  Array<StraightPiece> pieces = Joiner(time, value, monitor).join(evidence * noise * noise);
  Array<double> after;
  for (int round = 0; round < 2; ++round)
    for (std::size_t k = 0; k + 1 < pieces.size(); ++k)
      move_cut(time, value, pieces[k], pieces[k + 1], after);
  return pieces;
}

}  // namespace asperity
