// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/sliding.hpp"

#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

double strengthening(const AgeingOptions& ageing, std::optional<double> rest) {
  return rest ? 1 + ageing.rate * elementary::log1p(*rest / ageing.onset) : 1.0;
}

void check(const SlidingEffects& effects) {
  if (effects.interlocking && !std::isfinite(effects.interlocking->direction))
    throw Error(ErrorCode::bad_value,
                "`direction` is " + format_short(effects.interlocking->direction) + " rad",
                "give a finite angle, such as \"0 deg\" for along x");
  if (effects.ageing) {
    const AgeingOptions& ageing = *effects.ageing;
    if (!(ageing.rate >= 0 && std::isfinite(ageing.rate)))
      throw Error(ErrorCode::bad_value, "`rate` is " + format_short(ageing.rate),
                  "give a finite number from zero up; 0.02 is usual");
    if (!(ageing.onset > 0 && std::isfinite(ageing.onset)))
      throw Error(ErrorCode::bad_value, "`onset` is " + format_short(ageing.onset) + " s",
                  "give a time above zero, such as \"1 s\"");
  }
  if (effects.tangential && effects.tangential->compliance_ratio) {
    const double ratio = *effects.tangential->compliance_ratio;
    if (!(ratio > 0 && std::isfinite(ratio)))
      throw Error(ErrorCode::bad_value, "`compliance_ratio` is " + format_short(ratio),
                  "give a finite number above zero; 1 for a Poisson's ratio of zero");
  }
}

}  // namespace asperity
