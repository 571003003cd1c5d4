// SPDX-License-Identifier: GPL-3.0-or-later
// Results are defined for rounding to nearest; a host may use another mode (interval arithmetic).
#pragma once

#include <cfenv>

namespace asperity {

// For this thread and threads started from it; restores the old mode. Nanoseconds.
class RoundToNearest {
 public:
  RoundToNearest() : before_(std::fegetround()) {
    if (before_ != FE_TONEAREST) std::fesetround(FE_TONEAREST);
  }
  ~RoundToNearest() {
    if (before_ != FE_TONEAREST) std::fesetround(before_);
  }
  RoundToNearest(const RoundToNearest&) = delete;
  RoundToNearest& operator=(const RoundToNearest&) = delete;

 private:
  int before_;
};

}  // namespace asperity
