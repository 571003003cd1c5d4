// SPDX-License-Identifier: GPL-3.0-or-later
// Polynomial chaos y = Σ c_α Π_j P_αj(ξ_j) by least squares up to a total degree (Xiu & Karniadakis 2002),
// with orthonormal Legendre polynomials for uniform and Hermite polynomials for other inputs. Variance shares
// are sums of squares (Sudret 2008): first order for an input alone (sum ≤ 1), total with its interactions
// (sum ≥ 1). Correlated inputs invalidate both. The leave-one-out error, relative to the variance of the
// answers, predicts the error of the shares, including jumps, noise and an insufficient degree.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/statistics/uncertain_input.hpp"

namespace asperity {

struct VarianceShare {
  std::string name;
  double first = 0, total = 0;  // of polynomial variance
  // Standard: jackknife over runs and, in squares, half the leave-one-out error.
  double first_error = 0, total_error = 0;
};

// By leave-one-out error: below 5 % good, to 20 % rough.
enum class ChaosTrust { good, rough, refused };

struct PolynomialChaos {
  int degree = 0;
  std::size_t runs = 0, terms = 0;
  double mean = 0, variance = 0;  // of the polynomial
  double leave_one_out = 0;       // 0 for equal answers
  std::vector<VarianceShare> shares;
  std::vector<UncertainInput> inputs;
  std::vector<std::vector<int>> degrees;  // by term and input
  std::vector<double> coefficients;

  ChaosTrust trust() const;
  // `coordinates`: standardised. O(terms × inputs).
  double at(std::span<const double> coordinates) const;
  // "degree 2 of 64 runs, leave-one-out error 3.1 %: rough".
  std::string text() const;
};

std::size_t chaos_terms(std::size_t inputs, int degree);
// Three runs per term of degree 2, rounded up to a power of two.
std::size_t chaos_runs(std::size_t inputs);

// `points`: standardised coordinates by run. Chooses the degree with the smallest leave-one-out error, up to
// `highest` (1 to 12) and log2(runs), with 1.5 runs per term and at most 300 terms; higher degrees would fit
// noise in the tails. Throws Error{bad_value} as check_inputs, for unequal counts, answers that are not
// finite, too few runs for degree 1, and runs that do not separate the inputs. O(runs × terms²), some ten
// times.
PolynomialChaos polynomial_chaos(std::span<const UncertainInput> inputs,
                                 std::span<const std::vector<double>> points, std::span<const double> answers,
                                 int highest = 12);

// Throws Error{not_converged} for refused trust.
void require_trust(const PolynomialChaos& chaos);

// Whether the square is 0 or has full precision.
bool has_square(double answer);

}  // namespace asperity
