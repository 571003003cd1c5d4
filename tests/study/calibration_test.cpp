// SPDX-License-Identifier: GPL-3.0-or-later
// Calibrations: a certified problem, coverage for the tilt law tan θ = α + τ0 c
// (tests/reference/uncertainty_calibration.csv), undetermined parameters, refusals.
#include "engine/study/calibrate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/study/curve_fit.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::calibration_test {
namespace {

using test::error_of;

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

bool warns(const Calibration& of, const std::string& part) {
  return std::ranges::any_of(of.warnings, [&](const std::string& text) { return says(text, part); });
}

// Specimens with real areas c, each measured `repeats` times.
struct Experiment {
  CalibrationRows rows;
  std::vector<double> c;
  CalibrationModel model() const {
    return [this](std::span<const double> q, std::size_t row) { return q[0] + q[1] * c[row]; };
  }
};

const std::vector<CalibrationParameter> tilt_law = {{"alpha", 0.1, {}, {}}, {"tau0", 0.5, {}, {}}};

Experiment experiment(std::size_t specimens, double ratio, double between, std::uint64_t seed,
                      std::size_t repeats = 5) {
  Experiment made;
  const Stream draws(seed, "calibration experiment");
  for (std::size_t s = 0; s < specimens; ++s) {
    const double place =
        specimens > 1 ? static_cast<double>(s) / static_cast<double>(specimens - 1) - 0.5 : 0;
    const double c = std::pow(ratio, place), own = 1 + between * draws.normal(1000 + s);
    for (std::size_t k = 0; k < repeats; ++k) {
      made.c.push_back(c);
      made.rows.y.push_back((0.2 + 0.3 * c) * own * (1 + 0.2 * (2 * draws.uniform(s * repeats + k) - 1)));
      made.rows.specimens.push_back("specimen " + std::to_string(s + 1));
    }
  }
  return made;
}

const CalibrationOptions relative = {.scatter = CalibrationScatter::relative};

struct Coverage {
  int sets = 0, tau0 = 0, alpha = 0, tau0_profile = 0, by_specimens = 0;
  std::vector<double> widths;  // of tau0's interval, relative to tau0
  double of(int held) const { return static_cast<double>(held) / sets; }
  double median_width() {
    const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
    std::ranges::nth_element(widths, middle);
    return *middle;
  }
};

Coverage coverage_of(std::size_t specimens, double ratio, double between, int sets,
                     CalibrationBasis basis = CalibrationBasis::automatic) {
  Coverage counted;
  CalibrationOptions options = relative;
  options.basis = basis;
  for (int k = 0; k < sets; ++k) {
    const Experiment made = experiment(specimens, ratio, between, static_cast<std::uint64_t>(k) + 1);
    const Calibration found = calibrate(made.rows, made.model(), tilt_law, options);
    const auto held = [](const std::optional<double>& low, const std::optional<double>& high, double truth) {
      return low && high && *low <= truth && truth <= *high ? 1 : 0;
    };
    const CalibratedParameter &alpha = found.parameters[0], &tau0 = found.parameters[1];
    counted.sets += 1;
    counted.alpha += held(alpha.low, alpha.high, 0.2);
    counted.tau0 += held(tau0.low, tau0.high, 0.3);
    counted.tau0_profile += held(tau0.profile_low, tau0.profile_high, 0.3);
    counted.by_specimens += found.by_specimens ? 1 : 0;
    counted.widths.push_back((*tau0.high - *tau0.low) / 0.3);
  }
  return counted;
}

// ASPERITY_COVERAGE_SETS=4000 measures each coverage to 0.35 %.
int coverage_sets() {
  const char* given = std::getenv("ASPERITY_COVERAGE_SETS");
  return given != nullptr ? std::max(1, std::atoi(given)) : 150;
}

// A row of tests/reference/uncertainty_calibration.csv for `method`.
struct Kind {
  std::size_t specimens = 0;
  double ratio = 0, between = 0, correlation = 0, width = 0;
};

std::vector<Kind> reference_kinds(const std::string& method) {
  std::ifstream file(std::string(ASPERITY_TEST_DATA) + "/uncertainty_calibration.csv");
  std::vector<Kind> kinds;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::stringstream parts(line);
    for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
    if (cells.size() != 11 || cells[6] != method) continue;
    kinds.push_back({static_cast<std::size_t>(std::stoul(cells[0])), std::stod(cells[1]), std::stod(cells[2]),
                     std::stod(cells[3]), std::stod(cells[8])});
  }
  return kinds;
}

TEST(Calibration, IntervalsHoldTheTruthAsOftenAsTheySay) {
  const std::vector<Kind> kinds = reference_kinds("linearised t(n-2)");
  ASSERT_EQ(kinds.size(), 7U);
  int sets = 0, tau0 = 0, alpha = 0, profile = 0;
  for (const Kind& kind : kinds) {
    const Coverage found = coverage_of(kind.specimens, kind.ratio, kind.between, coverage_sets());
    if (std::getenv("ASPERITY_COVERAGE_SETS") != nullptr)
      std::printf(
          "%2zu specimens, cmax/cmin %3g, scatter between %3g: tau0 %.3f, profile %.3f, alpha %.3f, "
          "by specimens %.3f\n",
          kind.specimens, kind.ratio, kind.between, found.of(found.tau0), found.of(found.tau0_profile),
          found.of(found.alpha), found.of(found.by_specimens));
    const double slack = 3 * std::sqrt(0.95 * 0.05 / found.sets);  // three standard errors
    EXPECT_GE(found.of(found.tau0), 0.93 - slack) << kind.specimens << " " << kind.ratio;
    EXPECT_GE(found.of(found.alpha), 0.93 - slack) << kind.specimens << " " << kind.ratio;
    sets += found.sets;
    tau0 += found.tau0;
    alpha += found.alpha;
    profile += found.tau0_profile;
  }
  for (const int held : {tau0, alpha, profile}) {
    EXPECT_GE(static_cast<double>(held) / sets, 0.93);
    EXPECT_LE(static_cast<double>(held) / sets, 0.98);
  }
}

