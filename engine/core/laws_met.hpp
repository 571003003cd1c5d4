// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the laws that changed from one version to the next a run meets, and where. The places where such a
// law acts say so; `asperity replay` of a run by an earlier version listens, and so knows which differences
// the change explains. Where nobody listens a call costs one load. What changed, and since when, is told in
// run/changed_laws.cpp.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>

namespace asperity {

enum class Law : int {
  last_digits,       // elementary functions and transforms: met by every run
  overlap,           // bodies that do not cover each other
  plastic_shares,    // of two bodies that yield and are not alike
  tilt_weight,       // a weight on the tilt stage that presses harder than the probes
  approach_control,  // half-spaces pressed to an approach, an indentation or a flattening
  long_cells,        // half-spaces on cells much longer than wide
  flat_stiffness,    // secant stiffness without approach
  column_units,      // quantities in columns with a unit, and bounds of expectations on them
  point_units,       // units in the heads of x y z and x z files
  alike_readings,    // recordings in which a filter made neighbouring readings alike
  whole_numbers,     // whole numbers in columns of notebooks
  asked_error,       // cells and tolerance chosen for an error
  line_order,        // maps from files that store the top line first
  stray_readings,    // recordings with readings that leave the line through their neighbours
  separation,        // the separation under plastic loading
};
inline constexpr std::size_t law_count = static_cast<std::size_t>(Law::separation) + 1;

// Thread-safe.
class LawsMet {
 public:
  // Forgets what was met. From here on what `line` says, a number from 1, is kept for each law when it is
  // first met. `line` may be called from any thread. Without a function nothing is kept any more.
  void follow(std::function<std::int64_t()> line);
  void meet(Law law) {
    if (followed_.load(std::memory_order_relaxed)) keep(law);
  }
  // Where it was first met; 0 where it was not.
  std::int64_t first_line(Law law) const;

 private:
  void keep(Law law);

  std::atomic<bool> followed_{false};
  mutable std::mutex mutex_;
  std::function<std::int64_t()> line_;
  std::array<std::int64_t, law_count> lines_{};
};

// One for the process.
LawsMet& laws_met();

// While it lives, laws that this thread meets are not kept: what it does is tried and thrown away.
class LawsUnheard {
 public:
  LawsUnheard();
  ~LawsUnheard();
  LawsUnheard(const LawsUnheard&) = delete;
  LawsUnheard& operator=(const LawsUnheard&) = delete;

 private:
  bool outer_;
};

}  // namespace asperity
