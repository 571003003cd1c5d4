// SPDX-License-Identifier: GPL-3.0-or-later
// The effects of a scene by name.
#include "engine/contact/scene/known_effects.hpp"

#include <algorithm>
#include <array>

#include "engine/contact/scene/elastic_model.hpp"
#include "tests/contact/contacts.hpp"

namespace asperity::catalogue_test {
namespace {

using test::error_of;

TEST(Catalogue, EveryEffectHasANameOfItsOwnAndASentence) {
  std::vector<std::string_view> names;
  for (const Effect* effect : known_effects()) {
    EXPECT_FALSE(effect->sentence.empty());
    EXPECT_NE(effect->plan, nullptr);
    names.push_back(effect->name);
    for (const OptionRow& row : effect->options) {
      EXPECT_FALSE(row.sentence.empty()) << row.name;
      EXPECT_NO_THROW((void)row.get(effect->defaults)) << row.name;
    }
  }
  for (const ElasticModel* model : elastic_models()) {
    EXPECT_FALSE(model->sentence.empty());
    EXPECT_FALSE(model->noun.empty());
    EXPECT_NE(model->make, nullptr);
    names.push_back(model->name);
  }
  for (const std::string_view name : names) EXPECT_EQ(std::ranges::count(names, name), 1) << name;
}

TEST(Catalogue, ComputedEffectsAreAccepted) {
  EXPECT_NO_THROW(require_effect("elasticity"));
  EXPECT_NO_THROW(require_elastic_model("box"));
}

TEST(Catalogue, AnUnknownEffectIsRefusedWithTheNearestName) {
  const std::string text = error_of([] { require_effect("plastcity"); });
  EXPECT_NE(text.find("there is no effect `plastcity` (did you mean `plasticity`?); known are elasticity, "),
            std::string::npos)
      << text;
  EXPECT_NE(error_of([] { require_elastic_model("halfspace"); }).find("did you mean `half_space`?"),
            std::string::npos);
}

TEST(Catalogue, EffectsThatAreNotComputedAreRefusedByName) {
  for (const Effect* effect : known_effects()) EXPECT_EQ(require_effect(effect->name), effect);
  const std::string text = error_of([] { require_effect("oxide"); });
  EXPECT_NE(text.find("the effect `oxide` (a brittle film between the metals)"), std::string::npos) << text;
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
