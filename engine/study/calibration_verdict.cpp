// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/calibration_problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "engine/core/text.hpp"
#include "engine/statistics/distributions.hpp"

namespace asperity {

namespace {

constexpr double main_part = 0.01;     // component of an undetermined direction
constexpr double seen_by_law = 1e-5;   // relative, without noise
constexpr double weak_part = 0.3;      // component of the weakest direction
constexpr double weak_condition = 10;  // above: hardly separable
constexpr double level_of_residuals = 0.05;
constexpr int digits = 4;

std::string number(double value) { return format_short(value, digits); }

std::string signed_term(double factor, const std::string& name) {
  const std::string size = number(std::abs(factor));
  return std::string(factor < 0 ? " - " : " + ") + (size == "1" ? "" : size + " ") + name;
}

double choose(int n, int k) {
  if (k < 0 || k > n) return 0;
  double product = 1;
  for (int i = 1; i <= k; ++i) product *= static_cast<double>(n - k + i) / i;
  return product;
}

struct RunsTest {
  double p_value = 1;  // of so few runs
  int runs = 0;
  double expected = 0;
};

// By order of x; equal x count by their mean (Wald & Wolfowitz 1940).
RunsTest runs_test(std::vector<std::array<double, 2>> along) {
  std::ranges::sort(along);
  int count[2] = {0, 0}, last = -1;
  RunsTest found;
  for (std::size_t k = 0; k < along.size();) {
    double sum = 0;
    const double x = along[k][0];
    for (; k < along.size() && along[k][0] == x; ++k) sum += along[k][1];
    if (sum == 0) continue;
    const int sign = sum > 0 ? 1 : 0;
    count[sign] += 1;
    found.runs += sign != last ? 1 : 0;
    last = sign;
  }
  const int a = count[0], b = count[1];
  constexpr int most = 400;  // beyond, binomials overflow
  if (a == 0 || b == 0 || a + b > 2 * most) return found;
  found.expected = 1 + 2.0 * a * b / (a + b);
  found.p_value = 0;
  for (int runs = 2; runs <= found.runs; ++runs) {
    const int k = runs / 2;
    found.p_value +=
        (runs % 2 == 0 ? 2 * choose(a - 1, k - 1) * choose(b - 1, k - 1)
                       : choose(a - 1, k) * choose(b - 1, k - 1) + choose(a - 1, k - 1) * choose(b - 1, k)) /
        choose(a + b, a);
  }
  return found;
}

struct NeighbourTest {
  double p_value = 1, correlation = 0;
};

// Lag-one correlation; mean and variance under this Jacobian (Durbin & Watson 1950), assumed normal.
NeighbourTest neighbour_test(const std::vector<double>& residual, const CalibrationTangent& tangent) {
  const std::size_t n = residual.size(), p = tangent.rank;
  if (n < p + 6) return {};
  const auto neighbours = [](const std::vector<double>& a) {
    std::vector<double> sum(a.size());
    for (std::size_t k = 0; k + 1 < a.size(); ++k) sum[k] += a[k + 1] / 2, sum[k + 1] += a[k] / 2;
    return sum;
  };
  const auto degrees = static_cast<double>(n - p);
  double trace = 0, square = static_cast<double>(n - 1) / 2;  // of M A and its square
  for (std::size_t i = 0; i < p; ++i) {
    const std::vector<double> near = neighbours(tangent.svd.u[i]);
    trace -= scalar_product(tangent.svd.u[i], near);
    square -= 2 * scalar_product(near, near);
    for (std::size_t j = 0; j < p; ++j) {
      const double both = scalar_product(tangent.svd.u[j], near);
      square += both * both;
    }
  }
  const double mean = trace / degrees, variance = 2 * (square - trace * mean) / (degrees * (degrees + 2)),
               lag = scalar_product(residual, neighbours(residual)) / scalar_product(residual, residual);
  if (!(variance > 0)) return {};
  const double z = (lag - mean) / std::sqrt(variance);
  return {z > 0 ? (1 - f_cdf(z * z, 1, 1e9)) / 2 : 1, lag};
}

class VerdictWords {
 public:
  VerdictWords(Calibration& of, const CalibrationFindings& findings) : of_(of), f_(findings) {}

  void write() {
    tell_unseen();
    if (of_.identifiable) tell_hardly_apart();
    tell_bounds();
    tell_open_ends();
    tell_specimens();
    tell_scatter();
    tell_faces();
    if (sentences_.empty() || (of_.identifiable && !doubt_))
      sentences_.insert(sentences_.begin(), "every parameter is determined by these rows");
    for (const std::string& sentence : sentences_)
      of_.verdict += (of_.verdict.empty() ? "" : "; ") + sentence;
    tell_warnings();
  }