TEST(Calibration, WidthsOfIntervalsAreThoseOfTheReference) {
  for (const Kind& kind : reference_kinds("linearised t(n-2)")) {
    Coverage found = coverage_of(kind.specimens, kind.ratio, kind.between, 60, CalibrationBasis::rows);
    EXPECT_NEAR(found.median_width() / kind.width, 1, 0.08) << kind.specimens << " " << kind.ratio;
  }
  for (const Kind& kind : reference_kinds("specimen means t(m-2)")) {
    if (kind.specimens < 6) continue;  // a median over one degree of freedom scatters
    Coverage found = coverage_of(kind.specimens, kind.ratio, kind.between, 60, CalibrationBasis::specimens);
    EXPECT_EQ(found.by_specimens, found.sets);
    EXPECT_NEAR(found.median_width() / kind.width, 1, 0.25) << kind.specimens << " " << kind.ratio;
  }
}

TEST(Calibration, CorrelationIsThatOfTheNormalEquations) {
  for (const Kind& kind : reference_kinds("linearised t(n-2)")) {
    if (kind.between > 0) continue;
    Experiment made = experiment(kind.specimens, kind.ratio, 0, 1);
    for (std::size_t k = 0; k < made.c.size(); ++k) made.rows.y[k] = 0.2 + 0.3 * made.c[k];
    const Calibration found = calibrate(made.rows, made.model(), tilt_law, relative);
    // The reference has 500 estimates.
    const double error = (1 - kind.correlation * kind.correlation) / std::sqrt(500.0);
    EXPECT_NEAR(*found.correlation[0][1], kind.correlation, 3 * error + 5e-4);
    EXPECT_NEAR(*found.parameters[0].value, 0.2, 1e-9);
    EXPECT_NEAR(*found.parameters[1].value, 0.3, 1e-9);
    EXPECT_TRUE(says(found.verdict, "passes through every row")) << found.verdict;
  }
}

TEST(Calibration, FewSpecimensHideTheirScatter) {
  const Coverage few = coverage_of(3, 4, 0.1, coverage_sets()),
                 many = coverage_of(12, 4, 0.1, coverage_sets());
  EXPECT_LT(few.by_specimens, many.by_specimens);
  EXPECT_LT(few.of(few.tau0), many.of(many.tau0));
  if (std::getenv("ASPERITY_COVERAGE_SETS") == nullptr) return;
  for (const Kind& kind : {Kind{3, 4, 0.1}, Kind{4, 4, 0.1}, Kind{6, 4, 0.05}, Kind{12, 4, 0.05},
                           Kind{6, 4, 0.1}, Kind{12, 4, 0.1}, Kind{3, 4, 0}, Kind{6, 4, 0}})
    for (const CalibrationBasis basis : {CalibrationBasis::automatic, CalibrationBasis::rows}) {
      const Coverage found = coverage_of(kind.specimens, kind.ratio, kind.between, coverage_sets(), basis);
      std::printf("%2zu specimens, cmax/cmin %3g, scatter between %3g%s: tau0 %.3f\n", kind.specimens,
                  kind.ratio, kind.between, basis == CalibrationBasis::rows ? ", rows alone" : "",
                  found.of(found.tau0));
    }
}

TEST(Calibration, PooledIntervalsOfScatteringSpecimensHoldTooSeldom) {
  const Coverage pooled = coverage_of(6, 4, 0.1, 150, CalibrationBasis::rows),
                 means = coverage_of(6, 4, 0.1, 150);
  EXPECT_LT(pooled.of(pooled.tau0), 0.85);
  EXPECT_EQ(pooled.by_specimens, 0);
  EXPECT_GT(means.of(means.tau0), 0.88);
  EXPECT_GT(means.of(means.by_specimens), 0.75);
}

// --- a nonlinear problem with certified answers

double saturating(double x, std::span<const double> q) { return q[0] * (1 - std::exp(-q[1] * x)); }

const std::vector<double> misra_x = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                                     378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
const std::vector<double> misra_y = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                                     44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};

const CalibrationModel misra = [](std::span<const double> q, std::size_t row) {
  return saturating(misra_x[row], q);
};

TEST(Calibration, CertifiedProblemOfNist) {
  for (const double b1 : {500.0, 250.0}) {
    const std::vector<CalibrationParameter> start = {{"b1", b1, {}, {}}, {"b2", 1e-4, {}, {}}};
    const Calibration found = calibrate({misra_y}, misra, start);
    EXPECT_NEAR(*found.parameters[0].value / 238.942129178861708, 1, 1e-6);
    EXPECT_NEAR(*found.parameters[1].value / 0.00055015643180591356, 1, 1e-6);
    EXPECT_NEAR(*found.parameters[0].standard_error / 2.70700752413944809, 1, 1e-5);
    EXPECT_NEAR(found.residual_deviation / 0.101878763302436063, 1, 1e-9);
    EXPECT_NEAR(*found.correlation[0][1], -0.998776191963618034, 1e-6);
    EXPECT_EQ(found.degrees, 12U);
    EXPECT_TRUE(found.identifiable);
  }
}

