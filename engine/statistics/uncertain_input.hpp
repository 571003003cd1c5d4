// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities that are known within a standard uncertainty, and the values of them at which a model is asked:
// the sequence of Sobol' (1967) with the direction numbers of Joe & Kuo (2008), scrambled as Owen (1995) has
// it. A power of two of its points takes each of as many equal slices of every input once, and more points
// may follow later.
// Inputs are independent here. Coordinates are standardised: the distance from the value in
// uncertainties, of a uniform input from -1 to 1 between its ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "engine/core/quantity.hpp"

namespace asperity {

enum class InputShape { normal, uniform, lognormal, triangular, sample };
// "normal", … in the order of InputShape.
std::span<const std::string> input_shapes();

struct UncertainInput {
  std::string name;
  double value = 0;
  double uncertainty = 0;  // standard deviation: uniform within sqrt(3) of them, triangular within sqrt(6)
  InputShape shape = InputShape::normal;
  // Degrees of freedom of the uncertainty: a normal input is then Student's t, scaled by the uncertainty.
  double degrees = std::numeric_limits<double>::infinity();
  std::vector<double> sample{};  // ascending; value and uncertainty are its mean and deviation
  Dimension dimension{};         // for tables

  double at(double coordinate) const;
  // The coordinate below which lies the share `p`, 0 < p < 1.
  double coordinate(double p) const;
  // The same for that of a standard normal number.
  double coordinate_of_score(double z) const;
};

// Throws Error{bad_value} for none or more than 21 inputs, a name that is empty or there twice, a value or an
// uncertainty that is not finite, an uncertainty that is not above 0, degrees of freedom below 1 or of a
// shape that has none, and a lognormal input whose value is not above 0.
void check_inputs(std::span<const UncertainInput> inputs);

// Points first … first + runs - 1 of the sequence, of one standardised coordinate an input. The same bits for
// the same seed. O(runs × inputs).
std::vector<std::vector<double>> input_points(std::span<const UncertainInput> inputs, std::size_t runs,
                                              std::uint64_t seed, std::size_t first = 0);

}  // namespace asperity