 private:
  const std::string& name(std::size_t p) const { return f_.problem.parameter(p).name; }

  std::string with_unit(double value, std::size_t p) const {
    const std::string& unit = f_.problem.parameter(p).unit;
    return number(value) + (unit.empty() ? "" : " " + unit);
  }

  std::string units_of(const std::vector<std::size_t>& parts) const {
    std::vector<std::string> list;
    for (const std::size_t p : parts)
      if (const std::string& unit = f_.problem.parameter(p).unit; !unit.empty())
        list.push_back(name(p) + " in " + unit);
    return list.empty() ? "" : " with " + joined(list, " and ");
  }

  std::string names(const std::vector<std::size_t>& which) const {
    std::vector<std::string> list;
    for (const std::size_t p : which) list.push_back(name(p));
    return joined(list, " and ");
  }

  std::string advice(const std::vector<std::size_t>& which) const {
    std::string text = "add rows in which " + names(which) + " act differently";
    std::vector<std::string> alike = f_.problem.rows().alike;
    if (of_.specimens.size() == 1) alike.push_back("the specimen is " + of_.specimens[0].name);
    if (!alike.empty()) text += " (" + joined(alike, " and ") + " in all rows)";
    return text;
  }

  // "0.52 (0.49 to 0.55)"; `gradient` of `value`.
  std::string with_interval(double value, const std::vector<std::pair<std::size_t, double>>& gradient) const {
    double sum = 0;
    for (const auto& [i, a] : gradient)
      for (const auto& [j, b] : gradient) sum += a * f_.covariance[i][j] * b;
    const double reach = f_.factor * std::sqrt(f_.variance * std::max(sum, 0.0));
    if (!(reach > 0)) return number(value);
    return number(value) + " (" + number(value - reach) + " to " + number(value + reach) + ")";
  }

  // Relative to each change alone.
  bool unchanged(const std::vector<double>& q) {
    for (std::size_t p = 0; p < q.size(); ++p)
      if (f_.problem.inside(q[p], p) != q[p]) return false;
    const auto there = f_.problem.place(q, &f_.at.place.roots);
    if (!there) return false;
    // A sparing fit may end by prediction.
    if (!computed_ && f_.problem.sparing()) computed_ = f_.problem.place(f_.at.place.q, &f_.at.place.roots);
    const CalibrationPlace& here = computed_ ? *computed_ : f_.at.place;
    double change = 0, alone = 0;
    for (std::size_t k = 0; k < there->residual.size(); ++k) {
      const double d = there->residual[k] - here.residual[k];
      change += d * d;
    }
    for (std::size_t i = 0; i < f_.tangent.parameters.size(); ++i) {
      const std::size_t p = f_.tangent.parameters[i];
      alone = std::max(alone, std::abs((q[p] - f_.at.place.q[p]) * f_.tangent.lengths[i]));
    }
    return std::sqrt(change) <= (f_.problem.sparing() ? 1e-2 : 1e-3) * alone;
  }

  // Constant along (`da`, `db`).
  std::string combination(std::size_t a, std::size_t b, double da, double db) {
    const std::vector<double>& q = f_.at.place.q;
    const auto scale = [&](std::size_t p) { return f_.at.scales[p]; };
    const double factor = -da / db;  // of b, for a
    std::string text = name(a) + signed_term(factor, name(b));
    text += " = " + with_interval(q[a] + factor * q[b], {{a, 1.0}, {b, factor}});
    const double together =
        q[a] != 0 && q[b] != 0 ? da / q[a] * q[b] / db : 0;  // -1 for a product, 1 for a ratio
    // Rough derivatives give the sign only; the model is the proof.
    const bool rough = f_.at.hidden > 1e-2;
    const bool like_ratio = rough ? together > 0 : std::abs(together - 1) < 1e-2,
               like_product = rough ? together < 0 : std::abs(together + 1) < 1e-2;
    proven_ = true;
    const auto moved = [&](double by_a, double by_b) {
      std::vector<double> there = q;
      there[a] *= by_a;
      there[b] *= by_b;
      return there;
    };
    // Along a ratio both fall to 0 on a straight line, as along a sum.
    if (like_ratio && (unchanged(moved(1.25, 1.25)) || unchanged(moved(0.8, 0.8))))
      return "the ratio " + name(a) + "/" + name(b) + " = " +
             with_interval(q[a] / q[b], {{a, 1 / q[b]}, {b, -q[a] / (q[b] * q[b])}}) + units_of({a, b});
    if (like_product && (unchanged(moved(1.25, 0.8)) || unchanged(moved(0.8, 1.25))))
      return "the product " + name(a) + " " + name(b) + " = " +
             with_interval(q[a] * q[b], {{a, q[b]}, {b, q[a]}}) + units_of({a, b});
    const double step = 0.1 / std::max(std::abs(da) / scale(a), std::abs(db) / scale(b));
    for (const double side : {1.0, -1.0}) {
      std::vector<double> there = q;
      there[a] += side * step * da;
      there[b] += side * step * db;
      if (unchanged(there)) return text + units_of({a, b});
    }
    proven_ = false;
    return text + " near " + name(a) + " = " + with_unit(q[a], a) + ", " + name(b) + " = " +
           with_unit(q[b], b);
  }

