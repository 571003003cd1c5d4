// SPDX-License-Identifier: GPL-3.0-or-later
// The rounding mode that results are defined in. A program that loads the module may round upward or towards
// zero for purposes of its own (interval arithmetic); what the engine computes must not depend on it.
#pragma once

#include <cfenv>

namespace asperity {

// While it lives, this thread, and threads it starts, round to nearest; then as before. A few nanoseconds.
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
