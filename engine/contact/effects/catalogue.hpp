// SPDX-License-Identifier: GPL-3.0-or-later
// Every physical effect that a scene can name, and the models of elasticity, with a sentence each
// and whether this build computes it. Whoever reads a scene asks here first, so that an effect which
// cannot be computed is refused by name and never silently left out.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

enum class Availability {
  computed,      // a scene may name it
  not_yet,       // known to the language, not computed by this build: naming it is an error
  not_modelled,  // a process of the experiment that the program leaves out on purpose
};

struct EffectEntry {
  std::string_view name;      // the key in a scene's `effects`
  std::string_view sentence;  // what it does, lower case, no full stop
  Availability availability;
};

// In the order reports list them.
std::span<const EffectEntry> known_effects();
std::span<const EffectEntry> elasticity_models();

// Throws Error{unknown_name} with the nearest name for a name that is not listed, and
// Error{bad_value} that names the effect for one that is listed but not computed.
void require_effect(std::string_view name);
void require_elasticity_model(std::string_view name);

// The effects a scene could name (computed or not yet) that are not in `run`, in catalogue order.
std::vector<std::string> effects_not_in(std::span<const std::string> run);

}  // namespace asperity
