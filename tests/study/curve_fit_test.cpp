// SPDX-License-Identifier: GPL-3.0-or-later
// Fits against 50-digit answers (Gauss-Newton) and NIST's StRD (Misra1a); bands, weights, scatter,
// undetermined parameters.
#include "engine/study/curve_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::curve_fit_test {
namespace {

using test::error_of;

void expect_parameter(const CalibratedParameter& parameter, double value, double error, double digits) {
  EXPECT_NEAR(*parameter.value / value, 1, digits) << parameter.name;
  EXPECT_NEAR(*parameter.standard_error / error, 1, 100 * digits) << parameter.name;
}

CalibrationRows points_of(std::vector<double> x, std::vector<double> y,
                          const std::vector<double>& weights = {}) {
  CalibrationRows rows;
  rows.x = std::move(x);
  rows.y = std::move(y);
  for (const double weight : weights) rows.u.push_back(1 / std::sqrt(weight));
  return rows;
}

CurvePoint curve_at(const CurveFit& fit, double x) {
  return *std::ranges::min_element(fit.curve, {}, [x](const CurvePoint& at) { return std::abs(at.x - x); });
}

using Start = std::vector<CalibrationParameter>;
const CalibrationOptions ratios = {.relative_u = true};

const CalibrationRows misra1a = points_of(
    {77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0},
    {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78});

double saturating(double x, std::span<const double> q) { return q[0] * (1 - std::exp(-q[1] * x)); }

TEST(CurveFit, CertifiedProblemFromBothStarts) {
  for (const Start& start :
       {Start{{"b1", 500, {}, {}}, {"b2", 1e-4, {}, {}}}, Start{{"b1", 250, {}, {}}, {"b2", 5e-4, {}, {}}},
        Start{{"b1", 250, {}, {}}, {"b2", 0, {}, {}}}}) {
    const CurveFit fit = fit_model(misra1a, saturating, start);
    expect_parameter(fit.found.parameters[0], 238.942129178861708, 2.70700752413944809, 1e-8);
    expect_parameter(fit.found.parameters[1], 0.00055015643180591356, 7.26686884361903929e-6, 1e-8);
    EXPECT_NEAR(fit.found.residual_deviation / 0.101878763302436063, 1, 1e-9);
    EXPECT_NEAR(*fit.r_squared, 0.999981580110036285, 1e-14);
    EXPECT_NEAR(*fit.found.correlation[1][0], -0.998776191963618034, 1e-9);
    EXPECT_EQ(fit.found.degrees, 12U);
    const double t = 2.1788128296634177;  // 12 degrees
    EXPECT_NEAR(*fit.found.parameters[0].high, 238.942129178861708 + t * 2.70700752413944809, 1e-6);
  }
}

TEST(CurveFit, ThreeParameters) {
  const CalibrationRows points =
      points_of({0, 0.5, 1, 1.5, 2, 3, 4, 5, 7, 9, 12, 15},
                {0.201, 0.342, 0.437, 0.522, 0.571, 0.668, 0.706, 0.741, 0.774, 0.781, 0.793, 0.789});
  const CurveModel model = [](double x, std::span<const double> q) {
    return q[0] + q[1] * std::exp(-x / q[2]);
  };
  const CurveFit fit = fit_model(points, model, Start{{"a", 1, {}, {}}, {"b", -1, {}, {}}, {"c", 1, {}, {}}});
  expect_parameter(fit.found.parameters[0], 0.789309301549796212, 0.00272885501247083965, 1e-8);
  expect_parameter(fit.found.parameters[1], -0.584150721853425017, 0.00471598854690390398, 1e-8);
  expect_parameter(fit.found.parameters[2], 1.96792453705011109, 0.0373258413054338318, 1e-8);
  EXPECT_NEAR(*fit.found.correlation[2][0], 0.651066624259463473, 1e-8);
  EXPECT_NEAR(*fit.found.correlation[2][1], 0.170415022728021828, 1e-8);
  EXPECT_NEAR(*fit.found.correlation[0][1], -0.402927134192224177, 1e-8);
}

TEST(CurveFit, LineFarFromTheOrigin) {
  const CurveFit fit =
      fit_line(points_of({1000001, 1000002, 1000003, 1000005, 1000008}, {3.1, 4.9, 7.2, 11.1, 16.8}));
  expect_parameter(fit.found.parameters[0], -1968180.67727272727, 28833.5208132582043, 1e-12);
  expect_parameter(fit.found.parameters[1], 1.96818181818181818, 0.0288334112462066621, 1e-12);
  EXPECT_NEAR(fit.found.residual_deviation / 0.160018938273132553, 1, 1e-12);
  const CurvePoint at = curve_at(fit, 1000004.5);
  EXPECT_NEAR(at.y, 9.99772727272727273, 1e-12);
  EXPECT_NEAR((at.high - at.y) / 3.1824463052837096, 0.074354430044333141, 1e-13);  // t of 3 degrees
  EXPECT_EQ(fit.found.correlation[0][1], fit.found.correlation[1][0]);
}

TEST(CurveFit, WeightsCountByTheirRatios) {
  for (const double factor : {1.0, 1e-12}) {
    const CalibrationRows points = points_of({1, 2, 3, 5, 8}, {3.1, 4.9, 7.2, 11.1, 16.8},
                                             {factor, 0.5 * factor, 2 * factor, factor, 0.25 * factor});
    const CurveFit fit = fit_line(points, ratios);
    EXPECT_EQ(fit.found.observations, 5U);
    expect_parameter(fit.found.parameters[0], 1.16546762589928058, 0.130248283512963247, 1e-12);
    expect_parameter(fit.found.parameters[1], 1.98093525179856115, 0.0360514692445550136, 1e-12);
    EXPECT_NEAR(*fit.found.correlation[0][1], -0.874074820122097488, 1e-12);
    EXPECT_NEAR(*fit.r_squared, 0.999007351900866428, 1e-14);
    const CurveModel line = [](double x, std::span<const double> q) { return q[0] + q[1] * x; };
    const CurveFit same = fit_model(points, line, Start{{"a", 0, {}, {}}, {"b", 0, {}, {}}}, ratios);
    expect_parameter(same.found.parameters[0], 1.16546762589928058, 0.130248283512963247, 1e-8);
    expect_parameter(same.found.parameters[1], 1.98093525179856115, 0.0360514692445550136, 1e-8);
    EXPECT_NEAR(curve_at(same, 4.5).high - curve_at(same, 4.5).low,
                curve_at(fit, 4.5).high - curve_at(fit, 4.5).low, 1e-9);
  }
}

TEST(CurveFit, PowerLawInSIUnits) {
  CalibrationRows points = points_of({1e6, 2e6, 4e6, 7e6, 1e7, 2.5e7, 6e7},
                                     {0.0031, 0.0058, 0.0122, 0.0199, 0.0311, 0.0702, 0.178});
  const CurveFit fit = fit_power(points);
  expect_parameter(fit.found.parameters[0], 2.13981376191469427e-9, 6.9094958765089639e-10, 1e-8);
  expect_parameter(fit.found.parameters[1], 1.01805967819976749, 0.0182211565883503191, 1e-8);
  EXPECT_NEAR(*fit.found.correlation[0][1], -0.999645864753593798, 1e-9);
  EXPECT_NEAR(*fit.r_squared, 0.99940091644884685, 1e-13);
  const CurvePoint at = curve_at(fit, 3e6);
  EXPECT_NEAR(at.y, 2.13981376191469427e-9 * std::pow(at.x, 1.01805967819976749), 1e-11);
  points = points_of(points.x, points.y, {4, 3, 2, 2, 1, 1, 0.5});
  const CurveFit weighted = fit_power(points, ratios);
  expect_parameter(weighted.found.parameters[0], 2.38256305200272736e-9, 7.03394984428718216e-10, 1e-8);
  expect_parameter(weighted.found.parameters[1], 1.01183775113631708, 0.0168419667529143706, 1e-8);
}

TEST(CurveFit, PowerLawThroughZeroAndBelow) {
  CalibrationRows points = points_of({0, 1, 2, 3, 4}, {0, -2, -8, -18, -32});
  const CurveFit fit = fit_power(points);
  EXPECT_NEAR(*fit.found.parameters[0].value, -2, 1e-12);
  EXPECT_NEAR(*fit.found.parameters[1].value, 2, 1e-12);
  points.x[1] = -1;
  EXPECT_EQ(
      error_of([&] { fit_power(points); }),
      "the power law has no value at x = -1; it is fitted for x of 0 and above; leave other rows out, or "
      "give a function as the model");
  EXPECT_NE(error_of([] {
              fit_power(points_of({1, 1, 1, 1}, {1, 2, 3, 4}));
            }).find("do not determine"),
            std::string::npos);
}

TEST(CurveFit, PointsOnTheCurveLeaveNoScatter) {
  const CurveFit line = fit_line(points_of({0, 1, 2, 3}, {1, 3, 5, 7}));
  EXPECT_NEAR(*line.found.parameters[0].value, 1, 1e-14);
  EXPECT_NEAR(*line.found.parameters[1].value, 2, 1e-14);
  EXPECT_EQ(line.found.residual_deviation, 0);
  EXPECT_EQ(*line.r_squared, 1);
  EXPECT_FALSE(fit_line(points_of({0, 1, 2, 3}, {4, 4, 4, 4})).r_squared);
  const CurveModel wave = [](double x, std::span<const double> q) { return q[0] * std::sin(q[1] * x); };
  CalibrationRows points;
  for (int k = 1; k < 20; ++k) {
    points.x.push_back(0.1 * k);
    points.y.push_back(1e-6 * std::sin(2.5 * 0.1 * k));
  }
  const CurveFit fit = fit_model(points, wave, Start{{"a", 5e-7, {}, {}}, {"k", 2, {}, {}}});
  EXPECT_NEAR(*fit.found.parameters[0].value / 1e-6, 1, 1e-12);
  EXPECT_NEAR(*fit.found.parameters[1].value, 2.5, 1e-12);
}

TEST(CurveFit, ParametersOfAnyScaleFromZero) {
  // Parameters of 1e-7 and 1e9 start at 0; one answer is 0.
  const CurveModel model = [](double x, std::span<const double> q) { return q[0] + q[1] * x + q[2] * x * x; };
  CalibrationRows points;
  const double scatter[] = {1, -2, 1, 1, -2, 1};
  for (int k = 0; k < 6; ++k) {
    const double x = 1e-8 * (k + 1);
    points.x.push_back(x);
    points.y.push_back(1e9 * x * x + 1e-9 * scatter[k]);
  }
  const CurveFit fit = fit_model(points, model, Start{{"c", 0, {}, {}}, {"b", 0, {}, {}}, {"a", 0, {}, {}}});
  // Residuals are orthogonal to 1, x and x².
  double sum = 0, moment = 0, second = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const double r = fit.found.residuals[k] / 1e-9, x = points.x[k] / 1e-8;
    sum += r, moment += r * x, second += r * x * x;
  }
  EXPECT_NEAR(sum, 0, 1e-7);
  EXPECT_NEAR(moment, 0, 1e-7);
  EXPECT_NEAR(second, 0, 1e-6);
}