TEST(Calibration, ProfileEndsWhereTheSumOfSquaresMeetsTheCut) {
  const std::vector<CalibrationParameter> start = {{"b1", 250, {}, {}}, {"b2", 5e-4, {}, {}}};
  const Calibration found = calibrate({misra_y}, misra, start);
  const CalibratedParameter& b2 = found.parameters[1];
  for (const double end : {*b2.profile_low, *b2.profile_high}) {
    // For given b2, b1 has a closed form.
    double top = 0, bottom = 0, sum = 0;
    for (std::size_t k = 0; k < misra_x.size(); ++k) {
      const double g = 1 - std::exp(-end * misra_x[k]);
      top += misra_y[k] * g;
      bottom += g * g;
    }
    for (std::size_t k = 0; k < misra_x.size(); ++k) {
      const double r = misra_y[k] - top / bottom * (1 - std::exp(-end * misra_x[k]));
      sum += r * r;
    }
    const double variance = found.sum_of_squares / 12;
    EXPECT_NEAR((sum - found.sum_of_squares) / variance / found.cut, 1, 0.02);
  }
  EXPECT_NEAR(found.cut, 2.1788128296634177 * 2.1788128296634177, 1e-9);  // t of 12 degrees, squared
  EXPECT_GE(b2.profile.size(), 3U);
  EXPECT_TRUE(std::ranges::is_sorted(b2.profile, {}, &ProfilePoint::value));
}

TEST(Calibration, ProfileOfAStraightModelIsItsLinearisedInterval) {
  const Experiment made = experiment(6, 4, 0, 7);
  const Calibration found = calibrate(made.rows, made.model(), tilt_law);
  for (const CalibratedParameter& of : found.parameters) {
    EXPECT_NEAR(*of.profile_low, *of.low, 0.01 * *of.standard_error);
    EXPECT_NEAR(*of.profile_high, *of.high, 0.01 * *of.standard_error);
  }
  EXPECT_TRUE(found.warnings.empty());
}

TEST(Calibration, CurvedModelIsToldAndItsProfileIsLopsided) {
  const std::vector<double> x = {1, 2, 3, 4, 5, 6}, y = {0.55, 0.95, 0.85, 1.15, 0.9, 1.05};
  const CalibrationModel model = [&](std::span<const double> q, std::size_t row) {
    return saturating(x[row], q);
  };
  const std::vector<CalibrationParameter> start = {{"end", 1, {}, {}}, {"rate", 1, {}, {}}};
  const Calibration found = calibrate({y}, model, start);
  const CalibratedParameter& rate = found.parameters[1];
  EXPECT_GT(*rate.profile_high - *rate.value, 1.3 * (*rate.value - *rate.profile_low));
  EXPECT_TRUE(warns(found, "curved in `rate`"));
}

TEST(Calibration, SameBitsEachTime) {
  const Experiment made = experiment(6, 4, 0.1, 3);
  const Calibration a = calibrate(made.rows, made.model(), tilt_law, relative),
                    b = calibrate(made.rows, made.model(), tilt_law, relative);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_EQ(*a.parameters[p].value, *b.parameters[p].value);
    EXPECT_EQ(*a.parameters[p].profile_high, *b.parameters[p].profile_high);
  }
  EXPECT_EQ(a.calls, b.calls);
  EXPECT_EQ(a.verdict, b.verdict);
}

TEST(Calibration, CallsOfTheModelAreCountedAndFewForALaw) {
  const Experiment made = experiment(7, 4, 0, 3, 2);
  std::int64_t calls = 0;
  const CalibrationModel counting = [&](std::span<const double> q, std::size_t row) {
    ++calls;
    return q[0] + q[1] * made.c[row];
  };
  const Calibration found = calibrate(made.rows, counting, tilt_law);
  EXPECT_EQ(found.calls, calls);
  EXPECT_LE(calls / 14, 30);  // parameter sets
}

// --- undetermined parameters

TEST(Calibration, OneRealAreaDeterminesTheSumAlone) {
  Experiment made = experiment(1, 1, 0, 5, 14);
  for (double& c : made.c) c = 0.85;
  made.rows.alike = {"`load` is 5 N"};
  const Calibration found = calibrate(made.rows, made.model(), tilt_law, relative);
  EXPECT_FALSE(found.identifiable);
  for (const CalibratedParameter& of : found.parameters) {
    EXPECT_FALSE(of.determined);
    EXPECT_FALSE(of.value || of.low || of.profile_low || of.standard_error);
  }
  EXPECT_FALSE(found.condition);
  ASSERT_EQ(found.combinations.size(), 1U);
  EXPECT_TRUE(found.combinations[0].starts_with("alpha + 0.85 tau0 = ")) << found.combinations[0];
  EXPECT_TRUE(says(found.verdict, "`load` is 5 N and the specimen is specimen 1 in all rows"))
      << found.verdict;
  EXPECT_TRUE(says(found.verdict, "whether specimens scatter cannot be seen")) << found.verdict;
  double mean = 0;
  for (const double y : made.rows.y) mean += y / 14;
  EXPECT_NEAR(found.fitted[0], mean, 1e-9);
  EXPECT_TRUE(says(found.combinations[0], format_short(mean, 4))) << found.combinations[0];
  EXPECT_EQ(found.degrees, 13U);
}

TEST(Calibration, ProductIsCalledOne) {
  const std::vector<double> x = {1, 2, 3, 4}, y = {2.1, 3.9, 6.2, 7.8};
  const std::vector<CalibrationParameter> start = {{"a", 1, {}, {}}, {"b", 3, {}, {}}, {"c", 0, {}, {}}};
  const CalibrationModel model = [&](std::span<const double> q, std::size_t row) {
    return q[0] * q[1] * x[row] + q[2];
  };
  const Calibration found = calibrate({y}, model, start);
  EXPECT_FALSE(found.parameters[0].determined || found.parameters[1].determined);
  ASSERT_TRUE(found.parameters[2].determined);
  EXPECT_NEAR(*found.parameters[2].value, 0.15, 1e-7);
  EXPECT_TRUE(found.parameters[2].low && found.parameters[2].profile_low);
  ASSERT_EQ(found.combinations.size(), 1U);
  EXPECT_TRUE(says(found.combinations[0], "the product a b = 1.94 (")) << found.combinations[0];
}

