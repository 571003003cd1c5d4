// SPDX-License-Identifier: GPL-3.0-or-later
// Calibrations of expensive models: parameter sets, agreement with a full fit, model noise, progress.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/sanitizers.hpp"
#include "engine/study/calibrate.hpp"

namespace asperity::calibration_sparing_test {
namespace {

// Ra = first (1 - stress/(stress + hardness)), with scatter.
constexpr double true_first = 1.2, true_hardness = 0.9;
double roughness_of(double first, double hardness, double stress) {
  return first * hardness / (stress + hardness);
}

struct Presses {
  CalibrationRows rows;
  std::vector<double> stress;
  double noise = 0;                        // model noise within its tolerance, reproducible
  std::vector<std::vector<double>> asked;  // parameter sets

  double at(std::span<const double> q, std::size_t row) const {
    const double exact = roughness_of(q[0], q[1], stress[row]);
    const double place = 1e4 * (q[0] * 7 + q[1] * 13 + stress[row] * 17);
    return exact * (1 + noise * elementary::sin(place));
  }
  CalibrationModel model() {
    return [this](std::span<const double> q, std::size_t row) {
      if (row == 0) asked.emplace_back(q.begin(), q.end());
      return at(q, row);
    };
  }
};

Presses presses(std::uint64_t seed, double scatter = 0.03, std::size_t rows = 14) {
  Presses made;
  const Stream draws(seed, "presses of a calibration");
  for (std::size_t k = 0; k < rows; ++k) {
    made.stress.push_back(0.1 + 2.0 * static_cast<double>(k) / static_cast<double>(rows));
    made.rows.y.push_back(roughness_of(true_first, true_hardness, made.stress[k]) *
                          (1 + scatter * draws.normal(k)));
  }
  return made;
}

const std::vector<CalibrationParameter> begin = {{"first", 1, 0.01, {}}, {"hardness", 1.5, 0.01, {}}};
const CalibrationOptions sparing = {.scatter = CalibrationScatter::relative, .sparing = true},
                         unsparing = {.scatter = CalibrationScatter::relative};

TEST(SparingCalibration, IsThatOfAFitWhichSparesNothing) {
  std::size_t most = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Presses made = presses(seed), again = presses(seed);
    made.noise = 1e-6;
    const Calibration few = calibrate(made.rows, made.model(), begin, sparing),
                      many = calibrate(again.rows, again.model(), begin, unsparing);
    for (std::size_t p = 0; p < 2; ++p) {
      const CalibratedParameter &of = few.parameters[p], &wanted = many.parameters[p];
      EXPECT_NEAR(*of.value, *wanted.value, 0.02 * *wanted.standard_error) << seed;
      EXPECT_NEAR(*of.standard_error / *wanted.standard_error, 1, 0.03) << seed;
      EXPECT_NEAR(*of.profile_low, *wanted.profile_low, 0.1 * *wanted.standard_error) << seed;
      EXPECT_NEAR(*of.profile_high, *wanted.profile_high, 0.1 * *wanted.standard_error) << seed;
    }
    EXPECT_FALSE(few.warnings.size() > many.warnings.size()) << few.warnings.back();
    most = std::max(most, made.asked.size());
    all += made.asked.size();
    EXPECT_EQ(few.calls, static_cast<std::int64_t>(14 * made.asked.size()));
    EXPECT_EQ(std::set(made.asked.begin(), made.asked.end()).size(), made.asked.size());
  }
  EXPECT_LE(most, 16U);
  EXPECT_LE(all, 20 * 14U);
}

// Noise of 1e-4 against a scatter of 3 %.
TEST(SparingCalibration, NoiseOfTheModelNeitherStopsNorMisleadsIt) {
  std::size_t most = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Presses made = presses(seed), again = presses(seed);
    made.noise = 1e-4;
    const Calibration found = calibrate(made.rows, made.model(), begin, sparing),
                      exact = calibrate(again.rows, again.model(), begin, unsparing);
    for (std::size_t p = 0; p < 2; ++p) {
      EXPECT_NEAR(*found.parameters[p].value, *exact.parameters[p].value,
                  0.25 * *exact.parameters[p].standard_error)
          << seed;
      EXPECT_NEAR(*found.parameters[p].standard_error / *exact.parameters[p].standard_error, 1, 0.05) << seed;
    }
    most = std::max(most, made.asked.size());
  }
  EXPECT_LE(most, 20U);
}

TEST(SparingCalibration, NoiseThatHidesTheLeastSumIsSaid) {
  int said = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Presses made = presses(seed);
    made.noise = 5e-3;
    const Calibration found = calibrate(made.rows, made.model(), begin, sparing);
    said += std::ranges::any_of(found.warnings, [](const std::string& warning) {
      return warning.find("noise of the model") != std::string::npos;
    });
  }
  EXPECT_GE(said, 18);
}