  void tell_unseen() {
    const CalibrationTangent& t = f_.tangent;
    bool hidden = false;
    std::vector<std::size_t> silent;
    for (std::size_t i = 0; i < t.parameters.size(); ++i)
      if (!(t.lengths[i] > 0)) silent.push_back(t.parameters[i]);
    if (!silent.empty()) {
      of_.identifiable = false;
      sentences_.push_back("these rows say nothing of " + names(silent) +
                           ": the model does not change with " + (silent.size() == 1 ? "it" : "them") +
                           " (one that answers in steps of its own needs a larger `step`)");
    }
    for (std::size_t k = t.rank; k < t.svd.values.size(); ++k) {
      std::vector<std::size_t> parts, columns;
      for (std::size_t i = 0; i < t.parameters.size(); ++i)
        if (t.lengths[i] > 0 && std::abs(t.svd.v[k][i]) > main_part) {
          parts.push_back(t.parameters[i]);
          columns.push_back(i);
        }
      if (parts.empty()) continue;
      of_.identifiable = false;
      proven_ = false;
      const auto change = [&](std::size_t part) {
        return t.svd.v[k][columns[part]] / t.lengths[columns[part]];
      };
      if (parts.size() == 2) {
        of_.combinations.push_back(combination(parts[0], parts[1], change(0), change(1)));
        sentences_.push_back(names(parts) + " are not identifiable: only " + of_.combinations.back() +
                             " is determined by these rows; " + advice(parts));
      } else {
        std::vector<std::string> changes;
        for (std::size_t i = 0; i < parts.size(); ++i)
          changes.push_back(name(parts[i]) + " by " + number(change(i) / change(0)));
        of_.combinations.push_back("what stays the same when " + joined(changes, " and ") +
                                   " change together");
        sentences_.push_back(names(parts) + " are not identifiable: together they can change (" +
                             joined(changes, " and ") + ") and no row changes; " + advice(parts));
      }
      hidden = hidden || (!proven_ && t.svd.values[k] > seen_by_law * t.svd.values[0]);
    }
    if (hidden)
      sentences_.push_back(
          "steps or noise of the model hide further information: compute it with a smaller tolerance or more "
          "cells");
  }

  void tell_hardly_apart() {
    const CalibrationTangent& t = f_.tangent;
    if (!of_.condition || *of_.condition < weak_condition || f_.factor <= 0) return;
    std::vector<std::size_t> parts;
    for (std::size_t i = 0; i < t.parameters.size(); ++i) {
      if (std::abs(t.svd.v.back()[i]) < weak_part) continue;
      const CalibratedParameter& of = of_.parameters[t.parameters[i]];
      if (!of.standard_error || f_.factor * *of.standard_error < std::abs(*of.value)) return;
      parts.push_back(t.parameters[i]);
    }
    if (parts.size() < 2) return;
    doubt_ = true;
    std::string sentence =
        "the rows hardly separate " + names(parts) + ", and their intervals reach beyond 0";
    if (parts.size() == 2) {
      const std::size_t a = parts[0], b = parts[1];
      const double factor = -f_.covariance[a][b] / f_.covariance[b][b];
      of_.combinations.push_back(
          name(a) + signed_term(factor, name(b)) + " = " +
          with_interval(f_.at.place.q[a] + factor * f_.at.place.q[b], {{a, 1.0}, {b, factor}}) +
          units_of({a, b}));
      sentence += " (correlation " + number(of_.correlation[a][b].value_or(0)) + "): best known is " +
                  of_.combinations.back();
    }
    sentences_.push_back(sentence + "; " + advice(parts));
  }

