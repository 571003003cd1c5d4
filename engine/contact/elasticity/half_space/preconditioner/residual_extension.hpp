// SPDX-License-Identifier: GPL-3.0-or-later
// How a residual is carried far past the edge of a free set: as a bilinear field between points some 32 nodes
// apart, of the means of what lies around these points, or, on cells much longer than wide, along lines. A
// residual that varies little from one contact to the next costs next to nothing where it is carried on over
// the ground between them; cut off a few nodes from every contact it pays for a jump around each of them, the
// more of them the larger the grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/contact/boundary.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

// The hat functions of one side of a grid. Periodic: they wrap. Free: there is one on either rim.
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
  Array<int> before;    // of a node: the hat whose point is the last at or before it,
  Array<double> share;  // and the value of the next hat there,
  Array<float> single_share;
  Array<int> end;      // of a hat: the node after the last whose `before` it is,
  Array<double> mass;  // and its sum over all nodes
};

// Part of a row of a smooth field: at its node i, low_share·low[i] + high_share·high[i].
template <class Real>
struct SmoothRow {
  const Real *low, *high;
  Real low_share, high_share;
};

class SmoothExtension {
 public:
  // nx, ny >= 1.
  SmoothExtension(int nx, int ny, Boundary boundary);

  // Sums of values times hats over a rectangle of nodes, given row by row from its first one; those that
  // it has no part in are left out.
  class Sums {
   public:
    Sums(const SmoothExtension& hats, int x, int y, int width, int height);
    void clear();
    // Where the values of row y go: low_share times each to `low` and high_share times each to `high`, as
    // many as the rectangle is wide. `work`: 2·width values, kept between the rows; as precise as the sums
    // are to be.
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
    int band_ = -1;  // hat before the rows that `work` holds
    Array<double> sums_;
  };

  // A field of given values at the points.
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
    Array<Real> rows_;  // those through the points
  };

  std::size_t size() const { return static_cast<std::size_t>(x_.hats) * static_cast<std::size_t>(y_.hats); }
  // What sums over the free nodes are divided by, `free` of all hats being the sums of 1: more than that
  // where few nodes are free, so that a lone contact is not carried on as if it were the ground.
  double divisor(std::size_t hat, double free) const;

 private:
  std::size_t hat(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(x_.hats) + static_cast<std::size_t>(i);
  }
  HatAxis x_, y_;
};

// Carries a residual past the edge of a free set on cells much longer than wide. Lines of nodes along the
// short side hardly know of each other there: |q|/2 makes a jump along a line dear and one from line to line
// cheap. So what lies between two free nodes of a line is interpolated between them, however far apart they
// are, and a line without any between the nearest lines that have some. Linear, with its exact transpose.
class LineExtension {
 public:
  // nx, ny >= 1. `along_x`: lines are rows, else columns.
  LineExtension(int nx, int ny, Boundary boundary, bool along_x);

  // Cells so much longer than wide, or wider than long.
  static bool serves(double aspect, Boundary boundary);

  // The nodes where free[k] != 0.
  void set_free(std::span<const std::uint8_t> free);
  // Of a field given on the free nodes, all others. The same bits for any number of threads.
  void extend(std::span<float> field) const;
  // The transpose: sums of `field`, as extend() has shared them out, on the free nodes, and 0 elsewhere.
  void gather(std::span<float> field) const;

 private:
  // Between which two lines that hold free nodes a line lies; itself twice if it holds some, −1 if none does.
  struct Beside {
    int low = -1, high = -1;
    float share = 0;  // of `high`
  };
  std::size_t place(int line, int k) const {
    return static_cast<std::size_t>(line) * line_step_ + static_cast<std::size_t>(k) * node_step_;
  }
  std::span<const int> free_of(int line) const {
    const auto at = static_cast<std::size_t>(line);
    return std::span(free_).subspan(begin_[at], begin_[at + 1] - begin_[at]);
  }
  // Calls share(k, low, high, t) for each node of a line that is not free, between the free nodes it lies
  // between, t of the way.
  template <class Share>
  void each_between(int line, const Share& share) const;

  int lines_, length_;
  std::size_t line_step_, node_step_;
  bool wraps_;
  Array<int> free_;           // places along their lines, line after line
  Array<std::size_t> begin_;  // of each line in free_, and the end
  std::vector<Beside> beside_;
};

}  // namespace asperity