TEST(SparingCalibration, IntervalsHoldTheTruthAsOftenAsTheySay) {
  const int sets = sanitized ? 40 : 600;
  int linear = 0, profile = 0;
  for (int k = 0; k < sets; ++k) {
    Presses made = presses(1000 + static_cast<std::uint64_t>(k));
    made.noise = 1e-5;
    const Calibration found = calibrate(made.rows, made.model(), begin, sparing);
    const CalibratedParameter &a = found.parameters[0], &b = found.parameters[1];
    linear += *a.low <= true_first && true_first <= *a.high ? 1 : 0;
    linear += *b.low <= true_hardness && true_hardness <= *b.high ? 1 : 0;
    profile += *a.profile_low <= true_first && true_first <= *a.profile_high ? 1 : 0;
    profile += *b.profile_low <= true_hardness && true_hardness <= *b.profile_high ? 1 : 0;
  }
  const double of_linear = linear / (2.0 * sets), of_profile = profile / (2.0 * sets);
  EXPECT_GE(of_linear, sanitized ? 0.85 : 0.93) << of_linear;
  EXPECT_LE(of_linear, sanitized ? 1 : 0.97) << of_linear;
  EXPECT_GE(of_profile, sanitized ? 0.85 : 0.93) << of_profile;
  EXPECT_LE(of_profile, sanitized ? 1 : 0.97) << of_profile;
}

TEST(SparingCalibration, WhatIsNotDeterminedIsGivenNoNumber) {
  Presses made = presses(3);
  const CalibrationModel product = [&](std::span<const double> q, std::size_t row) {
    const std::vector<double> one = {q[0] * q[1], 0.9};
    return made.at(one, row);
  };
  made.noise = 1e-5;
  const Calibration found = calibrate(
      made.rows, product, std::vector<CalibrationParameter>{{"a", 2, {}, {}}, {"b", 0.5, {}, {}}}, sparing);
  EXPECT_FALSE(found.identifiable);
  EXPECT_FALSE(found.parameters[0].value || found.parameters[1].value);
  EXPECT_NE(found.verdict.find("the product a b"), std::string::npos) << found.verdict;
}

// Real area in steps of 1/1024 or coarser; stiffness and factor act as a product.
struct CountedNodes {
  double nodes = 1024;
  CalibrationRows rows;
  std::vector<double> load;
  double area(double stiffness, std::size_t row) const {
    return std::floor(nodes * std::erf(0.9 * load[row] / stiffness) + 0.5) / nodes;
  }
  CalibrationModel product() const {
    return [this](std::span<const double> q, std::size_t row) { return area(q[0] * q[1], row); };
  }
};

CountedNodes counted_nodes(std::uint64_t seed, double scatter, double nodes = 1024) {
  CountedNodes made;
  made.nodes = nodes;
  const Stream draws(seed, "counted nodes");
  for (std::size_t k = 0; k < 10; ++k) {
    made.load.push_back(0.03 + 0.03 * static_cast<double>(k));
    made.rows.y.push_back(made.area(1.3, k) * (1 + scatter * draws.normal(k)));
  }
  return made;
}

// Jacobian columns look independent from these starts, bounds and steps.
const std::vector<std::vector<CalibrationParameter>> starts_of_product = {
    {{"E", 1, {}, {}}, {"f", 1, {}, {}}},
    {{"E", 1, 0.1, 10.0}, {"f", 1, 0.1, 1.0}},
    {{"E", 1.3, {}, {}, 0.05}, {"f", 1, {}, {}, 0.05}},
    {{"E", 1, {}, {}, 0.01}, {"f", 1, {}, {}, 0.1}},
    {{"E", 1.1, {}, {}}, {"f", 1, {}, {}, 0.01}}};

TEST(SparingCalibration, StepsOfTheModelTellNoProductApart) {
  int fits = 0, products = 0;
  for (const bool spare : {true, false})
    for (const bool profile : {true, false})
      for (const double scatter : {0.0, 0.003, 0.01, 0.03, 0.1})
        for (std::size_t from = 0; from < starts_of_product.size(); ++from)
          for (std::uint64_t seed = 1; seed <= (sanitized ? 2U : 6U); ++seed) {
            const CountedNodes made = counted_nodes(seed, scatter, seed % 2 == 0 ? 1024 : 80);
            const CalibrationOptions options = {.profile = profile, .sparing = spare};
            try {
              const Calibration found =
                  calibrate(made.rows, made.product(), starts_of_product[from], options);
              const CalibratedParameter &stiffness = found.parameters[0], &factor = found.parameters[1];
              EXPECT_FALSE(found.identifiable);
              EXPECT_FALSE(stiffness.value || factor.value || stiffness.low || factor.low)
                  << (stiffness.value ? "E" : "") << (factor.value ? "f" : "") << ", start " << from
                  << ", scatter " << scatter << ", seed " << seed << ", sparing " << spare << ": "
                  << found.verdict;
              ++fits;
              products += found.verdict.find("only the product E f = 1.") != std::string::npos ? 1 : 0;
            } catch (const Error& error) {
              EXPECT_EQ(error.code(), ErrorCode::not_converged) << error.what();
            }
          }
  EXPECT_GE(products, 0.85 * fits) << fits;
}

