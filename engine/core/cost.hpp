// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of a call. Counters belong to the calling thread; parallel_for adds its helpers' counts. Results never
// depend on a clock.
#pragma once

#include <chrono>
#include <cstdint>

namespace asperity {

struct Cost {
  double seconds = 0;
  double transforms = 0;   // real 2-D transforms, weighted n² log n relative to the finest grid
  std::int64_t bytes = 0;  // peak of counted memory above the start

  Cost& operator+=(const Cost& other);  // bytes becomes the maximum
};

namespace cost {
void count_transforms(double weighted);
void count_bytes(std::int64_t change) noexcept;
double transforms();
// Excludes helper threads.
double processor_seconds();
}  // namespace cost

// Throws Spent on this thread beyond `most` transforms, at the same place on every machine. The inner limit
// applies.
class TransformLimit {
 public:
  struct Spent {};  // only the code that set the limit may catch it
  explicit TransformLimit(double most);
  ~TransformLimit();
  TransformLimit(const TransformLimit&) = delete;
  TransformLimit& operator=(const TransformLimit&) = delete;

 private:
  double outer_;
};

// Scopes nest; an inner peak also counts for the outer scope.
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
