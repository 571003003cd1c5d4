// SPDX-License-Identifier: GPL-3.0-or-later
// Areal parameters of ISO 25178-2. Optional preparation: F subtracts a polynomial, S is a Gaussian low-pass,
// L subtracts one. Heights are about the mean.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "engine/metrology/parameters/autocorrelation.hpp"
#include "engine/metrology/parameters/hills.hpp"
#include "engine/metrology/parameters/material_ratio.hpp"
#include "engine/metrology/roughness.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// Root mean square slope Sdq and developed area Sdr (ISO 25178-2). The standard leaves the differences open:
//   edges  Sdq² = mean (dz/hx)² over edges along x + mean (dz/hy)² along y
//   seven  (-1, 9, -45, 0, 45, -9, 1)/(60 h) along both axes
//   Sdr    mean area of a cell's two triangulations over its projection, minus 1; a plane: √(1 + p² + q²) - 1
// Only fully measured edges, crosses and cells count. Noise adds slopes of noise/h; apply an S-filter.
struct ArealSlopes {
  std::optional<double> Sdq;        // over edges; empty without edges
  std::optional<double> Sdq_seven;  // empty without crosses
  std::optional<double> Sdr;        // share >= 0; empty without cells
  std::size_t cells = 0;            // with four measured corners
};

// One pass. One node wide: no Sdr.
ArealSlopes areal_slopes(const Surface& surface);

// Type A uncertainty of areal parameters: s/√16 over 4 x 4 tiles, as ISO 21920-3 uses s/√5 over sections.
// Independence needs tiles of ten autocorrelation lengths (Sal). For 95 %, multiply by 2.13 (Student, 15
// degrees). The instrument (noise, calibration, tip) is not included.
struct ArealUncertainty {
  // All empty if `why_not` is set; one empty if a tile does not define it.
  std::optional<double> Sa, Sq, Ssk, Sku, Sdq, Sdr;
  std::string why_not;
};

// Prepared map, `Sal` in m. If a tile is less than half measured, all are empty.
ArealUncertainty areal_uncertainty(const Surface& map, std::optional<double> Sal);

// Texture direction Std of ISO 25178-2: the angle of maximum wave power, in half degrees. Mean in holes; Hann
// window; waves of over 1.5 cycles per map, below the smaller Nyquist frequency. Std is the wave vector,
// normal to the lay. Resolution about 57°/(cycles in the map); meaningless for Str near 1.
struct TextureDirection {
  double wave = 0;   // rad from x towards y, 0 … π
  double lay = 0;    // rad, 0 … π: wave ± π/2
  double share = 0;  // power in the bin of `wave`; 1/360 if isotropic
};

// One transform, two grid copies. Throws Error{bad_value} for equal heights, under six longer cells along a
// side, or no wave in the band.
TextureDirection texture_direction(const Surface& surface);

struct ArealPreparation {
  std::optional<int> F;        // polynomial degree
  std::optional<double> S, L;  // nesting indices, m
  double pruning = 0.05;       // share of Sz that a hill must rise above its saddle
};

// Groups are computed on first use. Copies share the cache. Thread-safe.
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

  // Empty if the parameter is defined. Computes the group.
  std::string why_not(const std::string& parameter) const;
  std::string digest() const;

 private:
  struct Groups;
  std::shared_ptr<Groups> groups_;
};

}  // namespace asperity
