// SPDX-License-Identifier: GPL-3.0-or-later
// The effects a scene can name, and how the others are refused.
#include "engine/contact/effects/catalogue.hpp"

#include <algorithm>
#include <array>

#include "tests/contact/contacts.hpp"

namespace asperity::catalogue_test {
namespace {

using test::error_of;

TEST(Catalogue, EveryEntryHasANameOfItsOwnAndASentence) {
  for (const auto entries : {known_effects(), elasticity_models()})
    for (const EffectEntry& entry : entries) {
      EXPECT_FALSE(entry.sentence.empty());
      EXPECT_EQ(std::count_if(entries.begin(), entries.end(),
                              [&](const EffectEntry& e) { return e.name == entry.name; }),
                1);
    }
}

TEST(Catalogue, ComputedEffectsAreAccepted) {
  EXPECT_NO_THROW(require_effect("elasticity"));
  EXPECT_NO_THROW(require_elasticity_model("box"));
}

TEST(Catalogue, AnUnknownEffectIsRefusedWithTheNearestName) {
  const std::string text = error_of([] { require_effect("plastcity"); });
  EXPECT_NE(text.find("there is no effect `plastcity` (did you mean `plasticity`?); known are elasticity, "),
            std::string::npos)
      << text;
  EXPECT_NE(error_of([] { require_elasticity_model("halfspace"); }).find("did you mean `half_space`?"),
            std::string::npos);
}

TEST(Catalogue, EffectsThatAreNotComputedAreRefusedByName) {
  for (const EffectEntry& entry : known_effects()) {
    const std::string text = error_of([&] { require_effect(entry.name); });
    EXPECT_EQ(text.empty(), entry.availability == Availability::computed) << entry.name;
    if (!text.empty()) {
      EXPECT_NE(text.find("the effect `" + std::string(entry.name) + "` ("), std::string::npos) << text;
    }
  }
  EXPECT_NE(error_of([] { require_effect("breakage"); }).find("is not modelled by this program"),
            std::string::npos);
}

TEST(Catalogue, EffectsThatDoNotRunAreListedAsOff) {
  const std::array<std::string, 1> run = {"elasticity"};
  const std::vector<std::string> off = effects_not_in(run);
  EXPECT_EQ(std::count(off.begin(), off.end(), "elasticity"), 0);
  EXPECT_EQ(std::count(off.begin(), off.end(), "plasticity"), 1);
  EXPECT_EQ(std::count(off.begin(), off.end(), "breakage"), 0);
}

}  // namespace
}  // namespace asperity::catalogue_test
