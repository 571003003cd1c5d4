// SPDX-License-Identifier: GPL-3.0-or-later
// Areal parameters of ISO 25178-2, in groups computed on first use and cached. Optional preparation: F
// subtracts a polynomial, S is a Gaussian low-pass, L subtracts one. Heights are about the mean.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/metrology/parameters/areal_slopes.hpp"
#include "engine/metrology/parameters/areal_uncertainty.hpp"
#include "engine/metrology/parameters/autocorrelation.hpp"
#include "engine/metrology/parameters/hills.hpp"
#include "engine/metrology/parameters/material_ratio.hpp"
#include "engine/metrology/parameters/texture_direction.hpp"
#include "engine/metrology/roughness.hpp"

namespace asperity {

struct ArealPreparation {
  std::optional<int> F;        // polynomial degree
  std::optional<double> S, L;  // nesting indices, m
  double pruning = 0.05;       // share of Sz that a hill must rise above its saddle
};

// Copies share the cache. Thread-safe; same bits for any thread count.
class ArealParameters {
 public:
  // Throws like `levelled` and `gaussian_filtered`.
  ArealParameters(const Surface& surface, const ArealPreparation& preparation = {});

  const Surface& prepared() const;
  const ArealPreparation& preparation() const;
  // Heights differ by rounding at most: moments, ratios, hills and texture are undefined.
  bool flat() const;
  // True if some node is not at the rim; hills need one.
  bool has_inside() const;
  // For example "F-operation of degree 1, S-filter 2.5 um, L-filter 0.8 mm, mean removed".
  std::string how() const;

  const Roughness& heights() const;
  const ArealSlopes& slopes() const;
  const MaterialRatioCurve& curve() const;
  const CoreOfCurve& core() const;
  const VolumesOfCurve& volumes() const;
  const Hills& hills() const;
  // Empty for a flat map or one node of width.
  const std::optional<TextureAspect>& texture() const;
  // Empty for a flat map, below six cells of width, or without waves in the band.
  const std::optional<TextureDirection>& direction() const;
  const ArealUncertainty& uncertainty() const;

  // Why a parameter is undefined; empty if it is defined. Computes the group.
  std::string why_not(const std::string& parameter) const;
  int groups_computed() const;
  std::string digest() const;

 private:
  struct Groups;
  std::shared_ptr<Groups> groups_;
};

}  // namespace asperity
