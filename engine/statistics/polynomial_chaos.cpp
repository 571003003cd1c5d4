// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/polynomial_chaos.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/core/require.hpp"
#include "engine/statistics/least_squares.hpp"

namespace asperity {

namespace {

constexpr double runs_a_term = 1.5;
constexpr std::size_t most_terms = 300;
constexpr int highest_degree = 12;
constexpr double good_below = 0.05, rough_below = 0.20;

// Orthonormal polynomials of one coordinate.
void polynomials(InputShape shape, double x, std::span<double> values) {
  values[0] = 1;
  if (values.size() > 1) values[1] = shape == InputShape::uniform ? std::sqrt(3.0) * x : x;
  for (std::size_t n = 2; n < values.size(); ++n) {
    const double k = static_cast<double>(n);
    if (shape == InputShape::uniform)
      // k P_k = (2k - 1) x P_{k-1} - (k - 1) P_{k-2}, norm 1/sqrt(2k + 1).
      values[n] = std::sqrt(2 * k + 1) / k *
                  (std::sqrt(2 * k - 1) * x * values[n - 1] - (k - 1) / std::sqrt(2 * k - 3) * values[n - 2]);
    else
      // He_k = x He_{k-1} - (k - 1) He_{k-2}, norm sqrt(k!).
      values[n] = (x * values[n - 1] - std::sqrt(k - 1) * values[n - 2]) / std::sqrt(k);
  }
}

void add_terms(std::vector<int>& term, std::size_t input, int left, std::vector<std::vector<int>>& terms) {
  if (input + 1 == term.size()) {
    term[input] = left;
    terms.push_back(term);
    return;
  }
  for (int degree = left; degree >= 0; --degree) {
    term[input] = degree;
    add_terms(term, input + 1, left - degree, terms);
  }
}

// Infinite if run i alone determines a term.
double left_out(const LinearLeastSquares& fit, std::size_t i) {
  const double free = 1 - fit.leverage[i];
  return free > 1e-10 ? fit.residuals[i] / free : std::numeric_limits<double>::infinity();
}

double value_of_term(const std::vector<int>& term, const std::vector<std::vector<double>>& table) {
  double value = 1;
  for (std::size_t j = 0; j < term.size(); ++j) value *= table[j][static_cast<std::size_t>(term[j])];
  return value;
}

struct ShareSums {
  double variance = 0;
  std::vector<double> first, total;
};

ShareSums share_sums(const std::vector<std::vector<int>>& terms, std::span<const double> coefficients) {
  const std::size_t inputs = terms.front().size();
  ShareSums sums{0, std::vector<double>(inputs), std::vector<double>(inputs)};
  for (std::size_t k = 1; k < terms.size(); ++k) {
    const double square = coefficients[k] * coefficients[k];
    const auto in = std::ranges::count_if(terms[k], [](int degree) { return degree > 0; });
    sums.variance += square;
    for (std::size_t j = 0; j < inputs; ++j) {
      if (terms[k][j] == 0) continue;
      sums.total[j] += square;
      if (in == 1) sums.first[j] += square;
    }
  }
  if (sums.variance > 0)
    for (std::size_t j = 0; j < inputs; ++j) {
      sums.first[j] /= sums.variance;
      sums.total[j] /= sums.variance;
    }
  return sums;
}

double jackknife(const std::vector<double>& without) {
  const double n = static_cast<double>(without.size());
  double mean = 0, squares = 0;
  for (const double value : without) mean += value / n;
  for (const double value : without) squares += (value - mean) * (value - mean);
  return std::sqrt((n - 1) / n * squares);
}

void fill_shares(PolynomialChaos& chaos, const LinearLeastSquares& fit) {
  const ShareSums of_all = share_sums(chaos.degrees, chaos.coefficients);
  chaos.mean = chaos.coefficients.front();
  chaos.variance = of_all.variance;
  const std::size_t inputs = chaos.inputs.size();
  std::vector<std::vector<double>> first(inputs), total(inputs);
  for (std::size_t i = 0; i < chaos.runs; ++i) {
    std::vector<double> coefficients = chaos.coefficients;
    const double missed = left_out(fit, i);
    for (std::size_t k = 0; k < coefficients.size(); ++k) coefficients[k] -= fit.influence[i][k] * missed;
    const ShareSums sums = share_sums(chaos.degrees, coefficients);
    for (std::size_t j = 0; j < inputs; ++j) {
      first[j].push_back(sums.first[j]);
      total[j].push_back(sums.total[j]);
    }
  }
  const double lack = chaos.leave_one_out / 2;
  for (std::size_t j = 0; j < inputs; ++j) {
    const double of_first = jackknife(first[j]), of_total = jackknife(total[j]);
    chaos.shares.push_back({chaos.inputs[j].name, of_all.first[j], of_all.total[j],
                            std::sqrt(of_first * of_first + lack * lack),
                            std::sqrt(of_total * of_total + lack * lack)});
  }
}

void check_answers(std::span<const UncertainInput> inputs, std::span<const std::vector<double>> points,
                   std::span<const double> answers, int highest) {
  check_inputs(inputs);
  if (points.size() != answers.size())
    refuse(std::to_string(points.size()) + " points have " + std::to_string(answers.size()) + " answers");
  const double least = runs_a_term * static_cast<double>(inputs.size() + 1);
  if (static_cast<double>(points.size()) < least)
    refuse(std::to_string(points.size()) + " runs are too few for " + counted(inputs.size(), "input"),
           "give at least " + format_short(std::ceil(least)) + ", better " +
               std::to_string(chaos_runs(inputs.size())));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].size() != inputs.size())
      refuse("a point has " + std::to_string(points[i].size()) + " coordinates for " +
             std::to_string(inputs.size()) + " inputs");
    if (has_square(answers[i])) continue;
    std::string where;
    for (std::size_t j = 0; j < inputs.size(); ++j)
      where += (j == 0 ? "" : ", ") + inputs[j].name + " = " + format_short(inputs[j].at(points[i][j]));
    if (std::isfinite(answers[i]))
      refuse("the answer at " + where + " is " + format_short(answers[i]) +
                 ", whose square leaves the range of numbers",
             "return it in another unit");
    refuse("the answer at " + where + " is not finite",
           "a share needs an answer over the whole range of the inputs: make the ranges narrower");
  }
  if (highest < 1 || highest > highest_degree)
    refuse("the highest degree is " + std::to_string(highest),
           "give one from 1 to " + std::to_string(highest_degree));
}

