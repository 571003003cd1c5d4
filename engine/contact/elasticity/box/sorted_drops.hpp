// SPDX-License-Identifier: GPL-3.0-or-later
// Sorted heights: a query about a plane costs O(log n). A drop is g = max h − h, ascending; a plane at depth
// d shortens box i by max(0, d − g_i). With n boxes touched, the total shortening W(d) = Σ (d − g_i) is
// linear between neighbouring drops, with the inverse d = g_n + (W − W(g_n))/n. Block sums have only
// non-negative terms: W and d are exact to a few ulp.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/core/memory.hpp"

namespace asperity {

// A sum as an unevaluated pair of doubles, exact to about 2⁻¹⁰⁶ per addition (Knuth's TwoSum; Dekker 1971,
// Numer. Math. 18, 224). Powers of two scale the sum bit for bit.
class Accumulator {
 public:
  explicit Accumulator(double start = 0) : high_(start) {}

  void add(double x) {
    const double sum = high_ + x;
    const double part = sum - high_;
    low_ += (high_ - (sum - part)) + (x - part);
    renormalise(sum);
  }
  // The product is not rounded.
  void add_product(double a, double b) {
    const double product = a * b;
    add(product);
    add(std::fma(a, b, -product));
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

// Sorts values >= +0.0 (no -0.0, no NaN) in place. O(n); needs a second array. Checks the stop flag. Radix
// sort of bit patterns (M. Herf, "Radix tricks").
void sort_ascending(Array<double>& values);

class SortedDrops {
 public:
  // At least one height; finite sum of squared drops. O(n); 2 n doubles while sorting, then n.
  explicit SortedDrops(std::span<const double> heights);

  std::size_t size() const { return drops_.size(); }
  std::span<const double> drops() const { return drops_; }
  double peak() const { return peak_; }                    // max h
  double peak_to_valley() const { return drops_.back(); }  // max h − min h
  double rms() const { return rms_; }                      // of h about its mean

  // For depth d >= 0 below the peak; each O(log n).
  std::size_t touched(double d) const;        // boxes with g < d
  double shortening(double d) const;          // Σ max(0, d − g)
  double squared_shortening(double d) const;  // Σ max(0, d − g)²
  double remaining_gap(double d) const;       // Σ max(0, g − d)
  // Inverse of `shortening` for `total` >= 0; 0 for 0. O(log n).
  double depth(double total) const;

  static std::int64_t bytes(std::size_t heights);
  static std::int64_t bytes_while_sorting(std::size_t heights);

 private:
  // At the first drop of a block.
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
