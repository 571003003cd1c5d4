// SPDX-License-Identifier: GPL-3.0-or-later
// Wavy half-spaces against a flat, frictionless, without adhesion. One wave z = h cos(2πx/λ) (Westergaard
// 1939; Johnson, Contact Mechanics, §13.2): f = p̄/p_full, p_full = πE*h/λ, contact fraction A from
// sin²(πA/2) = f, mean gap h(1 − f + f ln f). Crossed waves z = h cos(2πx/λ) cos(2πy/λ) (Johnson, Greenwood &
// Higginson 1985) have a closed form at full contact only, p̄ ≥ √2 πE*h/λ. Approach from first touch.
#include "engine/study/exact/closed_forms.hpp"

#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/text.hpp"

namespace asperity::exact {

namespace {

WavyContact full_contact(double amplitude, double full, double pressure, double share_of_energy) {
  WavyContact contact{full, 1, pressure + full, 0, amplitude, share_of_energy * full * amplitude};
  in_range({contact.full_pressure, contact.peak_pressure, contact.energy_per_area});
  return contact;
}

}  // namespace

WavyContact one_wave(double amplitude, double wavelength, double modulus, double pressure) {
  const double full = pi * modulus * (amplitude / wavelength);
  in_range({full});
  const double f = pressure / full;
  if (f >= 1) return full_contact(amplitude, full, pressure, 0.25);
  in_range({f});
  const double log_f = elementary::log(f);
  WavyContact contact;
  contact.full_pressure = full;
  contact.area_fraction = 2 / pi * elementary::asin(std::sqrt(f));
  contact.peak_pressure = 2 * std::sqrt(full) * std::sqrt(pressure);
  contact.mean_gap = amplitude * (1 - f + f * log_f);
  contact.approach = amplitude * f * (1 - log_f);
  contact.energy_per_area = full * amplitude * (f * f) * (0.25 - 0.5 * log_f);
  in_range({contact.peak_pressure, contact.approach, contact.energy_per_area});
  return contact;
}

WavyContact crossed_waves(double amplitude, double wavelength, double modulus, double pressure) {
  const double full = std::numbers::sqrt2 * pi * modulus * (amplitude / wavelength);
  in_range({full});
  if (pressure < full)
    throw Error(ErrorCode::bad_value,
                "crossed waves have a closed form at full contact only, and `pressure` is " +
                    format_short(pressure / full) + " of the pressure of full contact",
                "give at least sqrt(2) pi modulus amplitude / wavelength, or take one wave");
  return full_contact(amplitude, full, pressure, 0.125);
}

}  // namespace asperity::exact
