// SPDX-License-Identifier: GPL-3.0-or-later
// What a map itself says of the uncertainty of its parameters (type A): s/√16 of their values on 4 x 4 tiles,
// as s/√5 of the sections of a profile (ISO 21920-3). Tiles say so only where each is like the map and they
// are independent: a side of ten autocorrelation lengths (Sal) and more. For 95 % times Student's t of 15
// degrees, 2.13. It holds nothing of the instrument: noise, calibration, tip.
#pragma once

#include <optional>
#include <string>

#include "engine/surface/surface.hpp"

namespace asperity {

struct ArealUncertainty {
  // Standard uncertainties, m or none; all missing where `why_not` says why. A single one is missing where
  // some tile does not define the parameter.
  std::optional<double> Sa, Sq, Ssk, Sku, Sdq, Sdr;
  std::string why_not;
};

// Of a map as it was prepared for its parameters; `Sal` [m] of that map, none where it is not defined. Nodes
// past the last whole tile are left out. A tile of which less than half was measured makes all missing.
ArealUncertainty areal_uncertainty(const Surface& map, std::optional<double> Sal);

}  // namespace asperity
