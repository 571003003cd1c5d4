// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/calibration_problem.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr double straight_enough = 0.01;  // of the cut's root
constexpr double foretold_enough = 0.3;   // of the predicted change
constexpr double end_within = 0.003;      // of the cut's root
constexpr double sparing_within = 0.1;    // the same, for sparing fits
constexpr int most_places = 24;           // per end

// Distance from the estimate (≥ 0), root of S - S_min, parameters.
struct ProfilePlace {
  double distance = 0, root = 0;
  std::vector<double> q;
};

// First place of a side: changes of the observations.
struct FirstPlace {
  double distance = 0;
  std::vector<double> foretold, lack;  // `lack`: predicted minus actual
};

// Curvature cancels between both sides, unlike steps and noise.
bool derivatives_hold(const FirstPlace& below, const FirstPlace& above) {
  const auto within = [](const std::vector<double>& lack, const std::vector<double>& foretold) {
    return scalar_product(lack, lack) <=
           foretold_enough * foretold_enough * scalar_product(foretold, foretold);
  };
  if (below.distance == above.distance && above.distance > 0) {
    std::vector<double> odd = above.lack;
    for (std::size_t i = 0; i < odd.size(); ++i) odd[i] = (odd[i] - below.lack[i]) / 2;
    return within(odd, above.foretold);
  }
  return above.distance + below.distance > 0 && within(below.lack, below.foretold) &&
         within(above.lack, above.foretold);
}

class ProfileSide {
 public:
  ProfileSide(CalibrationProblem& problem, const CalibrationMinimum& at, std::size_t p,
              const std::vector<double>& guide, double side, double cut)
      : problem_(problem), at_(at), p_(p), guide_(guide), side_(side), cut_(cut), root_(std::sqrt(cut)) {
    const CalibrationParameter& of = problem.parameter(p);
    const std::optional<double>& bound = side > 0 ? of.upper : of.lower;
    if (bound) room_ = std::abs(*bound - at.place.q[p]);
    places_.push_back({0, 0, at.place.q});
  }

  // Nothing if S stays below the cut.
  std::optional<double> follow(double reach) {
    double next = reach;
    std::optional<ProfilePlace> inner, outer;
    inner = places_.front();
    for (int turn = 0; turn < most_places; ++turn) {
      if (room_) next = std::min(next, *room_);
      if (!(next > inner->distance)) return {};
      auto found = place_at(next, *inner);
      if (!found) {
        // No value or no minimum: halve the step.
        next = inner->distance + (next - inner->distance) / 2;
        if (++failures_ > 6) return {};
        continue;
      }
      if (lower_sum_) return {};
      places_.push_back(*found);
      if (std::abs(found->root - root_) <= (problem_.sparing() ? sparing_within : end_within) * root_)
        return ended(found->distance * (found->root > 0 ? root_ / found->root : 1));
      if (found->root > root_) {
        outer = *std::move(found);
      } else {
        if (room_ && found->distance >= *room_) {
          at_bound_ = true;
          return {};
        }
        before_ = *inner;
        inner = *std::move(found);
      }
      if (outer && outer->distance - inner->distance <= 1e-6 * outer->distance) return ended(outer->distance);
      next = next_distance(*inner, outer);
    }
    return {};
  }

  bool at_bound() const { return at_bound_; }
  const FirstPlace& first() const { return first_; }
  const std::vector<ProfilePlace>& places() const { return places_; }
  const std::optional<std::vector<double>>& lower_sum() const { return lower_sum_; }

 private:
  double ended(double distance) const {
    return at_.place.q[p_] + side_ * (room_ ? std::min(distance, *room_) : distance);
  }

  double next_distance(const ProfilePlace& inner, const std::optional<ProfilePlace>& outer) {
    if (outer) {
      const double width = outer->distance - inner.distance;
      const double share = (root_ - inner.root) / (outer->root - inner.root);
      // Every fourth step bisects.
      turns_between_ += 1;
      return inner.distance + width * (turns_between_ % 4 == 0 ? 0.5 : std::clamp(share, 0.02, 0.98));
    }
    const double climbed = before_ ? inner.root - before_->root : 0;
    const double run = before_ ? inner.distance - before_->distance : 0;
    double next = 3 * inner.distance;
    if (climbed > 0) next = inner.distance + 1.05 * run * (root_ - inner.root) / climbed;
    return std::clamp(next, 1.01 * inner.distance, 3 * inner.distance);
  }

