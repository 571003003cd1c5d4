// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/ramp_in_noise.hpp"

#include <algorithm>

namespace asperity {

namespace {

double misfit(std::span<const double> time, std::span<const double> value, double from, double to,
              double centre, double half) {
  double sum = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double share = half > 0 ? std::clamp(0.5 + 0.5 * (time[k] - centre) / half, 0.0, 1.0)
                                  : (time[k] < centre ? 0.0 : 1.0);
    const double off = value[k] - from - share * (to - from);
    sum += off * off;
  }
  return sum;
}

}  // namespace

RampInNoise fit_hidden_ramp(std::span<const double> time, std::span<const double> value, double from,
                            double to) {
  const double first = time.front(), last = time.back(), whole = last - first;
  double best_centre = 0.5 * (first + last), best_half = 0;
  double least = misfit(time, value, from, to, best_centre, best_half);
  const auto look = [&](double centre, double half) {
    half = std::min({half, centre - first, last - centre});
    if (half < 0) return;
    const double now = misfit(time, value, from, to, centre, half);
    if (now < least) {
      least = now;
      best_centre = centre;
      best_half = half;
    }
  };
  constexpr int centres = 32, lengths = 10;
  for (int c = 1; c < centres; ++c)
    for (int l = 0; l <= lengths; ++l) look(first + whole * c / centres, 0.5 * whole * l / lengths);
  double step = whole / centres;
  for (int round = 0; round < 6; ++round, step *= 0.5) {
    const double centre = best_centre, half = best_half;
    for (int c = -1; c <= 1; ++c)
      for (int l = -1; l <= 1; ++l) look(centre + c * step, std::max(0.0, half + l * step));
  }
  return {best_centre - best_half, best_centre + best_half, least};
}

double step_misfit(std::span<const double> value, double from, double to) {
  double now = 0;
  for (const double v : value) now += (v - to) * (v - to);
  double least = now;
  for (const double v : value) {
    now += (v - from) * (v - from) - (v - to) * (v - to);
    least = std::min(least, now);
  }
  return least;
}

}  // namespace asperity
