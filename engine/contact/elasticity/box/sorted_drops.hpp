// SPDX-License-Identifier: GPL-3.0-or-later
// Heights sorted once, so that any plane pressed into them is answered in O(log n). A drop is
// g = max h − h, ascending. A plane that has come down by d shortens box i by max(0, d − g_i); with
// n boxes touched the total shortening W(d) = Σ (d − g_i) is linear between neighbouring drops, so
// its inverse is closed form: d = g_n + (W − W(g_n))/n. Sums are kept per block as sums of
// non-negative terms, so nothing cancels and W and d hold to a few ulp. Knows no pressure and no unit.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/core/memory.hpp"

namespace asperity {

// A running sum kept as an unevaluated pair of doubles: each addition is exact to about 2⁻¹⁰⁶ of the
// sum. Source: Knuth's TwoSum and Dekker (1971), "A floating-point technique for extending the
// available precision". Scaling every term by a power of two scales the sum bit for bit.
class Accumulator {
 public:
  explicit Accumulator(double start = 0) : high_(start) {}

  void add(double x) {
    const double sum = high_ + x;
    const double part = sum - high_;
    low_ += (high_ - (sum - part)) + (x - part);
    renormalise(sum);
  }
  // Adds a·b without rounding the product.
  void add_product(double a, double b) {
    const double product = a * b;
    add(product);
    add(std::fma(a, b, -product));
  }
  void add(const Accumulator& other) {
    add(other.high_);
    add(other.low_);
  }
  void subtract(const Accumulator& other) {
    add(-other.high_);
    add(-other.low_);
  }
  double value() const { return high_; }

 private:
  void renormalise(double sum) {
    high_ = sum + low_;
    low_ -= high_ - sum;
  }
  double high_;
  double low_ = 0;
};

// Sorting many non-negative doubles. Their bit patterns sort as integers, so a radix sort on eleven
// bits at a time (M. Herf, "Radix tricks") does it in at most six passes over memory. Sorted doubles
// without NaN are one sequence whatever the method, so the choice of method never shows in a result.
// Ascending, in place. Every value must be >= +0.0 (no -0.0) and not NaN. O(n); a second array of the
// same length is held while it runs. Looks at the stop flag between passes.
void sort_ascending(Array<double>& values);

class SortedDrops {
 public:
  // At least one finite height with a finite range. O(n); holds n doubles and, while sorting, n more.
  // Throws Error{bad_value} when the sum of their squared drops exceeds a double.
  explicit SortedDrops(std::span<const double> heights);

  std::size_t size() const { return drops_.size(); }
  std::span<const double> drops() const { return drops_; }
  double peak() const { return peak_; }                    // max h
  double peak_to_valley() const { return drops_.back(); }  // max h − min h
  double rms() const { return rms_; }                      // of h about its mean

  // For a plane at depth d >= 0 below the peak; each O(log n).
  std::size_t touched(double d) const;        // boxes with g < d
  double shortening(double d) const;          // Σ max(0, d − g)
  double squared_shortening(double d) const;  // Σ max(0, d − g)²
  double remaining_gap(double d) const;       // Σ max(0, g − d)
  // The depth whose total shortening is `total` >= 0; 0 for 0. O(log n).
  double depth(double total) const;

  // Bytes held for a given number of heights, and for a moment while sorting.
  static std::int64_t bytes(std::size_t heights);
  static std::int64_t bytes_while_sorting(std::size_t heights);

 private:
  // Sums over everything before (or from) the first drop of a block, for a plane at that drop.
  struct Checkpoint {
    double shortening = 0;          // Σ_{i<s} (g_s − g_i)
    double squared_shortening = 0;  // Σ_{i<s} (g_s − g_i)²
    double remaining_gap = 0;       // Σ_{i>=s} (g_i − g_s)
  };
  void build_checkpoints();
  void find_rms();

  Array<double> drops_;
  Array<Checkpoint> checkpoints_;
  double peak_ = 0;
  double rms_ = 0;
};

}  // namespace asperity
