// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/uncertain_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/statistics/distributions.hpp"

namespace asperity {

namespace {

// Joe & Kuo: degree, inner coefficients, initial direction numbers, from the second coordinate.
struct SobolRow {
  int degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 7> first;
};
constexpr std::array<SobolRow, 20> sobol_rows = {{{1, 0, {1}},
                                                  {2, 1, {1, 3}},
                                                  {3, 1, {1, 3, 1}},
                                                  {3, 2, {1, 1, 1}},
                                                  {4, 1, {1, 1, 3, 3}},
                                                  {4, 4, {1, 3, 5, 13}},
                                                  {5, 2, {1, 1, 5, 5, 17}},
                                                  {5, 4, {1, 1, 5, 5, 5}},
                                                  {5, 7, {1, 1, 7, 11, 19}},
                                                  {5, 11, {1, 1, 5, 1, 1}},
                                                  {5, 13, {1, 1, 1, 3, 11}},
                                                  {5, 14, {1, 3, 5, 5, 31}},
                                                  {6, 1, {1, 3, 3, 9, 7, 49}},
                                                  {6, 13, {1, 1, 1, 15, 21, 21}},
                                                  {6, 16, {1, 3, 1, 13, 27, 49}},
                                                  {6, 19, {1, 1, 1, 15, 7, 5}},
                                                  {6, 22, {1, 3, 1, 15, 13, 25}},
                                                  {6, 25, {1, 1, 5, 5, 19, 61}},
                                                  {7, 1, {1, 3, 7, 11, 23, 15, 103}},
                                                  {7, 4, {1, 3, 7, 13, 13, 15, 69}}}};

using Directions = std::array<std::uint32_t, 32>;

Directions directions_of(std::size_t input) {
  Directions v{};
  if (input == 0) {
    for (unsigned k = 0; k < 32; ++k) v[k] = std::uint32_t{1} << (31 - k);
    return v;
  }
  const SobolRow& row = sobol_rows.at(input - 1);
  const auto degree = static_cast<unsigned>(row.degree);
  for (unsigned k = 0; k < 32; ++k) {
    if (k < degree) {
      v[k] = row.first.at(k) << (31 - k);
      continue;
    }
    v[k] = v[k - degree] ^ (v[k - degree] >> degree);
    for (unsigned l = 1; l < degree; ++l)
      if (((row.coefficients >> (degree - 1 - l)) & 1) != 0) v[k] ^= v[k - l];
  }
  return v;
}

std::uint32_t sobol_bits(const Directions& v, std::size_t index) {
  std::uint32_t bits = 0;
  for (unsigned k = 0; k < 32; ++k)
    if (((index >> k) & 1) != 0) bits ^= v[k];
  return bits;
}

// Owen: flips each bit by a random bit that depends on the previous bits.
std::uint32_t scrambled(std::uint32_t bits, const Stream& stream) {
  std::uint32_t out = 0;
  for (unsigned k = 0; k < 32; ++k) {
    const std::uint64_t node = (std::uint64_t{1} << k) | (k == 0 ? 0 : bits >> (32 - k));
    const auto turn = static_cast<std::uint32_t>(stream.bits(node) >> 63);
    out |= (((bits >> (31 - k)) & 1) ^ turn) << (31 - k);
  }
  return out;
}

}  // namespace

double UncertainInput::at(double coordinate) const {
  return value + uncertainty * (shape == InputShape::uniform ? std::sqrt(3.0) * coordinate : coordinate);
}

double UncertainInput::coordinate(double p) const {
  switch (shape) {
    case InputShape::uniform:
      return 2 * p - 1;
    case InputShape::triangular:
      return std::sqrt(6.0) * (p < 0.5 ? std::sqrt(2 * p) - 1 : 1 - std::sqrt(2 - 2 * p));
    case InputShape::sample: {
      const auto k = static_cast<std::size_t>(p * static_cast<double>(sample.size()));
      return (sample[std::min(k, sample.size() - 1)] - value) / uncertainty;
    }
    default:
      return coordinate_of_score(normal_quantile(p));
  }
}

double UncertainInput::coordinate_of_score(double z) const {
  if (shape == InputShape::normal) return z;
  if (shape != InputShape::lognormal) return coordinate((1 + elementary::erf(z / std::numbers::sqrt2)) / 2);
  const double ratio = uncertainty / value, deviation = std::sqrt(elementary::log1p(ratio * ratio));
  return elementary::expm1(deviation * (z - deviation / 2)) / ratio;
}

std::span<const std::string> input_shapes() {
  static const std::vector<std::string> names = {"normal", "uniform", "lognormal", "triangular", "sample"};
  return names;
}

void check_inputs(std::span<const UncertainInput> inputs) {
  constexpr std::size_t most = sobol_rows.size() + 1;
  if (inputs.empty())
    throw Error(ErrorCode::bad_value, "there is no uncertain input",
                "name at least one, with its value and its uncertainty");
  if (inputs.size() > most)
    throw Error(
        ErrorCode::bad_value,
        "there are " + std::to_string(inputs.size()) + " uncertain inputs, above " + std::to_string(most),
        "fix those that matter least");
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    const UncertainInput& input = inputs[j];
    if (input.name.empty()) throw Error(ErrorCode::bad_value, "an uncertain input has no name", "name it");
    for (std::size_t k = 0; k < j; ++k)
      if (inputs[k].name == input.name)
        throw Error(ErrorCode::bad_value, "the input " + quoted(input.name) + " is there twice",
                    "give each its own name");
    if (!std::isfinite(input.value) || !std::isfinite(input.uncertainty))
      throw Error(ErrorCode::bad_value,
                  "the input " + quoted(input.name) + " has a value or an uncertainty that is not finite",
                  "give two finite numbers");
    if (input.uncertainty <= 0)
      throw Error(ErrorCode::bad_value,
                  "the uncertainty of " + quoted(input.name) + " is " + format_exact(input.uncertainty),
                  "give one above 0, or leave the input out: what is exact has no share");
    const bool lognormal = input.shape == InputShape::lognormal && input.value <= 0;
    if (lognormal || !(input.degrees >= 1) ||
        (std::isfinite(input.degrees) && input.shape != InputShape::normal))
      throw Error(ErrorCode::bad_value,
                  "the input " + quoted(input.name) +
                      (lognormal ? " is lognormal and has the value " + format_short(input.value)
                                 : " has " + format_short(input.degrees) + " degrees of freedom"),
                  lognormal ? "give its mean, above 0" : "give 1 or more, of a normal input");
  }
}

std::vector<std::vector<double>> input_points(std::span<const UncertainInput> inputs, std::size_t runs,
                                              std::uint64_t seed, std::size_t first) {
  std::vector<std::vector<double>> points(runs, std::vector<double>(inputs.size()));
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    const Stream stream(seed, "input points " + std::to_string(j));
    const Directions directions = directions_of(j);
    for (std::size_t i = 0; i < runs; ++i) {
      // Midpoint: normal coordinates stay finite.
      const double p =
          (static_cast<double>(scrambled(sobol_bits(directions, first + i), stream)) + 0.5) * 0x1p-32;
      points[i][j] = inputs[j].coordinate(p);
    }
  }
  return points;
}

}  // namespace asperity
