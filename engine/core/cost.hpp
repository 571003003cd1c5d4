// SPDX-License-Identifier: GPL-3.0-or-later
// What a call cost: wall seconds, Fourier transforms and peak bytes. The counters belong to the
// calling thread; parallel_for carries what its helpers count back to the thread that called it.
// Seconds are reported, never used: no number of a result depends on a clock.
#pragma once

#include <chrono>
#include <cstdint>

namespace asperity {

struct Cost {
  double seconds = 0;
  double transforms = 0;   // real 2-D transforms one way, weighted n² log n against the finest grid
  std::int64_t bytes = 0;  // peak of counted memory above what was held when the call began

  Cost& operator+=(const Cost& other);  // seconds and transforms add, bytes takes the larger
};

namespace cost {
// Add to this thread's counters.
void count_transforms(double weighted);
void count_bytes(std::int64_t change) noexcept;
// This thread's running totals; used by parallel_for.
double transforms();
// Of the processor, that this thread has spent; of threads that help it, nothing.
double processor_seconds();
}  // namespace cost

// While it lives, this thread ends what it does by throwing Spent once it has counted more transforms
// than so many. Unlike a clock it stops at the same place on every machine. The inner of two holds.
class TransformLimit {
 public:
  struct Spent {};  // no Error: nobody but whoever set the limit is to catch it
  explicit TransformLimit(double most);
  ~TransformLimit();
  TransformLimit(const TransformLimit&) = delete;
  TransformLimit& operator=(const TransformLimit&) = delete;

 private:
  double outer_;
};

// Measures from construction to stop(). Scopes nest; an inner peak shows in the outer one too.
class CostScope {
 public:
  CostScope();
  ~CostScope();
  CostScope(const CostScope&) = delete;
  CostScope& operator=(const CostScope&) = delete;
  Cost so_far() const;

 private:
  std::chrono::steady_clock::time_point start_;
  double transforms_;
  std::int64_t held_;
  std::int64_t outer_peak_;
};

}  // namespace asperity
