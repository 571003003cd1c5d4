// SPDX-License-Identifier: GPL-3.0-or-later
// Contact area of a rough half-space by Persson's theory (J. Chem. Phys. 115, 3840, 2001), with an absorbing
// edge at the hardness: pressures diffuse from p̄ over a variance (E* h')²/4 between 0 and H. Exact at full
// contact, some 20 % below simulations at light loads.
#include "engine/study/exact/closed_forms.hpp"

#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"

namespace asperity::exact {

PerssonArea persson_area(double modulus, double rms_slope, double pressure, double hardness) {
  const double width = modulus * rms_slope;  // 2 standard deviations
  if (pressure >= hardness)
    throw Error(ErrorCode::infeasible, "`pressure` is not below `hardness`: the contact cannot carry it",
                "lower the pressure");
  // In standard deviations; beyond, the edge at H has no effect.
  constexpr double far = 40;
  if (hardness - pressure > far * 0.5 * width)
    return {elementary::erf(std::numbers::sqrt2 * (pressure / width)), 0};
  // Mode k of the density: 2/H sin(kπp̄/H) e^(−λ_k) sin(kπp/H). Its integral over 0 … H contributes area, its
  // first moment load.
  PerssonArea area;
  double carried = 0;  // share of H
  const double decay = 0.125 * (width / hardness) * (width / hardness);
  for (int k = 1;; ++k) {
    const double wave = k * std::numbers::pi;
    const double exponent = wave * wave * decay;
    if (exponent > 745) break;
    const double weight =
        2 / wave * elementary::sin(wave * (pressure / hardness)) * elementary::exp(-exponent);
    if (k % 2 == 1) area.elastic += 2 * weight;
    carried += k % 2 == 1 ? weight : -weight;
  }
  area.capped = pressure / hardness - carried;
  return area;
}

}  // namespace asperity::exact
