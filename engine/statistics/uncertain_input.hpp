// SPDX-License-Identifier: GPL-3.0-or-later
// Independent uncertain inputs and sampling points of a model: Sobol' sequence (1967) with direction numbers
// of Joe & Kuo (2008), scrambled (Owen 1995). A power of two points hits each of as many equal slices of
// every input once; points can be added. Coordinates are distances from the value in uncertainties; -1 to 1
// for uniform inputs.
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
std::span<const std::string> input_shapes();

struct UncertainInput {
  std::string name;
  double value = 0;
  double uncertainty = 0;  // standard; half-width: uniform sqrt(3), triangular sqrt(6) times
  InputShape shape = InputShape::normal;
  // A normal input becomes a scaled Student's t.
  double degrees = std::numeric_limits<double>::infinity();
  std::vector<double> sample{};  // ascending; with this mean and deviation
  Dimension dimension{};

  double at(double coordinate) const;
  // Quantile of `p`, 0 < p < 1.
  double coordinate(double p) const;
  // The same for a standard normal score.
  double coordinate_of_score(double z) const;
};

struct InputCorrelation {
  std::string one, other;
  double value = 0;  // above -1 and below 1
};

// Throws Error{bad_value} unless 1 to 21 inputs, unique nonempty names, finite values, uncertainties above 0,
// degrees from 1 and only where defined, and lognormal values above 0.
void check_inputs(std::span<const UncertainInput> inputs);

// Points first … first + runs - 1, standardised coordinates by input. Same bits per seed. O(runs × inputs).
std::vector<std::vector<double>> input_points(std::span<const UncertainInput> inputs, std::size_t runs,
                                              std::uint64_t seed, std::size_t first = 0);

}  // namespace asperity