using PolynomialTable = std::vector<std::vector<double>>;  // per input, of each degree

PolynomialTable table_of(std::span<const UncertainInput> inputs, std::span<const double> point, int degree) {
  PolynomialTable table;
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    table.emplace_back(static_cast<std::size_t>(degree) + 1);
    polynomials(inputs[j].shape, point[j], table.back());
  }
  return table;
}

void add_degree(int degree, const std::vector<PolynomialTable>& tables, std::vector<std::vector<int>>& terms,
                TableColumns& columns) {
  std::vector<int> term(tables.front().size());
  add_terms(term, 0, degree, terms);
  for (std::size_t k = columns.size(); k < terms.size(); ++k) {
    std::vector<double>& column = columns.emplace_back(tables.size());
    for (std::size_t i = 0; i < tables.size(); ++i) column[i] = value_of_term(terms[k], tables[i]);
  }
}

}  // namespace

std::size_t chaos_terms(std::size_t inputs, int degree) {
  double count = 1;
  for (int k = 1; k <= degree; ++k)
    count = count * static_cast<double>(inputs + static_cast<std::size_t>(k)) / k;
  return static_cast<std::size_t>(std::min(std::round(count), 1e9));
}

std::size_t chaos_runs(std::size_t inputs) { return std::bit_ceil(3 * chaos_terms(inputs, 2)); }

ChaosTrust PolynomialChaos::trust() const {
  return leave_one_out < good_below    ? ChaosTrust::good
         : leave_one_out < rough_below ? ChaosTrust::rough
                                       : ChaosTrust::refused;
}

