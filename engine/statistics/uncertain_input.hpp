// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities that are known within a standard uncertainty, and the values of them at which a model is asked:
// the sequence of Sobol' (1967) with the direction numbers of Joe & Kuo (2008), scrambled as Owen (1995) has
// it. A power of two of its points takes each of as many equal slices of every input once, and more points
// may follow later.
// Inputs are independent of each other. Coordinates are standardised: of a normal input its distance from
// the value in uncertainties, of a uniform one from -1 to 1 between its ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace asperity {

enum class InputShape { normal, uniform };

struct UncertainInput {
  std::string name;
  double value = 0;
  double uncertainty = 0;  // standard deviation; a uniform input lies within sqrt(3) of them
  InputShape shape = InputShape::normal;

  double at(double coordinate) const;
  // The coordinate below which lies the share `p`, 0 < p < 1.
  double coordinate(double p) const;
};

// Throws Error{bad_value} for none or more than 21 inputs, a name that is empty or there twice, a value or an
// uncertainty that is not finite, and an uncertainty that is not above 0.
void check_inputs(std::span<const UncertainInput> inputs);

// Points first … first + runs - 1 of the sequence, of one standardised coordinate an input. The same bits for
// the same seed. O(runs × inputs).
std::vector<std::vector<double>> input_points(std::span<const UncertainInput> inputs, std::size_t runs,
                                              std::uint64_t seed, std::size_t first = 0);

}  // namespace asperity
