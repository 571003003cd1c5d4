// SPDX-License-Identifier: GPL-3.0-or-later
// Answers in closed form, to hold computed ones against, each in the source of its name. Lengths in m, forces
// in N, pressures and moduli in Pa. All throw Error{bad_value} where a result leaves the range of a double.
#pragma once

#include <cmath>
#include <initializer_list>

#include "engine/core/error.hpp"
#include "engine/surface/generators/weierstrass_mandelbrot.hpp"

namespace asperity::exact {

// --- box_paraboloid.cpp

struct BoxParaboloid {
  double load = 0;      // N
  double approach = 0;  // m
  double area = 0;      // m²
  double energy = 0;    // J, elastic
};

// `radius` m, `stiffness` Pa/m, all > 0. Throws Error{bad_value} where a result leaves the range of a double.
BoxParaboloid box_paraboloid_under_load(double radius, double stiffness, double load);
BoxParaboloid box_paraboloid_at_approach(double radius, double stiffness, double approach);

// --- hertz.cpp

struct Hertz {
  double load = 0;            // N
  double approach = 0;        // m
  double contact_radius = 0;  // m
  double area = 0;            // m²
  double peak_pressure = 0;   // Pa, in the middle; it falls as √(1 − (r/a)²)
  double energy = 0;          // J, elastic
};

// `radius` m, `modulus` E* Pa, all > 0. Throws Error{bad_value} where a result leaves the range of a double.
Hertz hertz_under_load(double radius, double modulus, double load);
Hertz hertz_at_approach(double radius, double modulus, double approach);

// The sum of τ = min(τ0 + αp, τ_max) over the contact, N. With p_c = (τ_max − τ0)/α and
// r_c² = a²(1 − (p_c/p0)²) the inner circle carries τ_max: T = τ_max π r_c² + τ0 π(a² − r_c²) + αF (p_c/p0)³.
// τ0 and α >= 0, τ_max > 0 (infinite: no cap).
double friction(const Hertz& contact, double tau0, double alpha, double tau_max);

// --- persson.cpp

struct PerssonArea {
  double elastic = 0;  // share of the tile in contact below the hardness
  double capped = 0;   // share at the hardness; 0 without one
};

// `modulus` E*, `pressure` p̄ and `hardness` H in Pa, `rms_slope` h'; all > 0, H > p̄, infinite for none:
// then elastic = erf(√2 p̄/(E* h')). Otherwise the sine series of the diffusion, summed to the last bit.
// Throws Error{infeasible} for p̄ >= H.
PerssonArea persson_area(double modulus, double rms_slope, double pressure, double hardness);

// --- wavy.cpp

struct WavyContact {
  double full_pressure = 0;    // Pa, the mean pressure from which everything touches
  double area_fraction = 0;    // 0 … 1
  double peak_pressure = 0;    // Pa
  double mean_gap = 0;         // m, over the whole tile
  double approach = 0;         // m
  double energy_per_area = 0;  // J/m² of the nominal area, elastic
};

// `amplitude` h and `wavelength` λ in m, `modulus` E* and `pressure` p̄ in Pa, all > 0. Both throw
// Error{bad_value} where a result leaves the range of a double, and the second below full contact.
WavyContact one_wave(double amplitude, double wavelength, double modulus, double pressure);
WavyContact crossed_waves(double amplitude, double wavelength, double modulus, double pressure);

// --- weierstrass_mandelbrot_height.cpp

// Height of node (i, j) in m, for seeded or golden phases and the whole band; what the options hold of
// `ny`, `band`, `phase_function` and `material` does not enter. O(M n_max) cosines. Throws Error{bad_value}
// for phases given as a function.
double weierstrass_mandelbrot_height(const WeierstrassMandelbrotOptions& options, int i, int j);

// --- of all of them

// Throws Error{bad_value} for a value that is not finite, or that has gone under the least normal double
// though it is not zero by its formula.
inline void in_range(std::initializer_list<double> values) {
  for (const double value : values)
    if (!std::isnormal(value))
      throw Error(ErrorCode::bad_value, "the exact answer leaves the range of a double",
                  "give lengths, moduli and loads nearer to those of a specimen");
}

}  // namespace asperity::exact
