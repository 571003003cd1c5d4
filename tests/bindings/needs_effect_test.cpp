// SPDX-License-Identifier: GPL-3.0-or-later
// tests/scripts/needs_effect.lua must request every name that needs an effect, without the effect.
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "bindings/lua/registry/registry.hpp"
#include "engine/contact/scene/known_effects.hpp"
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::needs_effect_test {
namespace {

using NeedsEffect = LuaTest;

// Names whose documentation states a needed effect.
std::set<std::string> names_in_need() {
  std::set<std::string> names;
  const auto look = [&](const std::string& name, const std::string& sentence) {
    for (const Effect* effect : known_effects())
      if (sentence.find("needs " + std::string(effect->name)) != std::string::npos) names.insert(name);
  };
  const auto look_at = [&](const std::vector<Function>& functions) {
    for (const Function& function : functions) {
      look(function.name, function.sentence);
      if (function.options == nullptr) continue;
      for (const OptionInfo* option : function.options->options()) {
        look(option->name, option->sentence);
        if (option->inner == nullptr) continue;
        for (const OptionInfo* inner : option->inner->options()) look(inner->name, inner->sentence);
      }
    }
  };
  for (const Module* module : modules()) look_at(module->functions);
  for (const Class* type : classes()) {
    look_at(type->methods);
    for (const Getter& field : type->fields) look(field.name, field.sentence);
  }
  return names;
}

TEST_F(NeedsEffect, TheScriptAsksForAllOfThem) {
  std::ifstream file(std::string(ASPERITY_TEST_DATA) + "/../scripts/needs_effect.lua");
  const std::string script{std::istreambuf_iterator<char>(file), {}};
  ASSERT_FALSE(script.empty());
  const std::set<std::string> names = names_in_need();
  EXPECT_GE(names.size(), 6U);
  for (const std::string& name : names)
    EXPECT_NE(script.find(name), std::string::npos) << name << " is not asked for in needs_effect.lua";
}

}  // namespace
}  // namespace asperity::lua::needs_effect_test
