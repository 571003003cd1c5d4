// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/effects/catalogue.hpp"

#include <algorithm>
#include <array>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr std::array effects = {
    EffectEntry{"elasticity", "how the bodies give way under pressure and recover", Availability::computed},
    EffectEntry{"plasticity", "pressure is capped by hardness, and what yields stays flattened",
                Availability::computed},
    EffectEntry{"creep", "hardness falls with the time the load dwells", Availability::computed},
    EffectEntry{"capillarity", "liquid in narrow gaps pulls the bodies together", Availability::computed},
    EffectEntry{"adhesion", "the surfaces attract each other across the gap", Availability::computed},
    EffectEntry{"ageing", "contacts strengthen with the time they rest", Availability::computed},
    EffectEntry{"interlocking", "slopes of two rough bodies resist sliding", Availability::computed},
    EffectEntry{"tangential", "shear tractions and partial slip inside the contact", Availability::computed},
    EffectEntry{"oxide", "a brittle film between the metals", Availability::not_modelled},
    EffectEntry{"breakage", "asperities that break off", Availability::not_modelled},
};

constexpr std::array models = {
    EffectEntry{"box", "independent elements over the nodes, pressure in proportion to their shortening",
                Availability::computed},
    EffectEntry{"half_space", "every pressure moves every node, as on an elastic half-space",
                Availability::computed},
    EffectEntry{"layer", "an elastic layer on a rigid base, every pressure moves every node",
                Availability::computed},
    EffectEntry{"rigid", "no elastic deformation; the bodies rest on what has yielded",
                Availability::computed},
};

std::vector<std::string> names(std::span<const EffectEntry> entries, bool computed_only) {
  std::vector<std::string> result;
  for (const EffectEntry& entry : entries)
    if (!computed_only || entry.availability == Availability::computed) result.emplace_back(entry.name);
  return result;
}

void require(std::string_view name, std::span<const EffectEntry> entries, const std::string& kind) {
  const auto entry =
      std::find_if(entries.begin(), entries.end(), [&](const EffectEntry& e) { return e.name == name; });
  const std::vector<std::string> ready = names(entries, true);
  if (entry == entries.end()) {
    const std::vector<std::string> all = names(entries, false);
    throw Error(ErrorCode::unknown_name, "there is no " + kind + " " + quoted(name) + did_you_mean(name, all),
                "known are " + joined(ready, " and "));
  }
  if (entry->availability == Availability::computed) return;
  const std::string why = entry->availability == Availability::not_yet ? " is not computed by this version"
                                                                       : " is not modelled by this program";
  throw Error(ErrorCode::bad_value,
              "the " + kind + " " + quoted(name) + " (" + std::string(entry->sentence) + ")" + why,
              "computed here: " + joined(ready, " and "));
}

}  // namespace

std::span<const EffectEntry> known_effects() { return effects; }
std::span<const EffectEntry> elasticity_models() { return models; }

void require_effect(std::string_view name) { require(name, effects, "effect"); }
void require_elasticity_model(std::string_view name) { require(name, models, "model of elasticity"); }

std::vector<std::string> effects_not_in(std::span<const std::string> run) {
  std::vector<std::string> off;
  for (const EffectEntry& entry : effects)
    if (entry.availability != Availability::not_modelled &&
        std::find(run.begin(), run.end(), entry.name) == run.end())
      off.emplace_back(entry.name);
  return off;
}

}  // namespace asperity
