// SPDX-License-Identifier: GPL-3.0-or-later
// Wavy half-spaces pressed against a flat. One wave, z = h cos(2πx/λ) (Westergaard 1939; Johnson, Contact
// Mechanics, §13.2), with f = p̄/p_full and p_full = πE*h/λ: contact on a share A of each wave with
// sin²(πA/2) = f, mean gap h(1 − f + f ln f), and what follows from these. Two crossed waves, z = h
// cos(2πx/λ) cos(2πy/λ) (Johnson, Greenwood & Higginson 1985), have a closed form at full contact only, from
// p* = √2 πE*h/λ up. Frictionless, without adhesion; approach from first touch.
#pragma once

namespace asperity::exact {

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

}  // namespace asperity::exact
