// SPDX-License-Identifier: GPL-3.0-or-later
// A height profile: equally spaced samples along a line, or once around a closed outline with heights r(t) −
// R at equal angles. Immutable.
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
  // Throws Error{bad_value} for a non-positive spacing, no samples, or a non-finite height. `closed_radius`
  // (m) makes an outline.
  Profile(double spacing, Array<double> heights, std::optional<double> closed_radius = {});
  // NaN is a hole. Throws Error{bad_value} for infinite heights or no measured point.
  static Profile with_holes(double spacing, Array<double> heights, std::optional<double> closed_radius = {});

  double spacing() const;  // m between samples
  // m. Throws Error{bad_value} if there are holes.
  std::span<const double> heights() const;
  // m; NaN in holes.
  std::span<const double> measured_heights() const;
  std::size_t measured() const;  // samples
  bool complete() const { return measured() == measured_heights().size(); }
  int size() const { return static_cast<int>(measured_heights().size()); }
  double length() const { return spacing() * size(); }  // m
  // m.
  std::optional<double> closed_radius() const;
  bool closed() const { return closed_radius().has_value(); }
  Range height_range() const;  // measured samples
  const std::string& digest() const;

 private:
  struct Data;
  Profile(double spacing, Array<double> heights, std::optional<double> closed_radius, bool holes);
  std::shared_ptr<const Data> data_;
};

}  // namespace asperity
