// SPDX-License-Identifier: GPL-3.0-or-later
// Where an after-map may lie on a before-map: band-passed, clipped maps, the after-map turned by one angle
// after the other, and for each the whitened correlation, padded with zeros so that it does not wrap round. A
// few peaks of each angle, the best of which are candidates to be refined: the highest peak alone is not
// always the right one.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/monitor.hpp"
#include "engine/metrology/registration/height_map.hpp"
#include "engine/metrology/registration/refinement.hpp"

namespace asperity::registration {

struct CoarseOptions {
  double greatest_turn = 0;   // rad, to either side; from pi on the whole circle
  double greatest_shift = 0;  // cells; infinite: whatever leaves a tenth of an overlap
  double from_x = 0,
         from_y = 0;  // cells: where the after-map's centre stands, from that of the before-map, unshifted
  double step = 0;    // rad, between angles
  int candidates = 8;
  std::size_t of_an_angle = 3;  // peaks that are kept of each
};

struct Candidate {
  Pose pose;
  double peak = 0;  // of the correlation, in its own root mean square
};

// The best candidates, highest peak first, no two of them closer than a peak is wide. Both maps have square
// cells of one spacing. Costs two transforms an angle, and two padded maps a thread; the same bits for any
// number of threads.
std::vector<Candidate> coarse_candidates(const HeightMap& before, const HeightMap& after,
                                         const CoarseOptions& options, Monitor& monitor);

}  // namespace asperity::registration
