// SPDX-License-Identifier: GPL-3.0-or-later
// Records where a run meets rules of computation that changed between versions (run/changed_laws.cpp), for
// `asperity replay` of earlier runs. Without a listener, a report costs one load.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>

namespace asperity {

enum class Law : int {
  last_digits,       // elementary functions and transforms: every run
  overlap,           // bodies without complete overlap
  plastic_shares,    // two different bodies that both yield
  tilt_weight,       // tilt stage: weight with more pressure than the probes
  approach_control,  // half-spaces by approach, indentation or flattening
  long_cells,        // half-spaces with long narrow cells
  flat_stiffness,    // secant stiffness without approach
  column_units,      // quantities in columns with units, and expectation bounds
  point_units,       // units in headers of x y z and x z files
  alike_readings,    // recordings with readings equalised by a filter
  whole_numbers,     // integers in columns of notebooks
  asked_error,       // cells and tolerance chosen for a requested error
  line_order,        // maps from files with the top line first
  stray_readings,    // recordings with outliers from the line through neighbours
  separation,        // under plastic loading
};
inline constexpr std::size_t law_count = static_cast<std::size_t>(Law::separation) + 1;

// Thread-safe.
class LawsMet {
 public:
  // Clears the record, then stores `line()`, from 1, at the first use of each law; called from any thread. An
  // empty function stops recording.
  void follow(std::function<std::int64_t()> line);
  void meet(Law law) {
    if (followed_.load(std::memory_order_relaxed)) keep(law);
  }
  // 0 if not met.
  std::int64_t first_line(Law law) const;

 private:
  void keep(Law law);

  std::atomic<bool> followed_{false};
  mutable std::mutex mutex_;
  std::function<std::int64_t()> line_;
  std::array<std::int64_t, law_count> lines_{};
};

LawsMet& laws_met();

// Suspends recording on this thread, for trial computations.
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
