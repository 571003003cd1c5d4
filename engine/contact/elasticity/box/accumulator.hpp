// SPDX-License-Identifier: GPL-3.0-or-later
// A running sum kept as an unevaluated pair of doubles: each addition is exact to about 2⁻¹⁰⁶ of the
// sum. Source: Knuth's TwoSum and Dekker (1971), "A floating-point technique for extending the
// available precision". Scaling every term by a power of two scales the sum bit for bit.
#pragma once

#include <cmath>

namespace asperity {

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

}  // namespace asperity
