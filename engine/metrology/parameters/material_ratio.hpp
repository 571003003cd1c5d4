// SPDX-License-Identifier: GPL-3.0-or-later
// The material ratio curve (Abbott–Firestone, bearing curve) of a surface or a profile, ISO 25178-2 and
// ISO 21920-2: c(p) is the height above which the share p of the measured samples lies. Heights are sorted
// downwards and joined by straight lines through (k/(N - 1), h_k), and everything below is exact on that
// curve: nothing is binned, for bins move Sk by a hundredth. Heights count from the mean.
//
// Sk and its kin: of the windows [p, p + 0.4] that begin at a sample the one over which c falls least; the
// least-squares line of c in it, in the direction of heights (not the secant, which gives 2.622 for 2.574 σ
// of Gaussian heights).
//   Sk = its fall over 0 … 1        Smr1, Smr2 = the ratios at which c passes its ends
//   Spk = 2 A1/Smr1, Svk = 2 A2/(1 - Smr2), with A1, A2 the areas between the curve and the line's ends.
// Volumes: Vm(p) = ∫₀ᵖ (c - c(p)), Vv(p) = ∫ₚ¹ (c(p) - c), per area, hence lengths.
#pragma once

#include <span>

#include "engine/core/memory.hpp"

namespace asperity {

// Ratios are shares, 0 … 1; lengths in m.
struct CoreOfCurve {
  double Sk = 0;
  double Spk = 0, Svk = 0;    // reduced peak height and dale depth; 0 where nothing rises above the line
  double Smr1 = 0, Smr2 = 1;  // ratios at the ends of the line
  double Spkx = 0, Svkx = 0;  // from the ends of the line to the highest and lowest sample; may be negative
  double window = 0;          // where the window begins; near a knee Sk, Spk and Smr1 hang on it
};

struct VolumesOfCurve {
  double Vmp = 0;  // Vm(0.1), peak material
  double Vmc = 0;  // Vm(0.8) - Vm(0.1), core material
  double Vvv = 0;  // Vv(0.8), dale void
  double Vvc = 0;  // Vv(0.1) - Vv(0.8), core void
};

// Immutable; takes 8 bytes a measured sample. Thread-safe.
class MaterialRatioCurve {
 public:
  // NaN is a sample that was not measured. Sorts: n log n. Throws Error{bad_value} where none is measured.
  explicit MaterialRatioCurve(std::span<const double> heights);

  std::size_t measured() const { return heights_.size(); }
  double mean() const { return mean_; }  // m, what heights of the curve count from

  // c(p), for p within 0 … 1. Throws Error{bad_value} outside.
  double height(double ratio) const;
  // The greatest p with c(p) >= height: equal heights count as a whole; 0 above all, 1 below all.
  double ratio(double height) const;
  // c(p) - c(q).
  double height_difference(double p, double q) const { return height(p) - height(q); }

  double material_volume(double p) const;  // Vm(p), m³/m²
  double void_volume(double p) const;      // Vv(p), m³/m²

  CoreOfCurve core() const;
  VolumesOfCurve volumes() const;

 private:
  double at(double place) const;                     // c at a place 0 … N - 1 of the order
  double integral(double first, double last) const;  // of c over places
  double last_place() const { return static_cast<double>(heights_.size() - 1); }
  double window() const;

  Array<double> heights_;  // above the mean, downwards
  double mean_ = 0;
};

}  // namespace asperity
