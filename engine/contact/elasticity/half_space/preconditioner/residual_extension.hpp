// SPDX-License-Identifier: GPL-3.0-or-later
// Extends a residual far beyond the edge of a free set: a bilinear field of local means at points 32 nodes
// apart or, on long cells, interpolation along lines. This avoids jumps around each contact, which |q|/2
// makes expensive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/contact/scene/boundary.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

struct HatAxis {
  HatAxis(int nodes, Boundary boundary);
  int next(int hat) const { return hat + 1 == hats && wraps ? 0 : hat + 1; }
  template <class Real>
  const Real* shares() const {
    if constexpr (std::is_same_v<Real, double>)
      return share.data();
    else
      return single_share.data();
  }

  bool wraps;
  int hats;
  Array<int> before;    // per node: the last hat at or before it
  Array<double> share;  // per node: value of the next hat
  Array<float> single_share;
  Array<int> end;      // per hat: end of its nodes
  Array<double> mass;  // per hat: sum over all nodes
};

// low_share·low[i] + high_share·high[i].
template <class Real>
struct SmoothRow {
  const Real *low, *high;
  Real low_share, high_share;
};

class SmoothExtension {
 public:
  SmoothExtension(int nx, int ny, Boundary boundary);

  // Over a rectangle, row by row; rows without contribution may be skipped.
  class Sums {
   public:
    Sums(const SmoothExtension& hats, int x, int y, int width, int height);
    void clear();
    // Add low_share times row y to `low`, high_share times to `high`. `work`: 2·width values, preserved
    // between rows.
    template <class Work>
    struct Row {
      Work *low, *high;
      Work low_share, high_share;
    };
    template <class Work>
    Row<Work> row(int y, std::span<Work> work);
    template <class Work>
    void finish(std::span<Work> work);
    void add_to(Array<double>& total) const;

   private:
    const SmoothExtension* hats_;
    int x_, y_, width_;
    int columns_, rows_;
    int band_ = -1;  // hat before the rows in `work`
    Array<double> sums_;
  };

  // Bilinear between the points.
  template <class Real>
  class Field {
   public:
    explicit Field(const SmoothExtension& hats);
    // at_points: size() values.
    void set(std::span<const double> at_points);
    // `factor` times row y from node x on.
    SmoothRow<Real> row(int y, std::size_t x, Real factor = 1) const {
      const HatAxis& across = hats_->y_;
      const std::size_t nx = hats_->x_.before.size();
      const int hat = across.before[static_cast<std::size_t>(y)];
      const Real* const rows = rows_.data() + x;
      const Real up = across.template shares<Real>()[y];
      return {rows + static_cast<std::size_t>(hat) * nx,
              rows + static_cast<std::size_t>(across.next(hat)) * nx, (1 - up) * factor, up * factor};
    }

   private:
    const SmoothExtension* hats_;
    Array<Real> rows_;  // through the points
  };

  std::size_t size() const { return static_cast<std::size_t>(x_.hats) * static_cast<std::size_t>(y_.hats); }
  // Divisor for the hat's sum over the free nodes; `free`: its sum of 1. Exceeds `free`: a lone contact is
  // not spread over the surface.
  double divisor(std::size_t hat, double free) const;

 private:
  std::size_t hat(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(x_.hats) + static_cast<std::size_t>(i);
  }
  HatAxis x_, y_;
};

// For long cells, where only jumps along a line (short side) are expensive. Linear interpolation between the
// free nodes of a line, then between lines with free nodes, with its exact transpose.
class LineExtension {
 public:
  // `along_x`: lines are rows.
  LineExtension(int nx, int ny, Boundary boundary, bool along_x);

  static bool serves(double aspect, Boundary boundary);

  void set_free(std::span<const std::uint8_t> free);
  // From free nodes to all others. Same bits for any number of threads.
  void extend(std::span<float> field) const;
  // The transpose: sums on the free nodes, 0 elsewhere.
  void gather(std::span<float> field) const;

 private:
  // With free nodes; twice itself, −1 if none.
  struct Beside {
    int low = -1, high = -1;
    float share = 0;  // weight of `high`
  };
  std::size_t place(int line, int k) const {
    return static_cast<std::size_t>(line) * line_step_ + static_cast<std::size_t>(k) * node_step_;
  }
  std::span<const int> free_of(int line) const {
    const auto at = static_cast<std::size_t>(line);
    return std::span(free_).subspan(begin_[at], begin_[at + 1] - begin_[at]);
  }
  // share(k, low, high, t) for each other node, t of the way between two free ones.
  template <class Share>
  void each_between(int line, const Share& share) const;

  int lines_, length_;
  std::size_t line_step_, node_step_;
  bool wraps_;
  Array<int> free_;           // positions, line after line
  Array<std::size_t> begin_;  // per line in free_, and the end
  std::vector<Beside> beside_;
};

}  // namespace asperity