  void tell_bounds() {
    for (std::size_t p = 0; p < of_.parameters.size(); ++p) {
      if (!f_.held[p]) continue;
      doubt_ = true;
      const bool lower = of_.parameters[p].at_lower;
      const CalibrationParameter& given = f_.problem.parameter(p);
      sentences_.push_back(name(p) + " is at its " + (lower ? "lower" : "upper") + " bound " +
                           with_unit(lower ? *given.lower : *given.upper, p) + ": the rows fit better with " +
                           (lower ? "less" : "more"));
    }
    for (std::size_t p = 0; p < of_.parameters.size(); ++p) tell_moved(p);
  }

  void tell_moved(std::size_t p) {
    if (of_.parameters[p].determined || !(f_.moved[p] > 0)) return;
    std::string text = name(p);
    double value = f_.at.place.q[p];
    std::vector<std::size_t> parts = {p};
    for (const CalibrationBound& bound : f_.bounds) {
      if (bound.moves[p] == 0) continue;
      text += signed_term(-bound.moves[p], name(bound.parameter));
      value -= bound.moves[p] * f_.at.place.q[bound.parameter];
      parts.push_back(bound.parameter);
    }
    of_.identifiable = false;
    of_.combinations.push_back(text + " = " + with_interval(value, {{p, 1.0}}) + units_of(parts));
    std::vector<std::size_t> bounds(parts.begin() + 1, parts.end());
    sentences_.push_back(name(p) + " is not determined, because " + names(bounds) +
                         " may leave the bound: only " + of_.combinations.back() +
                         " is known from these rows; " + advice(parts));
  }

  void tell_open_ends() {
    for (std::size_t p = 0; p < f_.profiles.size(); ++p) {
      const CalibrationProfile& of = f_.profiles[p];
      if (of.points.empty()) continue;
      const auto tell = [&](bool open, bool at_bound, const char* which) {
        if (!open || (f_.held[p] && at_bound)) return;
        doubt_ = true;
        sentences_.push_back("the rows give no " + std::string(which) + " limit of " + name(p) +
                             (at_bound ? " within its bounds" : ""));
      };
      tell(!of.low && !of_.parameters[p].at_lower, of.low_at_bound, "lower");
      tell(!of.high && !of_.parameters[p].at_upper, of.high_at_bound, "upper");
    }
  }

  void tell_specimens() {
    const std::size_t count = of_.specimens.size();
    if (count == 0) return;
    const auto of_test = [&](const SpecimenScatter& test) {
      return "F(" + std::to_string(test.between) + ", " + std::to_string(test.within) +
             ") = " + number(test.f) + ", p = " + format_short(test.p_value, 2);
    };
    if (of_.by_specimens) {
      std::string sentence;
      if (of_.specimen_scatter && f_.options.basis == CalibrationBasis::automatic)
        sentence = "specimens scatter more than their repeats (" + of_test(*of_.specimen_scatter) + "): ";
      sentences_.push_back(sentence + "intervals rest on the means of " + std::to_string(count) +
                           " specimens, with " + counted(of_.degrees, "degree") + " of freedom");
    } else if (of_.specimen_scatter) {
      const bool seen = of_.specimen_scatter->p_value < 0.05;
      sentences_.push_back((seen ? "specimens scatter more than their repeats ("
                                 : "specimens are not seen to scatter more than their repeats (") +
                           of_test(*of_.specimen_scatter) +
                           (seen ? "), and intervals by rows are too narrow" : ")"));
    } else if (count < of_.residuals.size()) {
      doubt_ = true;
      sentences_.push_back((count == 1
                                ? std::string("all rows are of one specimen")
                                : std::to_string(count) + " specimens are no more than the parameters") +
                           ": whether specimens scatter cannot be seen, and intervals hold for " +
                           (count == 1 ? "this one" : "these") + " only");
    }
    const std::size_t parameters = of_.parameters.size();
    if (of_.specimen_scatter && !of_.by_specimens && count < parameters + 4)
      of_.warnings.push_back(std::to_string(count) +
                             " specimens can hide a scatter between them as large as that of repeats, and "
                             "intervals are then too narrow; measure six or more");
  }

  void tell_faces() {
    if (f_.problem.rows().replicates < 2) return;
    std::vector<std::string> shares;
    for (const CalibratedParameter& of : of_.parameters)
      if (of.standard_error)
        shares.push_back(format_short(100 * of.share_of_faces, 3) + " % of u² of " + of.name);
    sentences_.push_back("the model is a mean over " + std::to_string(f_.problem.rows().replicates) +
                         " replicates, whose scatter makes " + joined(shares, " and "));
  }

