// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/scene/known_effects.hpp"

#include <algorithm>
#include <array>

#include "engine/core/require.hpp"

// NAME_effect() is defined in NAME.cpp.
// clang-format off
#define ASPERITY_EFFECTS(effect) \
  effect(plasticity)   \
  effect(creep)        \
  effect(capillarity)  \
  effect(adhesion)     \
  effect(ageing)       \
  effect(interlocking) \
  effect(tangential)   \
  /* end of the list */
// clang-format on

namespace asperity {

#define ASPERITY_DECLARED(name) const Effect& name##_effect();
ASPERITY_EFFECTS(ASPERITY_DECLARED)
#undef ASPERITY_DECLARED

namespace {

// Left out on purpose.
constexpr std::array not_modelled = {
    std::pair<std::string_view, std::string_view>{"oxide", "a brittle film between the metals"},
    std::pair<std::string_view, std::string_view>{"breakage", "asperities that break off"},
};

std::vector<std::string> computed_names() {
  std::vector<std::string> names{std::string(elasticity_effect)};
  for (const Effect* effect : known_effects()) names.emplace_back(effect->name);
  return names;
}

}  // namespace

std::span<const Effect* const> known_effects() {
#define ASPERITY_LISTED(name) &name##_effect(),
  static const std::vector<const Effect*> effects{ASPERITY_EFFECTS(ASPERITY_LISTED)};
#undef ASPERITY_LISTED
  return effects;
}

const Effect* require_effect(std::string_view name) {
  const auto all = known_effects();
  if (const auto known = std::ranges::find(all, name, &Effect::name); known != all.end()) return *known;
  if (name == elasticity_effect) return nullptr;
  const std::vector<std::string> ready = computed_names();
  for (const auto& [left_out, sentence] : not_modelled)
    if (name == left_out)
      refuse(
          "the effect " + quoted(name) + " (" + std::string(sentence) + ") is not modelled by this program",
          "computed here: " + joined(ready, " and "));
  std::vector<std::string> names = ready;
  for (const auto& [left_out, sentence] : not_modelled) names.emplace_back(left_out);
  refuse_name("there is no effect " + quoted(name) + did_you_mean(name, names),
              "known are " + joined(ready, " and "));
}

std::vector<std::string> effect_names(Effect::Acts acts) {
  std::vector<std::string> names;
  for (const Effect* effect : known_effects())
    if (effect->acts == acts) names.emplace_back(effect->name);
  return names;
}

std::vector<std::string> effects_not_in(std::span<const std::string> run) {
  std::vector<std::string> off = computed_names();
  std::erase_if(off, [&](const std::string& name) { return std::ranges::find(run, name) != run.end(); });
  return off;
}

}  // namespace asperity
