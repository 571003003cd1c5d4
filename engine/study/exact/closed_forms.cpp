// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/exact/closed_forms.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"

namespace asperity::exact {

namespace {

BoxParaboloid complete_boxes(double radius, double load, double approach) {
  BoxParaboloid contact{load, approach, 2 * std::numbers::pi * radius * approach, load * approach / 3};
  in_range({contact.load, contact.approach, contact.area, contact.energy});
  return contact;
}

Hertz complete(double radius, double load, double approach) {
  const double area = pi * radius * approach;
  const Hertz contact{load, approach,          std::sqrt(radius) * std::sqrt(approach),
                      area, 1.5 * load / area, 0.4 * load * approach};
  in_range({contact.load, contact.approach, contact.area, contact.peak_pressure, contact.energy});
  return contact;
}

WavyContact full_contact(double amplitude, double full, double pressure, double share_of_energy) {
  WavyContact contact{full, 1, pressure + full, 0, amplitude, share_of_energy * full * amplitude};
  in_range({contact.full_pressure, contact.peak_pressure, contact.energy_per_area});
  return contact;
}

// `Wide` holds γ^n_max ≤ 2^2048 and the fraction of a turn.
template <unsigned digits>
using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<digits>>;
using Wide = Real<660>;
using Short = Real<40>;

// φ/2π of wave (m, n). Golden phases k·0.6180339887498949, k = m·(n_max+1) + n, are exact.
Short phase_turns(const WeierstrassMandelbrotOptions& o, int m, int n) {
  switch (o.phases) {
    case WavePhases::seeded:
      return seeded_phase_turns(o.seed, o.M, m, n);
    case WavePhases::golden: {
      const Short turns = Short("0.6180339887498949") * (static_cast<long>(m) * (o.n_max + 1) + n);
      return turns - floor(turns);
    }
    case WavePhases::function:
      break;
  }
  refuse("an exact height needs `phases` drawn from the seed, or \"golden\"");
}

Short cosine_of_turns(const Short& turns) { return cos(boost::math::constants::two_pi<Short>() * turns); }

}  // namespace

// Paraboloid of radius R on a Winkler foundation, pressure k(δ − r²/2R): F = πkRδ², A = 2πRδ, U = Fδ/3.
BoxParaboloid box_paraboloid_under_load(double radius, double stiffness, double load) {
  return complete_boxes(radius, load, std::sqrt(load / (std::numbers::pi * stiffness)) / std::sqrt(radius));
}

BoxParaboloid box_paraboloid_at_approach(double radius, double stiffness, double approach) {
  return complete_boxes(radius, std::numbers::pi * stiffness * (radius * approach * approach), approach);
}

// Frictionless paraboloid of radius R on a half-space (Hertz 1882; Johnson, Contact Mechanics, §4.2):
//   a² = R δ,  F = (4/3) E* √R δ^(3/2),  p0 = 3F/(2πa²),  U = (2/5) F δ.
Hertz hertz_under_load(double radius, double modulus, double load) {
  const double root = elementary::cbrt(0.75 * load / modulus);
  return complete(radius, load, root * (root / elementary::cbrt(radius)));
}

Hertz hertz_at_approach(double radius, double modulus, double approach) {
  return complete(radius, 4.0 / 3 * modulus * (std::sqrt(radius) * std::sqrt(approach) * approach), approach);
}

double friction(const Hertz& contact, double tau0, double alpha, double tau_max) {
  const double law = tau0 * contact.area + alpha * contact.load;
  if (tau_max >= tau0 + alpha * contact.peak_pressure) return law;
  if (tau_max <= tau0) return tau_max * contact.area;
  const double edge = (tau_max - tau0) / (alpha * contact.peak_pressure);  // p_c/p0
  const double outside = contact.area * (edge * edge);
  return tau_max * (contact.area - outside) + tau0 * outside + alpha * contact.load * (edge * edge * edge);
}

// Contact area of a rough half-space by Persson's theory (J. Chem. Phys. 115, 3840, 2001), with an absorbing
// edge at the hardness: pressures diffuse from p̄ over a variance (E* h')²/4 between 0 and H. Exact at full
// contact, some 20 % below simulations at light loads.
PerssonArea persson_area(double modulus, double rms_slope, double pressure, double hardness) {
  const double width = modulus * rms_slope;  // 2 standard deviations
  if (pressure >= hardness)
    refuse_infeasible("`pressure` is not below `hardness`: the contact cannot carry it",
                      "lower the pressure");
  // In standard deviations; beyond, H is far.
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

// Wavy half-spaces against a flat, frictionless, without adhesion. One wave z = h cos(2πx/λ) (Westergaard
// 1939; Johnson, Contact Mechanics, §13.2): f = p̄/p_full, p_full = πE*h/λ, contact fraction A from
// sin²(πA/2) = f, mean gap h(1 − f + f ln f). Crossed waves z = h cos(2πx/λ) cos(2πy/λ) (Johnson, Greenwood &
// Higginson 1985) have a closed form at full contact only, p̄ ≥ √2 πE*h/λ. Approach from first touch.
WavyContact one_wave(double amplitude, double wavelength, double modulus, double pressure) {
  const double full = pi * modulus * (amplitude / wavelength);
  in_range({full});
  const double f = pressure / full;
  if (f >= 1) return full_contact(amplitude, full, pressure, 0.25);
  in_range({f});
  const double log_f = elementary::log(f);
  const WavyContact contact{full,
                            2 / pi * elementary::asin(std::sqrt(f)),
                            2 * std::sqrt(full) * std::sqrt(pressure),
                            amplitude * (1 - f + f * log_f),
                            amplitude * f * (1 - log_f),
                            full * amplitude * (f * f) * (0.25 - 0.5 * log_f)};
  in_range({contact.peak_pressure, contact.approach, contact.energy_per_area});
  return contact;
}

WavyContact crossed_waves(double amplitude, double wavelength, double modulus, double pressure) {
  const double full = std::numbers::sqrt2 * pi * modulus * (amplitude / wavelength);
  in_range({full});
  if (pressure < full)
    refuse("crossed waves have a closed form at full contact only, and `pressure` is " +
               format_short(pressure / full) + " of the pressure of full contact",
           "give at least sqrt(2) pi modulus amplitude / wavelength, or take one wave");
  return full_contact(amplitude, full, pressure, 0.125);
}

// Height of a Weierstrass–Mandelbrot surface (surface/generators/weierstrass_mandelbrot.hpp), exact to a
// double: its series with 660 digits, enough for the highest wave number. Shares only the random phases with
// the generator. Slow.
double weierstrass_mandelbrot_height(const WeierstrassMandelbrotOptions& o, int i, int j) {
  const Short log_gamma = log(Short(o.gamma));
  Short sum = 0;
  for (int m = 1; m <= o.M; ++m) {
    const Wide angle = boost::math::constants::pi<Wide>() * m / o.M;
    Wide turns = (cos(angle) * i + sin(angle) * j) * o.span / o.nx;
    for (int n = 0; n <= o.n_max; ++n, turns *= o.gamma) {
      const Short phase = phase_turns(o, m, n), fraction(turns - floor(turns));
      const Short amplitude = exp(log_gamma * (o.D - 3) * n);
      sum += amplitude * (cosine_of_turns(phase) - cosine_of_turns(fraction + phase));
    }
  }
  const Short amplitude = o.L * sqrt(log_gamma / o.M) * pow(Short(o.G) / o.L, Short(o.D) - 2);
  return static_cast<double>(Short(sum * amplitude));
}

}  // namespace asperity::exact