TEST(CurveFit, NamesWhatThePointsDoNotDetermine) {
  const CalibrationRows points = points_of({1, 2, 3, 4, 5}, {1.1, 1.9, 3.2, 3.9, 5.1});
  const CurveModel sum = [](double x, std::span<const double> q) { return (q[0] + q[1]) * x + q[2]; };
  EXPECT_NE(error_of([&] {
              fit_model(points, sum, Start{{"tau0", 1, {}, {}}, {"alpha", 0.5, {}, {}}, {"c", 0, {}, {}}});
            }).find("tau0 and alpha are not identifiable: only tau0 + alpha = 1 ("),
            std::string::npos);
  const CurveModel idle = [](double x, std::span<const double> q) { return q[0] * x; };
  EXPECT_NE(error_of([&] {
              fit_model(points, idle, Start{{"k", 1, {}, {}}, {"idle", 3, {}, {}}});
            }).find("these rows say nothing of idle"),
            std::string::npos);
  EXPECT_EQ(
      error_of([] {
        fit_line(points_of({2, 2, 2}, {1, 2, 3}));
      }),
      "the points cannot separate `intercept` and `slope`: x is 2 in all of them; measure at two or more "
      "values of x");
}

TEST(CurveFit, NamesTheRatioThatIsLeftWhereTheModelHasNoBest) {
  // Convex points, concave model: best as a line, at infinity.
  const CalibrationRows points =
      points_of({1, 2, 4, 7, 10, 25, 60}, {0.0031, 0.0058, 0.0122, 0.0199, 0.0311, 0.0702, 0.178});
  const CurveModel bent = [](double x, std::span<const double> q) {
    return q[0] * (1 - std::exp(-x / q[1]));
  };
  EXPECT_NE(error_of([&] {
              fit_model(points, bent, Start{{"s", 1, {}, {}}, {"p0", 300, {}, {}}});
            }).find("s and p0 are not identifiable: only the ratio s/p0 = 0.002946"),
            std::string::npos);
}

