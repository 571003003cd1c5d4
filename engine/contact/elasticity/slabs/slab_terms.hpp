// SPDX-License-Identifier: GPL-3.0-or-later
// What materials and effects make of a contact in slabs under a flat: its modulus and the cap on its
// pressure, asked of the same code as for a contact in one process.
#pragma once

#include <optional>

#include "engine/contact/scene.hpp"

namespace asperity {

struct SlabTerms {
  double modulus = 0;  // E*, Pa
  double cap = 0;      // Pa; infinite where nothing yields
};

// Throws Error{bad_state} naming effect, body and property where a material lacks one; {bad_value} for
// hardening, which is not computed in slabs.
SlabTerms slab_terms(const std::optional<Material>& lower, const Material& upper, const Effects& effects);

}  // namespace asperity