TEST(Calibration, RatioIsCalledOne) {
  const std::vector<double> x = {1, 2, 3, 4}, y = {2.1, 3.9, 6.2, 7.8};
  const std::vector<CalibrationParameter> start = {{"load", 5, {}, {}}, {"hardness", 2, 0.1, {}}};
  const CalibrationModel model = [&](std::span<const double> q, std::size_t row) {
    return q[0] / q[1] * x[row];
  };
  const Calibration found = calibrate({y}, model, start);
  ASSERT_EQ(found.combinations.size(), 1U);
  EXPECT_TRUE(says(found.combinations[0], "the ratio load/hardness = ")) << found.combinations[0];
}

TEST(Calibration, ParameterWithoutEffectIsNamed) {
  const Experiment made = experiment(3, 4, 0, 5);
  std::vector<CalibrationParameter> three = tilt_law;
  three.push_back({"creep", 0, {}, {}});
  const Calibration found = calibrate(made.rows, made.model(), three, relative);
  EXPECT_TRUE(says(found.verdict, "these rows say nothing of creep")) << found.verdict;
  EXPECT_FALSE(found.parameters[2].value);
  EXPECT_TRUE(found.parameters[0].value && found.parameters[1].low);
  EXPECT_EQ(found.degrees, 13U);
}

TEST(Calibration, ThreeParametersThatChangeTogetherAreListed) {
  const std::vector<double> x = {1, 2, 3, 4, 5}, y = {2.1, 3.9, 6.2, 7.8, 10.1};
  const std::vector<CalibrationParameter> start = {{"a", 1, {}, {}}, {"b", 1, {}, {}}, {"c", 1, {}, {}}};
  const CalibrationModel model = [&](std::span<const double> q, std::size_t row) {
    return q[0] + 2 * q[2] + (q[1] + q[2]) * x[row];
  };
  const Calibration found = calibrate({y}, model, start);
  EXPECT_TRUE(says(found.verdict, "a by 1, b by 0.5 and c by -0.5")) << found.verdict;
  EXPECT_FALSE(found.identifiable);
}

TEST(Calibration, ParametersHardlyApartAreTold) {
  const Experiment made = experiment(3, 1.1, 0, 2);
  const Calibration found = calibrate(made.rows, made.model(), tilt_law, relative);
  EXPECT_TRUE(found.identifiable);
  EXPECT_TRUE(found.parameters[0].value);
  EXPECT_TRUE(says(found.verdict, "hardly separate alpha and tau0")) << found.verdict;
  EXPECT_EQ(found.combinations.size(), 1U);
}

// --- specimens, uncertainties, bounds, few rows

TEST(Calibration, ScatterOfSpecimensIsNoticed) {
  const Experiment made = experiment(12, 4, 0.15, 4);
  const Calibration found = calibrate(made.rows, made.model(), tilt_law, relative);
  EXPECT_TRUE(found.by_specimens);
  EXPECT_EQ(found.observations, 12U);
  EXPECT_EQ(found.degrees, 10U);
  EXPECT_EQ(found.specimens.size(), 12U);
  EXPECT_EQ(found.specimens[0].rows, 5U);
  EXPECT_LT(found.specimen_scatter->p_value, 0.01);
  EXPECT_TRUE(says(found.verdict, "specimens scatter more than their repeats (F(10, 48) = "))
      << found.verdict;
  EXPECT_EQ(found.residuals.size(), 60U);
}

TEST(Calibration, MeansOfEqualRepeatsAreTheFitOfTheMeans) {
  const Experiment made = experiment(5, 4, 0.2, 11);
  CalibrationOptions options;
  options.basis = CalibrationBasis::specimens;
  const Calibration found = calibrate(made.rows, made.model(), tilt_law, options);
  CalibrationRows means;
  for (std::size_t s = 0; s < 5; ++s) {
    double mean = 0;
    for (std::size_t k = 0; k < 5; ++k) mean += made.rows.y[5 * s + k] / 5;
    means.x.push_back(made.c[5 * s]);
    means.y.push_back(mean);
  }
  const CurveFit line = fit_line(means);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_NEAR(*found.parameters[p].value, *line.found.parameters[p].value, 1e-9);
    EXPECT_NEAR(*found.parameters[p].low, *line.found.parameters[p].low, 1e-7);
  }
}

// Each of five specimens under nearly the same three loads: their means hardly determine the parameters.
TEST(Calibration, MeansAtNearlyEqualLoadsGiveAResultOrTheCure) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Stream draws(seed, "nearly equal loads");
    CalibrationRows rows;
    std::vector<double> load;
    for (std::size_t k = 0; k < 15; ++k) {
      const std::size_t specimen = k % 5;
      load.push_back(1 + 2 * static_cast<double>(k / 5) + 0.01 * static_cast<double>(specimen));
      rows.y.push_back(0.3 * std::pow(load.back(), 0.4) *
                       (1 + 0.05 * draws.normal(100 + specimen) + 0.01 * draws.normal(k)));
      rows.specimens.push_back("specimen " + std::to_string(specimen));
    }
    const CalibrationModel model = [&](std::span<const double> q, std::size_t row) {
      return q[0] * std::pow(load[row], q[1]);
    };
    const std::vector<CalibrationParameter> law = {{"k", 0.2, {}, {}}, {"e", 0.5, {}, {}}};
    CalibrationOptions options = relative;
    try {
      EXPECT_TRUE(calibrate(rows, model, law, options).by_specimens) << seed;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::not_converged) << seed << ": " << error.what();
      EXPECT_TRUE(says(error.what(), "for the means of specimens, ")) << seed << ": " << error.what();
    }
    options.basis = CalibrationBasis::rows;
    const Calibration found = calibrate(rows, model, law, options);
    EXPECT_NEAR(*found.parameters[1].value, 0.4, 0.1) << seed;
  }
}