TEST(CurveFit, RefusesWhatCannotBeFitted) {
  EXPECT_EQ(
      error_of([] {
        fit_line(points_of({1, 2}, {1, 2}));
      }),
      "2 parameters cannot be fitted with intervals to 2 points; give at least 3 rows with numbers in all "
      "columns and a weight above 0");
  EXPECT_NE(error_of([] { fit_line(points_of({1, 2, 3}, {1, 2})); }), "");
  EXPECT_NE(error_of([] {
              fit_line(points_of({1, 2, 3}, {1, 2, std::nan("")}));
            }).find("row 3"),
            std::string::npos);
  const CurveModel root = [](double x, std::span<const double> q) { return std::sqrt(x - q[0]); };
  EXPECT_NE(error_of([&] {
              fit_model(points_of({1, 2, 3}, {1, 1, 2}), root, Start{{"x0", 2, {}, {}}});
            }).find("no finite value for row 1 at the start, with x0 = 2"),
            std::string::npos);
  const CurveModel step = [](double x, std::span<const double> q) { return x > q[0] ? 1.0 : 0.0; };
  EXPECT_NE(error_of([&] {
              fit_model(points_of({1, 2, 3}, {0, 1, 1}), step, Start{{"at", 2.5, {}, {}}});
            }),
            "");
}

