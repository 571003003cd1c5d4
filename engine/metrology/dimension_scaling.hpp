// SPDX-License-Identifier: GPL-3.0-or-later
// Tests if a statistic of profiles scales with one fractal dimension: then local dimensions between
// neighbouring steps are equal. Smooth short steps or saturated long ones make them run.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace asperity {

// Least-squares line y = intercept + slope·x.
struct LineFit {
  double slope = 0, intercept = 0;
  double slope_error = 0;  // from the residuals; 0 for two points
  double r_squared = 0;    // explained share of the variance of y; 1 for constant y
};

// Equal lengths; two different x or more. O(n).
LineFit fit_line(std::span<const double> x, std::span<const double> y);

struct ScalingSteps {
  std::span<const double> steps;           // samples, rising; three or more
  std::span<const double> log_statistics;  // as used in the line fit
  double at_zero = 0, per_slope = 1;       // D = at_zero + per_slope · slope
};

// D between neighbouring steps.
std::vector<double> local_dimensions(const ScalingSteps& scaling);

// Empty unless the local dimensions run; else the text names the run and the steps of constant dimension. A
// run is monotonic over four equal logarithmic stretches. It exceeds 0.4 (D - 1), limited to 0.03 … 0.1, by
// twice the scatter of fractional Brownian profiles, `scatter` · √(longest step / samples). The scatter falls
// below D = 1.5 (to 0.4 at 1) and with the number of profiles a longest step apart. `scatter`: mean
// differences 0.5, lengths without offsets 1.2.
std::string running_dimension(const ScalingSteps& scaling, double D, int samples, int profiles,
                              double scatter);

// Empty unless the smallest boxes see less than 0.4 (D - 1). Fractional Brownian profiles: half to two
// thirds.
std::string smooth_in_small_boxes(const ScalingSteps& scaling, double D);

// True minus measured D for fractional Brownian profiles and default boxes. Linear in D and log samples (150,
// 1024, 16384), constant outside.
double box_counting_bias(double D, int samples);

}  // namespace asperity
