// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/uncertain_input.hpp"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/require.hpp"
#include "engine/statistics/distributions.hpp"

namespace asperity {

namespace {

using SobolEngine = boost::random::sobol_engine<std::uint32_t, 32>;

// In natural order. Boost counts in Gray code and skips the origin.
std::vector<std::uint32_t> sobol_point(SobolEngine& engine, std::uint32_t index) {
  std::vector<std::uint32_t> point(engine.dimension());
  if (index == 0) return point;
  std::uint32_t count = index;
  for (int shift = 1; shift < 32; shift *= 2) count ^= count >> shift;
  engine.seed(count - 1);
  engine.generate(point.begin(), point.end());
  return point;
}

// Owen: a random flip of each bit by the previous bits.
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
  constexpr std::size_t most = 21;
  if (inputs.empty())
    refuse("there is no uncertain input", "name at least one, with its value and its uncertainty");
  if (inputs.size() > most)
    refuse("there are " + std::to_string(inputs.size()) + " uncertain inputs, above " + std::to_string(most),
           "fix those that matter least");
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    const UncertainInput& input = inputs[j];
    if (input.name.empty()) refuse("an uncertain input has no name", "name it");
    for (std::size_t k = 0; k < j; ++k)
      if (inputs[k].name == input.name)
        refuse("the input " + quoted(input.name) + " is there twice", "give each its own name");
    if (!std::isfinite(input.value) || !std::isfinite(input.uncertainty))
      refuse("the input " + quoted(input.name) + " has a value or an uncertainty that is not finite",
             "give two finite numbers");
    if (input.uncertainty <= 0)
      refuse("the uncertainty of " + quoted(input.name) + " is " + format_exact(input.uncertainty),
             "give one above 0, or leave out an exact input");
    const bool lognormal = input.shape == InputShape::lognormal && input.value <= 0;
    if (lognormal || !(input.degrees >= 1) ||
        (std::isfinite(input.degrees) && input.shape != InputShape::normal))
      refuse("the input " + quoted(input.name) +
                 (lognormal ? " is lognormal and has the value " + format_short(input.value)
                            : " has " + format_short(input.degrees) + " degrees of freedom"),
             lognormal ? "give its mean, above 0" : "give 1 or more, of a normal input");
  }
}

std::vector<std::vector<double>> input_points(std::span<const UncertainInput> inputs, std::size_t runs,
                                              std::uint64_t seed, std::size_t first) {
  std::vector<Stream> streams;
  for (std::size_t j = 0; j < inputs.size(); ++j)
    streams.emplace_back(seed, "input points " + std::to_string(j));
  SobolEngine engine(std::max<std::size_t>(1, inputs.size()));
  std::vector<std::vector<double>> points(runs);
  for (std::size_t i = 0; i < runs; ++i) {
    const std::vector<std::uint32_t> bits = sobol_point(engine, static_cast<std::uint32_t>(first + i));
    for (std::size_t j = 0; j < inputs.size(); ++j) {
      // Midpoint: normal coordinates stay finite.
      const double p = (static_cast<double>(scrambled(bits[j], streams[j])) + 0.5) * 0x1p-32;
      points[i].push_back(inputs[j].coordinate(p));
    }
  }
  return points;
}

}  // namespace asperity
