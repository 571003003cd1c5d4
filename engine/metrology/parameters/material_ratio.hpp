// SPDX-License-Identifier: GPL-3.0-or-later
// Material ratio curve (Abbott–Firestone), ISO 25178-2 and ISO 21920-2: the share p of measured samples is
// above c(p). Falling heights about the mean are joined through (k/(N - 1), h_k); results are exact on this
// curve (bins change Sk by 1 %).
//
// Sk: least-squares line of c over the flattest window [p, p + 0.4] that starts at a sample (a secant gives
// 2.622 σ for 2.574 σ).
//   Sk = its fall over 0 … 1; Smr1, Smr2 = ratios of c at its ends
//   Spk = 2 A1/Smr1, Svk = 2 A2/(1 - Smr2); A1, A2: areas between curve and line ends
// Volumes per area: Vm(p) = ∫₀ᵖ (c - c(p)), Vv(p) = ∫ₚ¹ (c(p) - c).
#pragma once

#include <span>

#include "engine/core/memory.hpp"

namespace asperity {

// Ratios 0 … 1; lengths in m.
struct CoreOfCurve {
  double Sk = 0;
  double Spk = 0, Svk = 0;    // reduced peak height and dale depth
  double Smr1 = 0, Smr2 = 1;  // ratios at the ends of the line
  double Spkx = 0, Svkx = 0;  // line ends to extreme samples; may be negative
  double window = 0;          // start; near a knee Sk, Spk and Smr1 depend on it
};

struct VolumesOfCurve {
  double Vmp = 0;  // Vm(0.1), peak material
  double Vmc = 0;  // Vm(0.8) - Vm(0.1), core material
  double Vvv = 0;  // Vv(0.8), dale void
  double Vvc = 0;  // Vv(0.1) - Vv(0.8), core void
};

// Immutable; 8 bytes per measured sample. Thread-safe.
class MaterialRatioCurve {
 public:
  // NaN: not measured. Cost n log n. Throws Error{bad_value} without measured samples.
  explicit MaterialRatioCurve(std::span<const double> heights);

  std::size_t measured() const { return heights_.size(); }
  double mean() const { return mean_; }  // m

  // c(p), 0 <= p <= 1. Throws Error{bad_value} outside.
  double height(double ratio) const;
  // Greatest p with c(p) >= height; 0 above all, 1 below all.
  double ratio(double height) const;
  double height_difference(double p, double q) const { return height(p) - height(q); }

  double material_volume(double p) const;  // Vm(p), m³/m²
  double void_volume(double p) const;      // Vv(p), m³/m²

  CoreOfCurve core() const;
  VolumesOfCurve volumes() const;

 private:
  double at(double place) const;                     // c at place 0 … N - 1
  double integral(double first, double last) const;  // of c over places
  double last_place() const { return static_cast<double>(heights_.size() - 1); }
  double window() const;

  Array<double> heights_;  // above the mean, falling
  double mean_ = 0;
};

}  // namespace asperity
