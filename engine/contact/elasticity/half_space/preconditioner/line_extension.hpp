// SPDX-License-Identifier: GPL-3.0-or-later
// Carries a residual past the edge of a free set on cells much longer than wide. Lines of nodes along the
// short side hardly know of each other there: |q|/2 makes a jump along a line dear and one from line to line
// cheap. So what lies between two free nodes of a line is interpolated between them, however far apart they
// are, and a line without any between the nearest lines that have some. Linear, with its exact transpose.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/contact/boundary.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

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

  static std::int64_t bytes(int nx, int ny);

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
