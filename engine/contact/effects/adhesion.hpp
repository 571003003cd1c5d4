// SPDX-License-Identifier: GPL-3.0-or-later
// Adhesion: an energy of the gap, traction w/ρ e^(−g/ρ) or Dugdale's w/ρ up to a gap of ρ (GapTerm::edge).
#pragma once

#include <string>

#include "engine/contact/gap_term.hpp"
#include "engine/contact/scene/effect.hpp"

namespace asperity {

struct AdhesionOptions {
  double work = 0;   // w, J/m²
  double range = 0;  // ρ, m
  GapLaw model = GapLaw::exponential;
  static const Effect& effect();
};

// Throws Error{bad_value} for scenes without support of attraction.
void check_attraction(const Scene& scene, const std::string& effect);

// Adds term and costs to a half-space. Warns if the zone of attraction, about (π/4) E* w/σ0² (Maugis 1992),
// is under four cells wide.
void plan_gap_term(GapTerm term, std::string sentence, const ContactGeometry& geometry, Plan& plan);

}  // namespace asperity