TEST(SparingCalibration, StepsOfTheModelTakeNoNumberFromWhatIsDetermined) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CountedNodes made = counted_nodes(seed, 0.03);
    for (double& y : made.rows.y) y += 0.5;
    const CalibrationModel shifted = [&](std::span<const double> q, std::size_t row) {
      return made.area(q[0], row) + q[1];
    };
    const Calibration both =
        calibrate(made.rows, shifted, std::vector<CalibrationParameter>{{"E", 1, {}, {}}, {"c", 0.3, {}, {}}},
                  {.sparing = true});
    EXPECT_TRUE(both.identifiable) << both.verdict;
    EXPECT_TRUE(both.parameters[0].low && both.parameters[1].low);
    const CalibrationModel product = [&](std::span<const double> q, std::size_t row) {
      return made.area(q[0] * q[1], row) + q[2];
    };
    const Calibration found =
        calibrate(made.rows, product,
                  std::vector<CalibrationParameter>{{"E", 1, {}, {}}, {"f", 1, {}, {}}, {"c", 0.3, {}, {}}},
                  {.sparing = true});
    EXPECT_FALSE(found.parameters[0].value || found.parameters[1].value) << found.verdict;
    ASSERT_TRUE(found.parameters[2].value && found.parameters[2].standard_error) << found.verdict;
    EXPECT_NEAR(*found.parameters[2].value, 0.5, 5 * *found.parameters[2].standard_error);
  }
}

TEST(SparingCalibration, BoundGivesNoNumberToHalfAProduct) {
  Presses made = presses(3);
  const CalibrationModel product = [&](std::span<const double> q, std::size_t row) {
    return made.at(std::vector<double>{q[0] * q[1], 0.9}, row);
  };
  for (const CalibrationOptions& options : {sparing, unsparing}) {
    const Calibration found = calibrate(
        made.rows, product, std::vector<CalibrationParameter>{{"a", 1, {}, {}}, {"b", 1, {}, 1.0}}, options);
    EXPECT_FALSE(found.parameters[0].value || found.parameters[1].value) << found.verdict;
    EXPECT_EQ(found.verdict.find("is at its"), std::string::npos) << found.verdict;
  }
}

TEST(SparingCalibration, BoundsHoldAndAStartAtZeroIsFound) {
  Presses made = presses(5);
  for (const double start : {0.0, 0.5}) {
    const std::vector<CalibrationParameter> bounded = {{"first", 1, 0.01, {}}, {"hardness", start, 0.0, 0.7}};
    const Calibration found = calibrate(made.rows, made.model(), bounded, sparing);
    EXPECT_TRUE(found.parameters[1].at_upper);
    EXPECT_EQ(*found.parameters[1].value, 0.7);
  }
}

TEST(SparingCalibration, DerivativesAreAskedForInOneBatch) {
  Presses made = presses(7);
  std::vector<std::size_t> batches;
  const CalibrationBatch batch = [&](std::span<const CalibrationQuery> queries,
                                     const std::function<void(std::size_t)>& done) {
    batches.push_back(queries.size());
    std::vector<double> values;
    for (const CalibrationQuery& query : queries) values.push_back(made.at(query.parameters, query.row));
    done(values.size());
    return values;
  };
  const Calibration found = calibrate(made.rows, batch, begin, sparing, Monitor::silent());
  EXPECT_EQ(std::ranges::count(batches, 28U),
            2);  // two parameters, fourteen rows, start and end
  EXPECT_EQ(found.calls, static_cast<std::int64_t>(14 * (batches.size() + 2)));
}

class Shares final : public Monitor {
 public:
  void progress(std::string_view, double done) override { shares.push_back(done); }
  void warn(std::string_view) override {}
  std::vector<double> shares;
};

// Much longer than forecast: the share still rises.
TEST(SparingCalibration, ProgressMovesToTheEnd) {
  Presses made = presses(9);
  Shares shares;
  const CalibrationModel slow = [&](std::span<const double> q, std::size_t row) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(6);
    while (std::chrono::steady_clock::now() < until) {
    }
    return made.at(q, row);
  };
  const std::vector<CalibrationParameter> far = {{"first", 0.2, 0.01, {}}, {"hardness", 0.1, 0.01, {}}};
  calibrate(made.rows, slow, far, sparing, shares);
  ASSERT_GT(shares.shares.size(), 5U);
  EXPECT_TRUE(std::ranges::is_sorted(shares.shares));
  EXPECT_LT(shares.shares.front(), 0.3);
  EXPECT_LT(shares.shares.back(), 1);
  EXPECT_GT(shares.shares.back(), 0.85);
  const auto standing = std::ranges::adjacent_find(shares.shares);
  const auto again =
      standing == shares.shares.end() ? standing : std::adjacent_find(standing + 1, shares.shares.end());
  EXPECT_TRUE(again == shares.shares.end() || again - standing > 3) << "the share stood still";
}

}  // namespace
}  // namespace asperity::calibration_sparing_test