TEST(Calibration, OneRowASpecimenIsNoRepeat) {
  const Experiment made = experiment(8, 4, 0, 3, 1);
  const Calibration found = calibrate(made.rows, made.model(), tilt_law, relative);
  EXPECT_FALSE(found.specimen_scatter || found.by_specimens);
  EXPECT_EQ(found.degrees, 6U);
}

TEST(Calibration, UncertaintiesWeighAndAreChecked) {
  Experiment made = experiment(6, 4, 0, 3);
  made.rows.specimens.clear();
  for (const double c : made.c) made.rows.u.push_back(0.1 + 0.05 * c);
  made.rows.x = made.c;
  const Calibration found = calibrate(made.rows, made.model(), tilt_law),
                    ratios = calibrate(made.rows, made.model(), tilt_law, {.relative_u = true}),
                    line = fit_line(made.rows).found;
  EXPECT_NEAR(*found.parameters[1].value, *line.parameters[1].value, 1e-9);
  EXPECT_NEAR(*found.parameters[1].standard_error, *line.parameters[1].standard_error, 1e-9);
  EXPECT_NEAR(*ratios.parameters[1].standard_error,
              *line.parameters[1].standard_error * found.residual_deviation, 1e-9);
  EXPECT_TRUE(warns(found, "times as far as `u` says"));
  for (double& u : made.rows.u) u /= 10;
  EXPECT_TRUE(warns(calibrate(made.rows, made.model(), tilt_law), "times as far as `u` says"));
}

TEST(Calibration, AsManyRowsAsParameters) {
  const std::vector<double> c = {1, 2};
  const CalibrationModel model = [&](std::span<const double> q, std::size_t row) {
    return q[0] + q[1] * c[row];
  };
  const Calibration found = calibrate({{0.5, 0.8}}, model, tilt_law);
  EXPECT_NEAR(*found.parameters[0].value, 0.2, 1e-9);
  EXPECT_EQ(found.degrees, 0U);
  EXPECT_FALSE(found.parameters[0].low || found.parameters[0].profile_low || found.fitted_low[0]);
  EXPECT_TRUE(says(found.verdict, "there are no intervals")) << found.verdict;
  const Calibration known = calibrate({{0.5, 0.8}, {0.01, 0.01}}, model, tilt_law);
  // The half-width is 1.96 u(tau0), with u(tau0) = sqrt(2) u / (c2 - c1).
  EXPECT_NEAR(*known.parameters[1].high - 0.3, 1.959963984540054 * std::sqrt(2) * 0.01, 1e-7);
  EXPECT_TRUE(says(known.verdict, "rest on `u` alone")) << known.verdict;
}

TEST(Calibration, BoundThatTheRowsPushAgainst) {
  Experiment made = experiment(6, 4, 0, 3);
  const std::vector<CalibrationParameter> bounded = {{"alpha", 0.5, 0.35, 1.0}, {"tau0", 0.5, 0.0, {}}};
  const Calibration found = calibrate(made.rows, made.model(), bounded, relative);
  EXPECT_EQ(*found.parameters[0].value, 0.35);
  EXPECT_TRUE(found.parameters[0].at_lower);
  EXPECT_FALSE(found.parameters[0].low || found.parameters[1].low);
  EXPECT_TRUE(found.parameters[1].profile_low);
  EXPECT_TRUE(says(found.verdict, "alpha is at its lower bound 0.35: the rows fit better with less"))
      << found.verdict;
  // The other parameter is optimal at the bound.
  const std::vector<CalibrationParameter> alone = {{"tau0", 0.5, {}, {}}};
  made.rows.specimens.clear();
  const CalibrationModel held = [&](std::span<const double> q, std::size_t row) {
    return 0.35 + q[0] * made.c[row];
  };
  EXPECT_NEAR(*found.parameters[1].value, *calibrate(made.rows, held, alone, relative).parameters[0].value,
              1e-6);
}

// Nearly equal real areas determine a sum only.
TEST(Calibration, ParameterAtABoundLeavesNoWrongInterval) {
  int at_bound = 0;
  for (const double ratio : {1.01, 1.05, 1.1, 1.3})
    for (const double lower : {-1e9, 0.0})
      for (std::uint64_t seed = 1; seed <= 15; ++seed) {
        Experiment made = experiment(2, ratio, 0, seed, 7);
        const std::vector<CalibrationParameter> law = {{"alpha", 0.1, lower, {}}, {"tau0", 0.3, 0.0, {}}};
        const Calibration found = calibrate(made.rows, made.model(), law, relative);
        const CalibratedParameter &alpha = found.parameters[0], &tau0 = found.parameters[1];
        if (!alpha.at_lower && !tau0.at_lower) continue;
        ++at_bound;
        EXPECT_FALSE(alpha.low || tau0.low || alpha.standard_error || tau0.standard_error);
        EXPECT_FALSE(alpha.profile_low.value_or(0) > 0.2 || alpha.profile_high.value_or(1) < 0.2);
        EXPECT_FALSE(tau0.profile_low.value_or(0) > 0.3 || tau0.profile_high.value_or(1) < 0.3);
        EXPECT_FALSE(alpha.value && tau0.value) << found.verdict;
        ASSERT_EQ(found.combinations.size(), 1U) << found.verdict;
        EXPECT_TRUE(says(found.verdict, "only " + found.combinations[0] + " is known")) << found.verdict;
        EXPECT_FALSE(found.identifiable);
      }
  EXPECT_GT(at_bound, 40);
}

