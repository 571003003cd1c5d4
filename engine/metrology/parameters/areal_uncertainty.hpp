// SPDX-License-Identifier: GPL-3.0-or-later
// Type A uncertainty of areal parameters: s/√16 over 4 x 4 tiles, as ISO 21920-3 uses s/√5 over sections.
// Independence needs tiles of ten autocorrelation lengths (Sal). For 95 %, multiply by 2.13 (Student, 15
// degrees). The instrument (noise, calibration, tip) is not included.
#pragma once

#include <optional>
#include <string>

#include "engine/surface/surface.hpp"

namespace asperity {

struct ArealUncertainty {
  // m or 1. All empty if `why_not` is set; one empty if a tile does not define it.
  std::optional<double> Sa, Sq, Ssk, Sku, Sdq, Sdr;
  std::string why_not;
};

// Prepared map, `Sal` in m. Incomplete tiles are ignored. If a tile is less than half measured, all are
// empty.
ArealUncertainty areal_uncertainty(const Surface& map, std::optional<double> Sal);

}  // namespace asperity
