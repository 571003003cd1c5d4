// SPDX-License-Identifier: GPL-3.0-or-later
// Student's t, F and normal distributions for real degrees of freedom. t and F use Boost's incomplete beta
// function, with relative errors below 2e-11 for degrees from 0.1 to 1e11, and exponentials of the C library:
// for reports only, because last digits may depend on the processor. Normal quantiles have the same bits
// everywhere, for inputs of runs. Thread-safe; microseconds per call.
#pragma once

namespace asperity {

// The t with P(|T| <= t) = `confidence`; `degrees` > 0, infinite: normal. Throws Error{bad_value} otherwise.
double student_t_factor(double confidence, double degrees);

// P(F <= f); degrees > 0 and finite.
double f_cdf(double f, double between, double within);

// The z with P(Z < z) = `p`, ±infinity at 0 and 1. Throws Error{bad_value} for other p.
double normal_quantile(double p);

}  // namespace asperity
