// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/cost.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace asperity {

namespace {
thread_local double thread_transforms = 0;
thread_local double thread_limit = std::numeric_limits<double>::infinity();
thread_local std::int64_t thread_held = 0;
thread_local std::int64_t thread_peak = 0;
}  // namespace

namespace cost {
// Steps of 2^-24 make sums and differences exact.
void count_transforms(double weighted) {
  constexpr double steps = 1 << 24;
  thread_transforms += std::round(weighted * steps) / steps;
  if (thread_transforms > thread_limit) throw TransformLimit::Spent();
}
void count_bytes(std::int64_t change) noexcept {
  thread_held += change;
  thread_peak = std::max(thread_peak, thread_held);
}
double transforms() { return thread_transforms; }
double processor_seconds() {
  timespec spent{};
  return ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent) == 0
             ? static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec)
             : 0;
}
}  // namespace cost

Cost& Cost::operator+=(const Cost& other) {
  seconds += other.seconds;
  transforms += other.transforms;
  bytes = std::max(bytes, other.bytes);
  return *this;
}

TransformLimit::TransformLimit(double most) : outer_(std::exchange(thread_limit, thread_transforms + most)) {}
TransformLimit::~TransformLimit() { thread_limit = outer_; }

CostScope::CostScope()
    : start_(std::chrono::steady_clock::now()),
      transforms_(thread_transforms),
      held_(thread_held),
      outer_peak_(thread_peak) {
  thread_peak = thread_held;
}

CostScope::~CostScope() { thread_peak = std::max(thread_peak, outer_peak_); }

Cost CostScope::so_far() const {
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - start_;
  return {since.count(), thread_transforms - transforms_, thread_peak - held_};
}

}  // namespace asperity
