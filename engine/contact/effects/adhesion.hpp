// SPDX-License-Identifier: GPL-3.0-or-later
// Adhesion: the surfaces attract each other across the gap, in contact and beside it, with w/ρ e^(−g/ρ) or
// Dugdale's constant w/ρ up to a gap of ρ. Its one term is an energy of the gap. Dugdale's traction ends over
// half a range to either side of ρ, its work unchanged, so that no node catches its edge.
#pragma once

#include <string>

#include "engine/contact/effect.hpp"
#include "engine/contact/gap_term.hpp"

namespace asperity {

struct AdhesionOptions {
  double work = 0;   // w, J/m²
  double range = 0;  // ρ, m
  GapLaw model = GapLaw::exponential;
  static const Effect& effect();
};

// Throws Error{bad_value} for what is not computed beside an attraction across the gap.
void check_attraction(const Scene& scene, const std::string& effect);

// Adds a term to the plan of a half-space, with what it costs, and warns where the zone in which it pulls
// beside a contact, about (π/4) E* w/σ0² (Maugis 1992), is under four cells wide.
void plan_gap_term(GapTerm term, std::string sentence, const ContactGeometry& geometry, Plan& plan);

}  // namespace asperity
