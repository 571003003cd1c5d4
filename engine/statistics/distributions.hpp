// SPDX-License-Identifier: GPL-3.0-or-later
// The distributions behind intervals: Student's t and F for any degrees of freedom, whole or not,
// and the normal one. Student's and F rest on the regularised incomplete beta function, by its continued
// fraction (DiDonato & Morris 1992) with the prefactor in Loader's form (2000), which does not lose digits
// for many degrees. Quantiles are solved for the smaller tail: relative errors are below 1e-12 for degrees
// from 0.1 to 1e11 and tails down to 1e-300. A t beyond 1e150 is given as infinity. Thread-safe; some
// microseconds a call.
#pragma once

namespace asperity {

// The t with P(|T| <= t) = `confidence`, 0 <= confidence <= 1: half the width of an interval in standard
// errors; `degrees` > 0, infinity for the normal distribution. Throws Error{bad_value} for a confidence
// outside, or degrees that are not above 0.
double student_t_factor(double confidence, double degrees);

// P(F <= f) with `between` and `within` degrees, both > 0 and finite.
double f_cdf(double f, double between, double within);

// The z below which lies the share `p`, 0 <= p <= 1; -infinity for 0, infinity for 1. Throws Error{bad_value}
// for p outside.
double normal_quantile(double p);

}  // namespace asperity
