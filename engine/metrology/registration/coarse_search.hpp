// SPDX-License-Identifier: GPL-3.0-or-later
// Coarse search: band-passed, clipped maps; the after-map, turned angle by angle, is correlated with
// whitening and zero padding. Several peaks become candidates: the highest may be wrong.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/monitor.hpp"
#include "engine/metrology/registration/height_map.hpp"
#include "engine/metrology/registration/refinement.hpp"

namespace asperity::registration {

struct CoarseOptions {
  double greatest_turn = 0;   // rad to either side; from pi on the whole circle
  double greatest_shift = 0;  // cells; infinite: down to a tenth of overlap
  double from_x = 0,
         from_y = 0;  // cells: offset of the map centres at zero shift
  double step = 0;    // rad, between angles
  int candidates = 8;
  std::size_t of_an_angle = 3;  // peaks per angle
};

struct Candidate {
  Pose pose;
  double peak = 0;  // in root mean squares of the correlation
};

// By falling peak. Square cells of one spacing. Cost: two transforms per angle, two padded maps per thread.
std::vector<Candidate> coarse_candidates(const HeightMap& before, const HeightMap& after,
                                         const CoarseOptions& options, Monitor& monitor);

}  // namespace asperity::registration
