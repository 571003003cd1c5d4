// SPDX-License-Identifier: GPL-3.0-or-later
// Closed-form reference solutions in SI units. Functions that return a contact throw Error{bad_value} for a
// result outside the range of a double.
#pragma once

#include <cmath>
#include <initializer_list>

#include "engine/core/error.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"

namespace asperity::exact {

// --- paraboloid on a Winkler foundation

struct BoxParaboloid {
  double load = 0;      // N
  double approach = 0;  // m
  double area = 0;      // m²
  double energy = 0;    // J, elastic
};

// `radius` m, `stiffness` Pa/m, all > 0.
BoxParaboloid box_paraboloid_under_load(double radius, double stiffness, double load);
BoxParaboloid box_paraboloid_at_approach(double radius, double stiffness, double approach);

// --- Hertz

struct Hertz {
  double load = 0;            // N
  double approach = 0;        // m
  double contact_radius = 0;  // m
  double area = 0;            // m²
  double peak_pressure = 0;   // Pa, central; p(r) = p0 √(1 − (r/a)²)
  double energy = 0;          // J, elastic
};

// `radius` m, `modulus` E* Pa, all > 0.
Hertz hertz_under_load(double radius, double modulus, double load);
Hertz hertz_at_approach(double radius, double modulus, double approach);

// Friction in N: τ = min(τ0 + αp, τ_max) integrated over the contact. With p_c = (τ_max − τ0)/α and r_c² =
// a²(1 − (p_c/p0)²): T = τ_max π r_c² + τ0 π(a² − r_c²) + αF (p_c/p0)³. τ0 and α ≥ 0, τ_max > 0 (infinite: no
// cap).
double friction(const Hertz& contact, double tau0, double alpha, double tau_max);

// --- Persson

struct PerssonArea {
  double elastic = 0;  // fraction below hardness
  double capped = 0;   // fraction at hardness
};

// `modulus` E*, `pressure` p̄ and `hardness` H in Pa, all > 0. Infinite H: elastic = erf(√2 p̄/(E* h')) with
// `rms_slope` h'; otherwise the sine series to the last bit. Throws Error{infeasible} for p̄ ≥ H.
PerssonArea persson_area(double modulus, double rms_slope, double pressure, double hardness);

// --- wavy half-spaces

struct WavyContact {
  double full_pressure = 0;    // Pa, at full contact
  double area_fraction = 0;    // 0 … 1
  double peak_pressure = 0;    // Pa
  double mean_gap = 0;         // m, over the tile
  double approach = 0;         // m
  double energy_per_area = 0;  // J/m² nominal, elastic
};

// Lengths in m, `modulus` E* and mean `pressure` in Pa, all > 0. crossed_waves throws Error{bad_value} below
// full contact.
WavyContact one_wave(double amplitude, double wavelength, double modulus, double pressure);
WavyContact crossed_waves(double amplitude, double wavelength, double modulus, double pressure);

// --- Weierstrass–Mandelbrot height

// Height of node (i, j) in m; ignores `ny`, `band`, `phase_function` and `material`. O(M n_max) cosines.
// Throws Error{bad_value} for phases given as a function.
double weierstrass_mandelbrot_height(const WeierstrassMandelbrotOptions& options, int i, int j);

// Throws Error{bad_value} for infinite, subnormal and zero values.
inline void in_range(std::initializer_list<double> values) {
  for (const double value : values)
    if (!std::isnormal(value))
      throw Error(ErrorCode::bad_value, "the exact answer leaves the range of a double",
                  "give lengths, moduli and loads nearer to those of a specimen");
}

}  // namespace asperity::exact