// S at the ends comes from a fit of the bounded parameter.
TEST(Calibration, ProfileLetsAParameterLeaveItsBound) {
  const Experiment made = experiment(6, 4, 0, 3);
  const std::vector<CalibrationParameter> law = {{"alpha", 0.3, 0.24, 1.0}, {"tau0", 0.5, 0.0, {}}};
  CalibrationRows rows = made.rows;
  rows.specimens.clear();
  const Calibration found = calibrate(rows, made.model(), law);
  ASSERT_TRUE(found.parameters[0].at_lower && found.parameters[1].profile_low);
  for (const double end : {*found.parameters[1].profile_low, *found.parameters[1].profile_high}) {
    const CalibrationModel fixed = [&](std::span<const double> q, std::size_t row) {
      return q[0] + end * made.c[row];
    };
    const Calibration there =
        calibrate(rows, fixed, std::vector<CalibrationParameter>{{"alpha", 0.3, 0.24, 1.0}});
    const double variance = found.sum_of_squares / static_cast<double>(found.degrees);
    EXPECT_NEAR((there.sum_of_squares - found.sum_of_squares) / variance / found.cut, 1, 0.02);
  }
}

TEST(Calibration, StartAtWhichNoStepChangesARowIsRefused) {
  const std::vector<double> x = {1, 2, 3, 4, 5};
  const CalibrationRows rows{{5.1, 10.2, 14.7, 20.3, 24.8}};
  const auto refused = [&](double n, double factor, double shift) {
    const CalibrationModel whole = [&](std::span<const double> q, std::size_t row) {
      return std::floor(q[0] + 0.5) * x[row] * factor + shift * q[1];
    };
    return error_of([&] {
      calibrate(rows, whole, std::vector<CalibrationParameter>{{"n", n, {}, {}}, {"b", 1, {}, {}}});
    });
  };
  for (const double n : {3.0, 2.8, 0.0, -40.0})
    EXPECT_TRUE(says(refused(n, 1, 1), "step of `n` from its start " + format_short(n)));
  EXPECT_TRUE(says(refused(3, 0, 0), "no row changes with a"));
}

