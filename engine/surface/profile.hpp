// SPDX-License-Identifier: GPL-3.0-or-later
// A height profile: samples at equal spacing along a line, as a stylus gives them, or once around a
// closed outline (the grain of the paper's Fig. 1), whose heights are r(t) − R at equal angles.
// An immutable value, cheap to copy.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/grid.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

class Profile {
 public:
  // Throws Error{bad_value} for a spacing that is not positive, no samples, or the first height that
  // is not finite. `closed_radius` (m) makes it an outline.
  Profile(double spacing, Array<double> heights, std::optional<double> closed_radius = {});

  double spacing() const;                   // m between samples
  std::span<const double> heights() const;  // m
  int size() const { return static_cast<int>(heights().size()); }
  double length() const { return spacing() * size(); }  // m
  // Radius of a closed outline, m.
  std::optional<double> closed_radius() const;
  bool closed() const { return closed_radius().has_value(); }
  Range height_range() const;
  const std::string& digest() const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace asperity