  std::optional<ProfilePlace> place_at(double distance, const ProfilePlace& from) {
    // Along the predicted valley, or as before.
    std::vector<double> q = at_.place.q;
    const double further = side_ * (distance - from.distance);
    for (std::size_t i = 0; i < q.size(); ++i) {
      double move = guide_[i] * further;
      if (from.distance > 0) move = (from.q[i] - at_.place.q[i]) / from.distance * (distance - from.distance);
      if (i == p_) move = further;
      q[i] = problem_.inside(from.q[i] + move, i);
    }
    auto there = problem_.place(q, &at_.place.roots);
    if (!there) return {};
    if (!(from.distance == 0 && straight(*there, distance) && bounds_hold(*there))) {
      auto best = problem_.minimum_beside(*there, p_, at_, (problem_.sparing() ? 1e-2 : 1e-3) * cut_);
      if (!best) return {};
      there = std::move(best);
    }
    const double above = there->sum - at_.place.sum;
    if (above < (problem_.sparing() ? -1e-2 : -1e-3) * cut_) lower_sum_ = there->q;
    return ProfilePlace{distance, std::sqrt(std::max(above, 0.0)), std::move(there->q)};
  }

  bool bounds_hold(const CalibrationPlace& there) const {
    std::vector<bool> held(there.q.size());
    held[p_] = true;
    held = problem_.pushed(there, at_.rows_jacobian, held);
    for (std::size_t i = 0; i < held.size(); ++i)
      if (!held[i] && (problem_.at_lower(there.q[i], i) || problem_.at_upper(there.q[i], i))) return false;
    return true;
  }

  bool straight(const CalibrationPlace& there, double distance) {
    CalibrationPlace foretold = there;
    foretold.fitted = at_.place.fitted;
    for (std::size_t i = 0; i < there.q.size(); ++i)
      for (std::size_t k = 0; k < foretold.fitted.size(); ++k)
        foretold.fitted[k] += at_.rows_jacobian[i][k] * (there.q[i] - at_.place.q[i]);
    problem_.weigh(foretold, &at_.place.roots);
    FirstPlace seen{distance, {}, {}};
    for (std::size_t k = 0; k < foretold.residual.size(); ++k) {
      seen.foretold.push_back(foretold.residual[k] - at_.place.residual[k]);
      seen.lack.push_back(foretold.residual[k] - there.residual[k]);
    }
    const double sum = scalar_product(seen.lack, seen.lack);
    if (first_.distance == 0) first_ = std::move(seen);
    return sum <= straight_enough * straight_enough * cut_;
  }

  CalibrationProblem& problem_;
  const CalibrationMinimum& at_;
  std::size_t p_;
  const std::vector<double>& guide_;
  double side_, cut_, root_;
  std::optional<double> room_;
  std::vector<ProfilePlace> places_;
  std::optional<ProfilePlace> before_;
  std::optional<std::vector<double>> lower_sum_;
  FirstPlace first_;
  bool at_bound_ = false;
  int failures_ = 0, turns_between_ = 0;
};

}  // namespace

CalibrationProfile profile_of(CalibrationProblem& problem, const CalibrationMinimum& at, std::size_t p,
                              const std::vector<double>& guide, double reach, double cut, double scatter) {
  CalibrationProfile found;
  FirstPlace below, above;
  for (const double side : {-1.0, 1.0}) {
    ProfileSide one(problem, at, p, guide, side, cut);
    const std::optional<double> end = one.follow(reach);
    (side < 0 ? found.low : found.high) = end;
    (side < 0 ? found.low_at_bound : found.high_at_bound) = one.at_bound();
    for (const ProfilePlace& place : one.places())
      if (side < 0 || place.distance > 0)
        found.points.push_back({at.place.q[p] + side * place.distance, place.root * place.root / scatter});
    if (one.lower_sum() && !found.lower_sum) found.lower_sum = one.lower_sum();
    (side < 0 ? below : above) = one.first();
  }
  found.as_foretold = derivatives_hold(below, above);
  std::ranges::sort(found.points, {}, &ProfilePoint::value);
  return found;
}

}  // namespace asperity