double PolynomialChaos::at(std::span<const double> coordinates) const {
  const PolynomialTable table = table_of(inputs, coordinates, degree);
  double sum = 0;
  for (std::size_t k = 0; k < degrees.size(); ++k) sum += coefficients[k] * value_of_term(degrees[k], table);
  return sum;
}

std::string PolynomialChaos::text() const {
  std::string said = "polynomial chaos of degree " + std::to_string(degree) + " from " +
                     std::to_string(runs) + " runs, leave-one-out error " +
                     format_short(100 * leave_one_out, 2) + " %";
  if (trust() == ChaosTrust::rough) said += ": the shares of inputs are rough";
  if (trust() == ChaosTrust::refused) said += ": it gives no shares of inputs";
  return said;
}

PolynomialChaos polynomial_chaos(std::span<const UncertainInput> inputs,
                                 std::span<const std::vector<double>> points, std::span<const double> answers,
                                 int highest) {
  check_answers(inputs, points, answers, highest);
  PolynomialChaos found;
  const std::size_t runs = found.runs = points.size();
  found.inputs.assign(inputs.begin(), inputs.end());

  // No square may overflow.
  double scale = 0, mean = 0, scatter = 0;
  for (const double answer : answers) scale = std::max(scale, std::abs(answer));
  if (scale == 0) scale = 1;
  std::vector<double> scaled;
  for (const double answer : answers) scaled.push_back(answer / scale);
  for (const double answer : scaled) mean += answer / static_cast<double>(runs);
  for (const double answer : scaled) scatter += (answer - mean) * (answer - mean);
  if (scatter <= 1e-28 * static_cast<double>(runs)) {
    found.terms = 1;
    found.mean = mean * scale;
    found.degrees = {std::vector<int>(inputs.size())};
    found.coefficients = {found.mean};
    for (const UncertainInput& input : inputs) found.shares.push_back({input.name, 0, 0, 0, 0});
    return found;
  }

  highest = std::min(highest, std::max(1, static_cast<int>(std::bit_width(runs)) - 1));
  std::vector<PolynomialTable> tables;
  for (const std::vector<double>& point : points) tables.push_back(table_of(inputs, point, highest));
  std::vector<std::vector<int>> terms;
  TableColumns columns;
  std::optional<LinearLeastSquares> best;
  for (int degree = 0; degree <= highest; ++degree) {
    const std::size_t count = chaos_terms(inputs.size(), degree);
    if (runs_a_term * static_cast<double>(count) > static_cast<double>(runs)) break;
    if (degree > 2 && count > most_terms) break;
    add_degree(degree, tables, terms, columns);
    if (degree == 0) continue;
    LinearLeastSquares fit = linear_least_squares(columns, scaled);
    if (!(fit.independence > 1e-8)) break;
    double squares = 0;
    for (std::size_t i = 0; i < runs; ++i) squares += left_out(fit, i) * left_out(fit, i);
    const double error = squares / scatter;
    if (!std::isfinite(error) || (best && error >= found.leave_one_out)) continue;
    best = std::move(fit);
    found.degree = degree;
    found.leave_one_out = error;
    found.degrees = terms;
    if (error < 1e-20) break;
  }
  if (!best) refuse("the runs cannot separate the inputs", "give points that differ in each input alone");
  found.terms = found.degrees.size();
  found.coefficients = best->coefficients;
  fill_shares(found, *best);
  for (double& coefficient : found.coefficients) coefficient *= scale;
  found.mean *= scale;
  found.variance *= scale * scale;
  return found;
}

void require_trust(const PolynomialChaos& chaos) {
  if (chaos.trust() != ChaosTrust::refused) return;
  throw Error(ErrorCode::not_converged,
              "the answer is no polynomial of its inputs: the leave-one-out error is " +
                  format_short(100 * chaos.leave_one_out, 3) + " % of the variance with " +
                  std::to_string(chaos.runs) + " runs, above " + format_short(100 * rough_below) + " %",
              "give more `runs`, narrower inputs, or an answer without noise and jumps: keep the seed fixed "
              "inside `ask`");
}

bool has_square(double answer) {
  constexpr double least = 1e-153, most = 1e153;
  return answer == 0 || (std::abs(answer) >= least && std::abs(answer) <= most);
}

}  // namespace asperity