  void tell_scatter() {
    if (of_.degrees == 0) {
      doubt_ = true;
      sentences_.push_back(
          f_.factor > 0 ? "there are no more rows than parameters: intervals rest on `u` alone"
                        : "there are no more rows than parameters: no scatter can be seen, and there are "
                          "no intervals");
    } else if (!(f_.variance > 0)) {
      doubt_ = true;
      sentences_.push_back(
          "the model passes through every row: no scatter is seen, and intervals have no width");
    }
  }

  void tell_warnings() {
    if (f_.at.noisy)
      of_.warnings.push_back(
          "the fit ended in the noise of the model: compute the model with a smaller tolerance, or give the "
          "parameters a larger `step`");
    if (f_.begun_again > 0)
      of_.warnings.push_back("the sum of squares has more than one minimum; the fit began again " +
                             counted(static_cast<std::size_t>(f_.begun_again), "time") + " from a lower one");
    for (const CalibratedParameter& of : of_.parameters) {
      if (!of.low || !of.profile_low || !of.profile_high) continue;
      const double reach = (*of.high - *of.low) / 2;
      const double apart =
          std::max(std::abs(*of.low - *of.profile_low), std::abs(*of.high - *of.profile_high));
      if (apart > 0.2 * reach)
        of_.warnings.push_back("the model is curved in " + quoted(of.name) +
                               ": take the interval of its profile, " + number(*of.profile_low) + " to " +
                               number(*of.profile_high) + ", not the linearised one");
    }
    tell_residuals();
    const bool known = !f_.problem.rows().u.empty() && !f_.options.relative_u && !of_.by_specimens;
    if (!known || of_.degrees == 0) return;
    // S over its degrees is 1 for a correct `u`.
    const double share = f_cdf(f_.scatter, static_cast<double>(of_.degrees), 1e9);
    if (share > 0.99 || share < 0.01)
      of_.warnings.push_back("the rows scatter " + format_short(std::sqrt(f_.scatter), 3) +
                             " times as far as `u` says; intervals rest on `u`");
  }

  void tell_residuals() {
    const std::vector<double>& r = f_.at.place.residual;
    const CalibrationRows& rows = f_.problem.rows();
    std::set<std::array<double, 3>> distinct;
    for (std::size_t k = 0; k < rows.y.size(); ++k)
      distinct.insert({rows.y[k], f_.at.place.fitted[k], rows.x.empty() ? 0 : rows.x[k]});
    const std::size_t copies = rows.y.size() - distinct.size();
    if (copies > 0 && 2 * copies >= rows.y.size())
      of_.warnings.push_back(
          std::to_string(copies) + " of " + std::to_string(rows.y.size()) +
          " rows repeat another row exactly: leave out copies, or intervals are too narrow");
    if (!(f_.scatter > 0)) return;
    std::vector<std::array<double, 2>> along;
    for (std::size_t i = 0; i < r.size(); ++i)
      along.push_back({f_.problem.observed_mean(rows.x.empty() ? f_.at.place.fitted : rows.x, i), r[i]});
    if (const auto [p_value, runs, expected] = runs_test(std::move(along)); p_value < level_of_residuals)
      of_.warnings.push_back(
          "residuals keep their sign along " + std::string(rows.x.empty() ? "the fit" : "x") + ": " +
          std::to_string(runs) + " runs, " + number(expected) + " expected (p = " + format_short(p_value, 2) +
          "); the model has another shape, or rows share errors, and intervals are unreliable");
    if (!of_.specimens.empty() && !of_.by_specimens) return;
    if (const auto [p_value, lag] = neighbour_test(r, f_.tangent); p_value < level_of_residuals)
      of_.warnings.push_back(
          "neighbouring " + std::string(of_.by_specimens ? "specimens" : "rows") +
          " have like residuals: correlation " + format_short(lag, 2) + " (p = " + format_short(p_value, 2) +
          "); intervals are too narrow unless rows that share an error are one `specimen`");
  }

  Calibration& of_;
  const CalibrationFindings& f_;
  std::vector<std::string> sentences_;
  std::optional<CalibrationPlace> computed_;
  bool doubt_ = false, proven_ = false;
};

}  // namespace

void add_verdict(Calibration& calibration, const CalibrationFindings& findings) {
  VerdictWords(calibration, findings).write();
}

}  // namespace asperity
