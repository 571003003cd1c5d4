// SPDX-License-Identifier: GPL-3.0-or-later
// The answer of a model as a polynomial of its uncertain inputs, y = Σ c_α Π_j P_αj(ξ_j), on the orthonormal
// polynomials of each input's distribution, Legendre's of uniform and Hermite's of normal inputs (and of all
// others, whose shares are those of normal ones), up to a total degree (Xiu & Karniadakis 2002); coefficients
// by least squares. Shares of the variance are then sums of squares (Sudret 2008): of first order, what an
// input does by itself, and total, with all it does together with others. First-order shares sum to at most
// 1, totals to at least 1. Correlated inputs break both.
//
// How far to trust a fit tells its leave-one-out error, the mean square of what each run's answer is missed
// by when the fit is made of the others, over the variance of the answers. It predicts the error of the
// shares; a model with a jump, noise and too low a degree show in it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/statistics/uncertain_input.hpp"

namespace asperity {

struct VarianceShare {
  std::string name;
  double first = 0, total = 0;  // of the variance of the polynomial
  // Standard errors: the jackknife's over runs, and half the leave-one-out error for what no polynomial of
  // this degree follows.
  double first_error = 0, total_error = 0;
};

// What the leave-one-out error says of the shares: below 5 % good, to 20 % rough, above refused.
enum class ChaosTrust { good, rough, refused };

struct PolynomialChaos {
  int degree = 0;
  std::size_t runs = 0, terms = 0;
  double mean = 0, variance = 0;  // of the polynomial over the inputs
  double leave_one_out = 0;       // over the variance of the answers; 0 of answers that are all the same
  std::vector<VarianceShare> shares;
  std::vector<UncertainInput> inputs;
  std::vector<std::vector<int>> degrees;  // of each term, an input each
  std::vector<double> coefficients;

  ChaosTrust trust() const;
  // At standardised coordinates, one an input. O(terms × inputs).
  double at(std::span<const double> coordinates) const;
  // "degree 2 of 64 runs, leave-one-out error 3.1 %: rough".
  std::string text() const;
};

// The terms of a total degree, the count capped at 1e9.
std::size_t chaos_terms(std::size_t inputs, int degree);
// Runs a design should begin with: three for each term of degree 2, raised to a power of two.
std::size_t chaos_runs(std::size_t inputs);

// `points`: a run's standardised coordinates each. Of all degrees up to `highest` (1 to 12) and log2(runs),
// for which there are 1.5 runs for each term and at most 300 terms, the one with the least leave-one-out
// error. A higher degree in one input would follow chance in the tails, where runs are few. Throws
// Error{bad_value} for inputs as check_inputs does, counts that differ, an answer that is not finite (named
// with its inputs), too few runs for degree 1, and runs that do not tell the inputs apart.
// O(runs × terms²) some ten times; the linear algebra is Eigen's (least_squares.hpp).
PolynomialChaos polynomial_chaos(std::span<const UncertainInput> inputs,
                                 std::span<const std::vector<double>> points, std::span<const double> answers,
                                 int highest = 12);

// The same, refused: throws Error{not_converged} where the trust in it is refused, with its numbers.
void require_trust(const PolynomialChaos& chaos);

// Whether a variance can be had of such answers: 0, or neither so large nor so small that its square is no
// number of full precision.
bool has_square(double answer);

}  // namespace asperity