TEST(CurveFit, BandHoldsTheTrueCurveAsOftenAsItSays) {
  const Stream random(1, "band");
  const CurveModel model = [](double x, std::span<const double> q) { return q[0] * x / (q[1] + x); };
  constexpr int sets = 400;
  int held = 0, held_slope = 0;
  for (int set = 0; set < sets; ++set) {
    CalibrationRows points;
    for (int k = 0; k < 8; ++k) {
      points.x.push_back(k + 1);
      points.y.push_back((k + 1) / (3.0 + k + 1) +
                         0.02 * random.normal(static_cast<std::uint64_t>(8 * set + k)));
    }
    const CurveFit fit = fit_model(points, model, Start{{"a", 1, {}, {}}, {"k", 2, {}, {}}});
    const CurvePoint at = curve_at(fit, 4.5);
    held += at.low <= 4.5 / 7.5 && 4.5 / 7.5 <= at.high ? 1 : 0;
    held_slope += *fit.found.parameters[0].low <= 1 && 1 <= *fit.found.parameters[0].high ? 1 : 0;
  }
  // Binomial standard error 1.1 %.
  EXPECT_NEAR(static_cast<double>(held) / sets, 0.95, 0.035);
  EXPECT_NEAR(static_cast<double>(held_slope) / sets, 0.95, 0.035);
}

