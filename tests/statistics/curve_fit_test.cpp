// SPDX-License-Identifier: GPL-3.0-or-later
// Fits against answers computed with 50 digits (Gauss-Newton on exact derivatives), one of them a certified
// problem of NIST's StRD (Misra1a); bands, weights, and what cannot be told apart.
#include "engine/statistics/curve_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"

namespace asperity::curve_fit_test {
namespace {

std::string error_of(auto run) {
  try {
    run();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expect_parameter(const FittedParameter& parameter, double value, double error, double digits) {
  EXPECT_NEAR(parameter.value / value, 1, digits) << parameter.name;
  EXPECT_NEAR(parameter.standard_error / error, 1, 100 * digits) << parameter.name;
}

const FitPoints misra1a = {
    {77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0},
    {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78}};

double saturating(double x, std::span<const double> q) { return q[0] * (1 - std::exp(-q[1] * x)); }

TEST(CurveFit, CertifiedProblemFromBothStarts) {
  for (const auto& start :
       {std::vector<FitStart>{{"b1", 500}, {"b2", 1e-4}}, std::vector<FitStart>{{"b1", 250}, {"b2", 5e-4}},
        std::vector<FitStart>{{"b1", 250}, {"b2", 0}}}) {
    const CurveFit fit = fit_model(misra1a, saturating, start);
    expect_parameter(fit.parameters[0], 238.942129178861708, 2.70700752413944809, 1e-9);
    expect_parameter(fit.parameters[1], 0.00055015643180591356, 7.26686884361903929e-6, 1e-9);
    EXPECT_NEAR(fit.residual_deviation / 0.101878763302436063, 1, 1e-9);
    EXPECT_NEAR(*fit.r_squared, 0.999981580110036285, 1e-14);
    EXPECT_NEAR(fit.correlation[1][0], -0.998776191963618034, 1e-9);
    EXPECT_EQ(fit.degrees, 12U);
    const double t = 2.1788128296634177;  // 12 degrees
    EXPECT_NEAR(fit.parameters[0].high, 238.942129178861708 + t * 2.70700752413944809, 1e-6);
  }
}

TEST(CurveFit, ThreeParameters) {
  const FitPoints points = {
      {0, 0.5, 1, 1.5, 2, 3, 4, 5, 7, 9, 12, 15},
      {0.201, 0.342, 0.437, 0.522, 0.571, 0.668, 0.706, 0.741, 0.774, 0.781, 0.793, 0.789}};
  const CurveModel model = [](double x, std::span<const double> q) {
    return q[0] + q[1] * std::exp(-x / q[2]);
  };
  const CurveFit fit = fit_model(points, model, std::vector<FitStart>{{"a", 1}, {"b", -1}, {"c", 1}});
  expect_parameter(fit.parameters[0], 0.789309301549796212, 0.00272885501247083965, 1e-10);
  expect_parameter(fit.parameters[1], -0.584150721853425017, 0.00471598854690390398, 1e-10);
  expect_parameter(fit.parameters[2], 1.96792453705011109, 0.0373258413054338318, 1e-10);
  EXPECT_NEAR(fit.correlation[2][0], 0.651066624259463473, 1e-8);
  EXPECT_NEAR(fit.correlation[2][1], 0.170415022728021828, 1e-8);
  EXPECT_NEAR(fit.correlation[0][1], -0.402927134192224177, 1e-8);
}

TEST(CurveFit, LineFarFromTheOrigin) {
  const CurveFit fit = fit_line({{1000001, 1000002, 1000003, 1000005, 1000008}, {3.1, 4.9, 7.2, 11.1, 16.8}});
  expect_parameter(fit.parameters[0], -1968180.67727272727, 28833.5208132582043, 1e-13);
  expect_parameter(fit.parameters[1], 1.96818181818181818, 0.0288334112462066621, 1e-13);
  EXPECT_NEAR(fit.residual_deviation / 0.160018938273132553, 1, 1e-12);
  const CurvePoint at = fit.at(1000004.5);
  EXPECT_NEAR(at.y, 9.99772727272727273, 1e-12);
  EXPECT_NEAR((at.high - at.y) / 3.1824463052837096, 0.074354430044333141, 1e-13);  // t of 3 degrees
  EXPECT_EQ(fit.correlation[0][1], fit.correlation[1][0]);
}

TEST(CurveFit, WeightsCountByTheirRatios) {
  FitPoints points = {{1, 2, 3, 5, 8, 100}, {3.1, 4.9, 7.2, 11.1, 16.8, 0}, {1, 0.5, 2, 1, 0.25, 0}};
  for (const double factor : {1.0, 1e-12}) {
    for (double& weight : points.weights) weight *= factor;
    const CurveFit fit = fit_line(points);
    EXPECT_EQ(fit.points, 5U);
    expect_parameter(fit.parameters[0], 1.16546762589928058, 0.130248283512963247, 1e-13);
    expect_parameter(fit.parameters[1], 1.98093525179856115, 0.0360514692445550136, 1e-13);
    EXPECT_NEAR(fit.correlation[0][1], -0.874074820122097488, 1e-12);
    EXPECT_NEAR(*fit.r_squared, 0.999007351900866428, 1e-14);
    const CurveModel line = [](double x, std::span<const double> q) { return q[0] + q[1] * x; };
    const CurveFit same = fit_model(points, line, std::vector<FitStart>{{"a", 0}, {"b", 0}});
    expect_parameter(same.parameters[0], 1.16546762589928058, 0.130248283512963247, 1e-10);
    expect_parameter(same.parameters[1], 1.98093525179856115, 0.0360514692445550136, 1e-10);
    EXPECT_NEAR(same.at(4).high - same.at(4).low, fit.at(4).high - fit.at(4).low, 1e-9);
  }
}

TEST(CurveFit, PowerLawInSIUnits) {
  FitPoints points = {{1e6, 2e6, 4e6, 7e6, 1e7, 2.5e7, 6e7},
                      {0.0031, 0.0058, 0.0122, 0.0199, 0.0311, 0.0702, 0.178}};
  const CurveFit fit = fit_power(points);
  expect_parameter(fit.parameters[0], 2.13981376191469427e-9, 6.9094958765089639e-10, 1e-9);
  expect_parameter(fit.parameters[1], 1.01805967819976749, 0.0182211565883503191, 1e-10);
  EXPECT_NEAR(fit.correlation[0][1], -0.999645864753593798, 1e-9);
  EXPECT_NEAR(*fit.r_squared, 0.99940091644884685, 1e-13);
  EXPECT_NEAR(fit.at(3e6).y, 2.13981376191469427e-9 * std::pow(3e6, 1.01805967819976749), 1e-11);
  points.weights = {4, 3, 2, 2, 1, 1, 0.5};
  const CurveFit weighted = fit_power(points);
  expect_parameter(weighted.parameters[0], 2.38256305200272736e-9, 7.03394984428718216e-10, 1e-9);
  expect_parameter(weighted.parameters[1], 1.01183775113631708, 0.0168419667529143706, 1e-10);
}

TEST(CurveFit, PowerLawThroughZeroAndBelow) {
  FitPoints points = {{0, 1, 2, 3, 4}, {0, -2, -8, -18, -32}};
  const CurveFit fit = fit_power(points);
  EXPECT_NEAR(fit.parameters[0].value, -2, 1e-12);
  EXPECT_NEAR(fit.parameters[1].value, 2, 1e-12);
  points.x[1] = -1;
  EXPECT_EQ(
      error_of([&] { fit_power(points); }),
      "the power law has no value at x = -1; it is fitted for x of 0 and above; leave other rows out, or "
      "give a function as the model");
  EXPECT_NE(error_of([] {
              fit_power({{1, 1, 1, 1}, {1, 2, 3, 4}});
            }).find("do not determine"),
            std::string::npos);
}

TEST(CurveFit, PointsOnTheCurveLeaveNoScatter) {
  const CurveFit line = fit_line({{0, 1, 2, 3}, {1, 3, 5, 7}});
  EXPECT_EQ(line.parameters[0].value, 1);
  EXPECT_EQ(line.parameters[1].value, 2);
  EXPECT_EQ(line.residual_deviation, 0);
  EXPECT_EQ(*line.r_squared, 1);
  EXPECT_FALSE(fit_line({{0, 1, 2, 3}, {4, 4, 4, 4}}).r_squared);
  const CurveModel wave = [](double x, std::span<const double> q) { return q[0] * std::sin(q[1] * x); };
  FitPoints points;
  for (int k = 1; k < 20; ++k) {
    points.x.push_back(0.1 * k);
    points.y.push_back(1e-6 * std::sin(2.5 * 0.1 * k));
  }
  const CurveFit fit = fit_model(points, wave, std::vector<FitStart>{{"a", 5e-7}, {"k", 2}});
  EXPECT_NEAR(fit.parameters[0].value / 1e-6, 1, 1e-12);
  EXPECT_NEAR(fit.parameters[1].value, 2.5, 1e-12);
}

TEST(CurveFit, ParametersOfAnyScaleFromZero) {
  // Parameters of 1e-7 and 1e9 that begin at 0, and one whose answer is 0.
  const CurveModel model = [](double x, std::span<const double> q) { return q[0] + q[1] * x + q[2] * x * x; };
  FitPoints points;
  const double scatter[] = {1, -2, 1, 1, -2, 1};
  for (int k = 0; k < 6; ++k) {
    const double x = 1e-8 * (k + 1);
    points.x.push_back(x);
    points.y.push_back(1e9 * x * x + 1e-9 * scatter[k]);
  }
  const CurveFit fit = fit_model(points, model, std::vector<FitStart>{{"c", 0}, {"b", 0}, {"a", 0}});
  // The residuals of a least sum are orthogonal to 1, x and x².
  double sum = 0, moment = 0, second = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const double r = fit.residuals[k] / 1e-9, x = points.x[k] / 1e-8;
    sum += r, moment += r * x, second += r * x * x;
  }
  EXPECT_NEAR(sum, 0, 1e-7);
  EXPECT_NEAR(moment, 0, 1e-7);
  EXPECT_NEAR(second, 0, 1e-6);
}

TEST(CurveFit, NamesWhatThePointsDoNotDetermine) {
  const FitPoints points = {{1, 2, 3, 4, 5}, {1.1, 1.9, 3.2, 3.9, 5.1}};
  const CurveModel sum = [](double x, std::span<const double> q) { return (q[0] + q[1]) * x + q[2]; };
  EXPECT_EQ(error_of([&] {
              fit_model(points, sum, std::vector<FitStart>{{"tau0", 1}, {"alpha", 0.5}, {"c", 0}});
            }),
            "the points do not tell `tau0` and `alpha` apart: they can change together and leave every "
            "fitted value "
            "as it is; fix all but one of them, or measure where they act differently");
  const CurveModel idle = [](double x, std::span<const double> q) { return q[0] * x; };
  EXPECT_EQ(error_of([&] {
              fit_model(points, idle, std::vector<FitStart>{{"k", 1}, {"idle", 3}});
            }),
            "the points say nothing of `idle`: the model does not change with it; leave out what the model "
            "does not "
            "use, or begin from values at which it acts");
  EXPECT_EQ(
      error_of([] {
        fit_line({{2, 2, 2}, {1, 2, 3}});
      }),
      "the points do not tell `intercept` and `slope` apart: x is 2 in all of them; measure at two or more "
      "values of x");
}

TEST(CurveFit, SaysWhatRunsAwayWhereTheModelHasNoBest) {
  // Points that bend upwards, and a model that bends downwards: it is best as a straight line, at infinity.
  const FitPoints points = {{1, 2, 4, 7, 10, 25, 60},
                            {0.0031, 0.0058, 0.0122, 0.0199, 0.0311, 0.0702, 0.178}};
  const CurveModel bent = [](double x, std::span<const double> q) {
    return q[0] * (1 - std::exp(-x / q[1]));
  };
  EXPECT_EQ(
      error_of([&] {
        fit_model(points, bent, std::vector<FitStart>{{"s", 1}, {"p0", 300}});
      }),
      "the points do not determine `s` and `p0`: the sum of squares falls for ever as they grow; the points "
      "may show less than the model has, as a straight line where it bends: fit a simpler one");
}

TEST(CurveFit, RefusesWhatCannotBeFitted) {
  EXPECT_EQ(
      error_of([] {
        fit_line({{1, 2}, {1, 2}});
      }),
      "2 parameters cannot be fitted with intervals to 2 points; give at least 3 rows with numbers in all "
      "columns and a weight above 0");
  EXPECT_NE(error_of([] { fit_line({{1, 2, 3}, {1, 2}}); }), "");
  EXPECT_NE(error_of([] {
              fit_line({{1, 2, 3}, {1, 2, 3}, {1, -1, 1}});
            }).find("weight of point 2 is -1"),
            std::string::npos);
  EXPECT_NE(error_of([] { fit_line({{1, 2, 3}, {1, 2, std::nan("")}}); }).find("point 3"), std::string::npos);
  const CurveModel root = [](double x, std::span<const double> q) { return std::sqrt(x - q[0]); };
  EXPECT_NE(error_of([&] {
              fit_model({{1, 2, 3}, {1, 1, 2}}, root, std::vector<FitStart>{{"x0", 2}});
            }).find("no finite number at every x with the start x0 = 2"),
            std::string::npos);
  const CurveModel step = [](double x, std::span<const double> q) { return x > q[0] ? 1.0 : 0.0; };
  EXPECT_NE(error_of([&] {
              fit_model({{1, 2, 3}, {0, 1, 1}}, step, std::vector<FitStart>{{"at", 2.5}});
            }),
            "");
}

TEST(CurveFit, BandHoldsTheTrueCurveAsOftenAsItSays) {
  const Stream random(1, "band");
  const CurveModel model = [](double x, std::span<const double> q) { return q[0] * x / (q[1] + x); };
  constexpr int sets = 400;
  int held = 0, held_slope = 0;
  for (int set = 0; set < sets; ++set) {
    FitPoints points;
    for (int k = 0; k < 8; ++k) {
      points.x.push_back(k + 1);
      points.y.push_back((k + 1) / (3.0 + k + 1) +
                         0.02 * random.normal(static_cast<std::uint64_t>(8 * set + k)));
    }
    const CurveFit fit = fit_model(points, model, std::vector<FitStart>{{"a", 1}, {"k", 2}});
    const CurvePoint at = fit.at(4.5);
    held += at.low <= 4.5 / 7.5 && 4.5 / 7.5 <= at.high ? 1 : 0;
    held_slope += fit.parameters[0].low <= 1 && 1 <= fit.parameters[0].high ? 1 : 0;
  }
  // Binomial standard error 1.1 %.
  EXPECT_NEAR(static_cast<double>(held) / sets, 0.95, 0.035);
  EXPECT_NEAR(static_cast<double>(held_slope) / sets, 0.95, 0.035);
}

TEST(SampledCurve, CoversTheRangeInAscendingOrder) {
  const CurveFit fit = fit_line({{1, 2, 3, 1000}, {1, 2.5, 3, 1000}});
  const auto curve = sampled_curve(fit, 1, 1000, 50);
  EXPECT_EQ(curve.front().x, 1);
  EXPECT_EQ(curve.back().x, 1000);
  for (std::size_t k = 1; k < curve.size(); ++k) EXPECT_GT(curve[k].x, curve[k - 1].x);
  EXPECT_LT(curve[1].x, 1.2);  // steps of equal ratio for a logarithmic axis
}

}  // namespace
}  // namespace asperity::curve_fit_test
