// SPDX-License-Identifier: GPL-3.0-or-later
// Adhesion: the surfaces attract each other across the gap with the traction of AdhesionOptions, in contact
// and beside it. Its one term is an energy of the gap. Dugdale's traction ends over half a range to either
// side of ρ, its work unchanged, so that no node catches its edge.
#pragma once

#include "engine/contact/plan.hpp"

namespace asperity {

void plan_adhesion(const AdhesionOptions& options, const ContactGeometry& geometry, Plan& plan);

// Adds a term to the plan of a half-space, with what it costs, and warns where the zone in which it pulls
// beside a contact, about (π/4) E* w/σ0² (Maugis 1992), is under four cells wide.
void plan_gap_term(GapTerm term, std::string sentence, const ContactGeometry& geometry, Plan& plan);

}  // namespace asperity