TEST(CurveFit, IntervalsHoldTheTruthForEachKindOfScatter) {
  constexpr int sets = 150;
  const auto held = [](const CurveFit& fit, std::size_t p, double truth) {
    return *fit.found.parameters[p].low <= truth && truth <= *fit.found.parameters[p].high ? 1 : 0;
  };
  int line = 0, power = 0, specimens = 0, known = 0;
  for (int set = 0; set < sets; ++set) {
    const Stream draws(static_cast<std::uint64_t>(set), "kinds of scatter");
    CalibrationRows rows, decades, repeats, gauge;
    for (std::uint64_t k = 0; k < 10; ++k) {
      const double x = std::pow(100, static_cast<double>(k) / 9),
                   wide = std::pow(1000, static_cast<double>(k) / 9);
      rows.x.push_back(x);
      rows.y.push_back((3 + 2 * x) * (1 + 0.2 * draws.normal(k)));
      decades.x.push_back(wide);
      decades.y.push_back(2 * std::pow(wide, 0.8) * (1 + 0.1 * draws.normal(100 + k)));
      gauge.x.push_back(static_cast<double>(k));
      gauge.y.push_back(1 + 0.5 * static_cast<double>(k) + 0.3 * draws.normal(200 + k));
      gauge.u.push_back(0.3);
    }
    for (std::uint64_t s = 0; s < 4; ++s)
      for (std::uint64_t k = 0; k < 5; ++k) {
        repeats.x.push_back(static_cast<double>(s));
        repeats.y.push_back(1 + static_cast<double>(s) + 0.5 * draws.normal(300 + s) +
                            0.1 * draws.normal(400 + 5 * s + k));
        repeats.specimens.push_back("S" + std::to_string(s));
      }
    const CalibrationOptions relative = {.scatter = CalibrationScatter::relative};
    line += held(fit_line(rows, relative), 1, 2);
    power += held(fit_power(decades, relative), 1, 0.8);
    specimens += held(fit_line(repeats), 1, 1);
    known += held(fit_line(gauge), 0, 1);
  }
  for (const int count : {line, power, specimens, known})
    EXPECT_NEAR(static_cast<double>(count) / sets, 0.95, 0.05);  // three binomial standard errors
}

TEST(CurveFit, PerfectLineHasTheIntervalOfItsUncertainty) {
  CalibrationRows rows = points_of({1, 2, 3}, {2, 4, 6}, {1, 1, 1});
  const CurveFit fit = fit_line(rows);
  EXPECT_NEAR(*fit.found.parameters[1].standard_error, std::sqrt(0.5), 1e-10);
  EXPECT_NEAR(*fit.found.parameters[0].standard_error, std::sqrt(1.0 / 3 + 2), 1e-10);
  EXPECT_NEAR(curve_at(fit, 2).high - 4, 1.959963984540054 * std::sqrt(1.0 / 3), 1e-9);
  EXPECT_EQ(fit.found.residual_deviation, 0);
}

TEST(CurveFit, WholeNumberedParameterIsRefusedAtItsStart) {
  const CurveModel whole = [](double x, std::span<const double> q) { return std::floor(q[0] + 0.5) * x; };
  EXPECT_NE(error_of([&] {
              fit_model(points_of({1, 2, 3, 4}, {5.1, 9.8, 15.3, 19.9}), whole, Start{{"n", 3, {}, {}}});
            }).find("no row changes with a small step of `n` from its start 3"),
            std::string::npos);
}

TEST(SampledCurve, CoversTheRangeInAscendingOrder) {
  const CurveFit fit = fit_line(points_of({1, 2, 3, 1000}, {1, 2.5, 3, 1000}));
  const std::vector<CurvePoint>& curve = fit.curve;
  EXPECT_EQ(curve.front().x, 1);
  EXPECT_EQ(curve.back().x, 1000);
  for (std::size_t k = 1; k < curve.size(); ++k) EXPECT_GT(curve[k].x, curve[k - 1].x);
  EXPECT_LT(curve[1].x, 1.2);  // equal ratios for a logarithmic axis
}

}  // namespace
}  // namespace asperity::curve_fit_test
