// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a statistic of profiles scales, so that one fractal dimension describes it: the dimensions between
// neighbouring steps (local slopes) of a fractal are alike, those of a face that is smooth over short steps
// or ends its growth at long ones run from step to step. And what box counting misses of a dimension that is
// known.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace asperity {

struct ScalingSteps {
  std::span<const double> steps;           // samples, rising, three or more
  std::span<const double> log_statistics;  // of each, as the line through them takes them
  double at_zero = 0, per_slope = 1;       // D = at_zero + per_slope · slope
};

// D between neighbours: one less than steps.
std::vector<double> local_dimensions(const ScalingSteps& scaling);

// Empty where the local dimensions do not run; else from where to where they run, and over which steps in a
// row they are constant. `D` was found over all steps, of so many profiles of so many samples. They run where
// four of them, over stretches alike on a logarithmic axis, rise or fall throughout by more than two fifths
// of D - 1 (at least 0.03, at most 0.1) and twice the scatter that fractional Brownian profiles show:
// `scatter` · √(longest step / samples), which D below 1.5 lowers, to two fifths at 1, and as many profiles
// as lie further apart than that step, taken as neighbouring rows of a map. Measured scatter: 0.5 of mean
// differences, 1.2 of lengths without offsets.
std::string running_dimension(const ScalingSteps& scaling, double D, int samples, int profiles,
                              double scatter);

// Empty unless boxes of the smallest sides see less than two fifths of the D - 1 that all sides find: on
// fractional Brownian profiles of any D and of 150 to 16384 samples they see half to two thirds.
std::string smooth_in_small_boxes(const ScalingSteps& scaling, double D);

// What counting boxes of the default sides misses of the dimension of fractional Brownian profiles, where it
// finds D on so many samples: means over 32 to 64 exact profiles of each of eleven dimensions from 1.05 to
// 1.95, linear in D and in the logarithm of the samples between 150, 1024 and 16384, and constant beyond.
double box_counting_bias(double D, int samples);

}  // namespace asperity