TEST(Calibration, KnownUncertaintyGivesTheIntervalWithoutScatter) {
  // Three points on a line with u = 1: u(slope) = 1/sqrt(2).
  const std::vector<double> c = {1, 2, 3};
  const CalibrationModel line = [&](std::span<const double> q, std::size_t row) {
    return q[0] + q[1] * c[row];
  };
  const Calibration found = calibrate({{2, 4, 6}, {1, 1, 1}}, line, tilt_law);
  EXPECT_NEAR(*found.parameters[1].standard_error, std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(*found.parameters[1].high, 2 + 1.959963984540054 * std::sqrt(0.5), 1e-9);
  EXPECT_TRUE(found.parameters[1].profile_high);
}

int warned(const std::string& part, int sets, auto make) {
  int said = 0;
  for (int seed = 1; seed <= sets; ++seed) {
    const Stream draws(static_cast<std::uint64_t>(seed), "rows with residuals to look at");
    CalibrationRows rows;
    std::vector<double> x;
    double before = draws.normal(999);
    for (std::uint64_t k = 0; k < 20; ++k) {
      x.push_back(static_cast<double>(k) / 20);
      rows.y.push_back(make(draws, k, x.back(), before));
    }
    const CalibrationModel line = [&](std::span<const double> q, std::size_t row) {
      return q[0] + q[1] * x[row];
    };
    said += warns(calibrate(rows, line, tilt_law, {.profile = false}), part) ? 1 : 0;
  }
  return said;
}

TEST(Calibration, ResidualsThatAreNotIndependentAreSaid) {
  constexpr int sets = 100;
  const auto line = [](const Stream& draws, std::uint64_t k, double x, double&) {
    return 1 + x + 0.1 * draws.normal(k);
  };
  const auto parabola = [](const Stream& draws, std::uint64_t k, double x, double&) {
    return x * x + 0.02 * draws.normal(k);
  };
  const auto drift = [](const Stream& draws, std::uint64_t k, double x, double& before) {
    before = 0.8 * before + 0.6 * draws.normal(k);
    return 1 + x + 0.1 * before;
  };
  const auto copies = [](const Stream& draws, std::uint64_t k, double, double&) {
    return static_cast<double>(k / 4 * 4) / 20 + 0.1 * draws.normal(k / 4);
  };
  EXPECT_LE(warned("keep their sign", sets, line), 10);  // at most 5 %
  EXPECT_LE(warned("neighbouring rows", sets, line), 12);
  EXPECT_GE(warned("keep their sign", sets, parabola), 95);
  EXPECT_GE(warned("neighbouring rows", sets, drift), 60);
  EXPECT_EQ(warned("rows repeat another row exactly", sets, copies), 0);  // x differs
  const Experiment made = experiment(6, 4, 0, 3, 1);
  Experiment often;
  for (int copy = 0; copy < 4; ++copy)
    for (std::size_t k = 0; k < 6; ++k) {
      often.c.push_back(made.c[k]);
      often.rows.y.push_back(made.rows.y[k]);
    }
  EXPECT_TRUE(
      warns(calibrate(often.rows, often.model(), tilt_law), "18 of 24 rows repeat another row exactly"));
}

// Faces differ by a factor of 1 - d and 1 + d.
TEST(Calibration, ScatterOfFacesIsSharedByTheRowsOfASpecimen) {
  constexpr double d = 0.1, u = 1e-9;
  const std::vector<CalibrationParameter> start = {{"q", 1, {}, {}}};
  const auto error_of_q = [&](const std::vector<std::string>& specimens) {
    CalibrationRows rows{{2, 2, 2, 2}, std::vector<double>(4, u)};
    rows.specimens = specimens;
    rows.replicates = 2;
    const CalibrationBatch faces = [](std::span<const CalibrationQuery> queries, const auto& done) {
      std::vector<double> values;
      for (const CalibrationQuery& query : queries)
        values.push_back(query.parameters[0] * (query.replicate == 0 ? 1 - d : 1 + d));
      done(values.size());
      return values;
    };
    const Calibration found =
        calibrate(rows, faces, start, {.basis = CalibrationBasis::rows}, Monitor::silent());
    EXPECT_NEAR(*found.parameters[0].value, 2, 1e-12);
    EXPECT_NEAR(found.parameters[0].share_of_faces, 1, 1e-9);
    EXPECT_FALSE(found.parameters[0].profile_low);
    EXPECT_NEAR(found.cut, std::pow(12.706204736174698, 2), 1e-6);  // t for one degree
    EXPECT_TRUE(says(found.verdict, "a mean over 2 replicates, whose scatter makes 100 % of u² of q"));
    return *found.parameters[0].standard_error;
  };
  // Variances: 2 q² d² for one face, q² d² for both.
  EXPECT_NEAR(error_of_q({}), 2 * d * std::sqrt(2 + 1.0), 1e-7);
  EXPECT_NEAR(error_of_q({"A", "A", "A", "A"}), 2 * d * std::sqrt(2 + 1.0), 1e-7);
  EXPECT_NEAR(error_of_q({"A", "A", "B", "B"}), 2 * d * std::sqrt(2 / 2.0 + 1), 1e-7);
  EXPECT_NEAR(error_of_q({"A", "B", "C", "D"}), 2 * d * std::sqrt(2 / 4.0 + 1), 1e-7);
}

TEST(Calibration, MeanOverFacesHoldsTheTruthWhereOneFaceDoesNot) {
  constexpr int sets = 60;
  const auto held = [](std::size_t faces) {
    int count = 0;
    for (std::uint64_t set = 1; set <= sets; ++set) {
      const Stream draws(set, "faces of a calibration");
      Experiment made;
      for (std::uint64_t s = 0; s < 12; ++s)
        for (std::uint64_t k = 0; k < 5; ++k) {
          made.c.push_back(s < 6 ? 0.5 : 2);
          made.rows.y.push_back((0.2 + 0.3 * made.c.back() * (1 + 0.1 * draws.normal(s))) *
                                (1 + 0.05 * draws.normal(100 + 5 * s + k)));
          made.rows.specimens.push_back("S" + std::to_string(s));
        }
      made.rows.replicates = faces;
      const CalibrationBatch model = [&](std::span<const CalibrationQuery> queries, const auto& done) {
        std::vector<double> values;
        for (const CalibrationQuery& of : queries) {
          const std::uint64_t face = (made.c[of.row] > 1 ? 500U : 600U) + of.replicate;
          values.push_back(of.parameters[0] +
                           of.parameters[1] * made.c[of.row] * (1 + 0.1 * draws.normal(face)));
        }
        done(values.size());
        return values;
      };
      const Calibration found = calibrate(made.rows, model, tilt_law, relative, Monitor::silent());
      const CalibratedParameter& tau0 = found.parameters[1];
      count += *tau0.low <= 0.3 && 0.3 <= *tau0.high ? 1 : 0;
    }
    return count;
  };
  EXPECT_LE(held(1), 48);
  EXPECT_GE(held(6), 51);  // 95 % of 60 is 57, standard error 1.7
}

TEST(Calibration, BoundsThatAreFarAwayChangeNothing) {
  const Experiment made = experiment(6, 4, 0, 3);
  const std::vector<CalibrationParameter> bounded = {{"alpha", 0.1, -9.0, 9.0}, {"tau0", 0.5, -9.0, 9.0}};
  const Calibration wide = calibrate(made.rows, made.model(), bounded, relative),
                    free = calibrate(made.rows, made.model(), tilt_law, relative);
  EXPECT_NEAR(*wide.parameters[1].value, *free.parameters[1].value, 1e-7);
  EXPECT_NEAR(*wide.parameters[1].profile_high, *free.parameters[1].profile_high, 1e-5);
}

TEST(Calibration, LinearisedIntervalIsNotCutOffAtABound) {
  Experiment made = experiment(3, 1.2, 0, 6);
  const std::vector<CalibrationParameter> bounded = {{"alpha", 0.1, -9.0, 9.0}, {"tau0", 0.5, 0.0, {}}};
  const Calibration found = calibrate(made.rows, made.model(), bounded, relative);
  ASSERT_TRUE(found.parameters[1].low);
  EXPECT_LT(*found.parameters[1].low, 0);
  EXPECT_FALSE(found.parameters[1].profile_low);
  EXPECT_TRUE(says(found.verdict, "no lower limit of tau0 within its bounds")) << found.verdict;
}

TEST(Calibration, ConstantDataAreNoKnowledge) {
  Experiment made = experiment(3, 4, 0, 5);
  for (double& y : made.rows.y) y = 0.4;
  const Calibration found = calibrate(made.rows, made.model(), tilt_law);
  EXPECT_NEAR(*found.parameters[0].value, 0.4, 1e-9);
  EXPECT_NEAR(*found.parameters[1].value, 0, 1e-9);
  EXPECT_TRUE(says(found.verdict, "no scatter is seen")) << found.verdict;
  for (double& y : made.rows.y) y = 0;
  EXPECT_NEAR(*calibrate(made.rows, made.model(), tilt_law).parameters[1].value, 0, 1e-9);
}

TEST(Calibration, SpecimenThatComesAgainIsTheSameOne) {
  Experiment made = experiment(4, 4, 0, 5, 2);
  Experiment turned = made;
  for (std::size_t k = 0; k < 8; ++k) {
    const std::size_t from = k < 4 ? 2 * k : 2 * (k - 4) + 1;
    turned.c[k] = made.c[from];
    turned.rows.y[k] = made.rows.y[from];
    turned.rows.specimens[k] = made.rows.specimens[from];
  }
  const Calibration found = calibrate(turned.rows, turned.model(), tilt_law, relative);
  EXPECT_EQ(found.specimens.size(), 4U);
  EXPECT_EQ(found.specimens[3].rows, 2U);
  EXPECT_NEAR(found.specimen_scatter->f,
              calibrate(made.rows, made.model(), tilt_law, relative).specimen_scatter->f, 1e-6);
}

// --- refusals

TEST(Calibration, ModelWithoutAValueNamesRowAndParameters) {
  Experiment made = experiment(3, 4, 0, 5);
  const CalibrationModel holed = [&](std::span<const double> q, std::size_t row) {
    return row == 6 ? std::numeric_limits<double>::quiet_NaN() : q[0] + q[1] * made.c[row];
  };
  EXPECT_TRUE(says(error_of([&] { calibrate(made.rows, holed, tilt_law); }),
                   "no finite value for row 7 at the start, with alpha = 0.1, tau0 = 0.5"));
  made.rows.numbers.resize(15);
  for (std::size_t k = 0; k < 15; ++k) made.rows.numbers[k] = 100 + k;
  EXPECT_TRUE(says(error_of([&] { calibrate(made.rows, holed, tilt_law); }), "row 106"));
}

TEST(Calibration, ModelThatEndsOnTheWayIsGoneRound) {
  // The first step from a poor start leaves the domain of the logarithm.
  const std::vector<double> x = {1, 2, 3, 4, 5, 6};
  CalibrationRows rows;
  for (const double v : x) rows.y.push_back(std::log(0.5 * v) + (v == 3 ? 0.01 : 0));
  const CalibrationModel model = [&](std::span<const double> q, std::size_t row) {
    return q[0] > 0 ? std::log(q[0] * x[row]) : std::numeric_limits<double>::quiet_NaN();
  };
  const std::vector<CalibrationParameter> start = {{"a", 20, {}, {}}};
  EXPECT_NEAR(*calibrate(rows, model, start).parameters[0].value, 0.5, 0.01);
}

TEST(Calibration, NoisyModelNeedsLargerSteps) {
  // At a tolerance of 1e-5, differences of 1e-3 see the noise, differences of 0.1 hardly.
  const Experiment made = experiment(6, 4, 0, 3);
  const CalibrationModel noisy = [&](std::span<const double> q, std::size_t row) {
    const double exact = q[0] + q[1] * made.c[row];
    return std::round(exact * 1e5) / 1e5;
  };
  std::vector<CalibrationParameter> start = {{"alpha", 0.1, {}, {}, 0.1}, {"tau0", 0.5, {}, {}, 0.1}};
  const Calibration found = calibrate(made.rows, noisy, start, relative),
                    exact = calibrate(made.rows, made.model(), tilt_law, relative);
  EXPECT_NEAR(*found.parameters[1].value, *exact.parameters[1].value,
              0.05 * *exact.parameters[1].standard_error);
  EXPECT_NEAR(*found.parameters[1].standard_error / *exact.parameters[1].standard_error, 1, 1e-3);
}

TEST(Calibration, WhatCannotBeFittedIsRefused) {
  const Experiment made = experiment(3, 4, 0, 5);
  const auto refused = [&](const CalibrationRows& rows, const std::vector<CalibrationParameter>& parameters,
                           const CalibrationOptions& options = {}) {
    return error_of([&] { calibrate(rows, made.model(), parameters, options); });
  };
  CalibrationRows rows = made.rows;
  rows.y.resize(1);
  rows.specimens.clear();
  EXPECT_TRUE(says(refused(rows, tilt_law), "has 1 row for 2 parameters"));
  rows.y.clear();
  EXPECT_TRUE(says(refused(rows, tilt_law), "has 0 rows for 2 parameters"));
  rows = made.rows;
  rows.y[3] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(says(refused(rows, tilt_law), "y is not finite in row 4"));
  rows = made.rows;
  rows.specimens.resize(2);
  EXPECT_TRUE(says(refused(rows, tilt_law), "15 values of y and 2 of another column"));
  rows = made.rows;
  rows.u.assign(15, 0);
  EXPECT_TRUE(says(refused(rows, tilt_law), "`u` is 0 in row 1"));
  rows.u.assign(15, 1);
  EXPECT_TRUE(says(refused(rows, tilt_law, relative), "give one of them"));
  EXPECT_TRUE(says(refused(made.rows, {}), "has no parameters"));
  EXPECT_TRUE(says(refused(made.rows, {{"a", 0, 1.0, 2.0}, {"b", 0, {}, {}}}), "outside its bounds"));
  EXPECT_TRUE(
      says(refused(made.rows, {{"a", 0, 1.0, -1.0}, {"b", 0, {}, {}}}), "`lower` must be below `upper`"));
  EXPECT_TRUE(
      says(refused(made.rows, {{"a", 0, {}, {}}, {"a", 0, {}, {}}}), "two parameters are called `a`"));
  EXPECT_TRUE(says(refused(made.rows, {{"a", 0, {}, {}, 2}, {"b", 0, {}, {}}}), "has a `step` of 2"));
  EXPECT_TRUE(says(refused(made.rows, {{"a", NAN, {}, {}}, {"b", 0, {}, {}}}), "not finite"));
  CalibrationOptions options;
  options.confidence = 1;
  EXPECT_TRUE(says(refused(made.rows, tilt_law, options), "`confidence` is 1"));
  options = {};
  options.basis = CalibrationBasis::specimens;
  rows = made.rows;
  rows.specimens.assign(15, "one");
  EXPECT_TRUE(says(refused(rows, tilt_law, options), "has 1 specimen for 2 parameters"));
  rows.specimens.clear();
  EXPECT_TRUE(says(refused(rows, tilt_law, options), "needs the specimen"));
}

TEST(Calibration, StopEndsItBetweenRows) {
  const Experiment made = experiment(3, 4, 0, 5);
  int calls = 0;
  const CalibrationModel stopped = [&](std::span<const double> q, std::size_t row) {
    if (++calls == 20) stop_flag().raise(StopReason::interrupt);
    return q[0] + q[1] * made.c[row];
  };
  EXPECT_THROW(calibrate(made.rows, stopped, tilt_law), Error);
  stop_flag().clear();
  EXPECT_EQ(calls, 20);
}

}  // namespace
}  // namespace asperity::calibration_test
