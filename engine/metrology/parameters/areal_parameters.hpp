// SPDX-License-Identifier: GPL-3.0-or-later
// The areal parameters of ISO 25178-2 of one map, each group computed when it is first asked for and kept.
// The map is prepared first by what was asked for and by nothing else: F, a least-squares polynomial taken
// away; S, the Gaussian low-pass of the small nesting index; L, less the Gaussian low-pass of the large one.
// Heights count from the mean.
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
  std::optional<int> F;        // degree of the polynomial
  std::optional<double> S, L;  // nesting indices, m
  double pruning = 0.05;       // of Sz, what a hill must rise above its saddle
};

// Copies share what was computed. Thread-safe; the same bits for any number of threads.
class ArealParameters {
 public:
  // Prepares the map. Throws as `levelled` and `gaussian_filtered` do.
  ArealParameters(const Surface& surface, const ArealPreparation& preparation = {});

  const Surface& prepared() const;
  const ArealPreparation& preparation() const;
  // Whether all heights of the prepared map are equal, or differ by the rounding of its preparation alone, as
  // those of a plane once its plane is taken away: moments, ratios, hills and texture are then not defined.
  bool flat() const;
  // Whether the map has nodes that are not at its rim; without them it has no hills.
  bool has_inside() const;
  // "mean removed", or what else was: "F-operation of degree 1, S-filter 2.5 um, L-filter 0.8 mm; mean
  // removed".
  std::string how() const;

  const Roughness& heights() const;
  const ArealSlopes& slopes() const;
  const MaterialRatioCurve& curve() const;
  const CoreOfCurve& core() const;
  const VolumesOfCurve& volumes() const;
  const Hills& hills() const;
  // None where heights are equal or the map is one node wide.
  const std::optional<TextureAspect>& texture() const;
  // None where heights are equal, where the map is under six cells wide, and where no wave lies in the band.
  const std::optional<TextureDirection>& direction() const;
  const ArealUncertainty& uncertainty() const;

  // Why a parameter is not defined on this map, by its name; empty where it is. Computes its group.
  std::string why_not(const std::string& parameter) const;
  // How many groups were computed so far.
  int groups_computed() const;
  // Of the prepared map and what it was prepared by.
  std::string digest() const;

 private:
  struct Groups;
  std::shared_ptr<Groups> groups_;
};

}  // namespace asperity
