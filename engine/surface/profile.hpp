// SPDX-License-Identifier: GPL-3.0-or-later
// A height profile: samples at equal spacing along a line, as a stylus gives them, or once around a
// closed outline (the grain of the paper's Fig. 1), whose heights are r(t) − R at equal angles.
// An immutable value, cheap to copy. A measured profile may have holes, as a surface may: heights() refuses
// one that has, measured_heights() has NaN there.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "engine/core/grid.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

class Profile {
 public:
  // Throws Error{bad_value} for a spacing that is not positive, no samples, or the first height that
  // is not finite. `closed_radius` (m) makes it an outline.
  Profile(double spacing, Array<double> heights, std::optional<double> closed_radius = {});
  // The same of a profile of which points may be missing: NaN is a point that was not measured. Throws
  // Error{bad_value} for infinite heights and where nothing was measured.
  static Profile with_holes(double spacing, Array<double> heights, std::optional<double> closed_radius = {});

  double spacing() const;  // m between samples
  // m. Throws Error{bad_value} for a profile with holes: how many, the first, and the cure.
  std::span<const double> heights() const;
  // m; NaN at the samples that were not measured, and only there.
  std::span<const double> measured_heights() const;
  std::size_t measured() const;  // samples
  bool complete() const { return measured() == measured_heights().size(); }
  int size() const { return static_cast<int>(measured_heights().size()); }
  double length() const { return spacing() * size(); }  // m
  // Radius of a closed outline, m.
  std::optional<double> closed_radius() const;
  bool closed() const { return closed_radius().has_value(); }
  Range height_range() const;  // of the measured samples
  const std::string& digest() const;

 private:
  struct Data;
  Profile(double spacing, Array<double> heights, std::optional<double> closed_radius, bool holes);
  std::shared_ptr<const Data> data_;
};

}  // namespace asperity
