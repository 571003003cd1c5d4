// SPDX-License-Identifier: GPL-3.0-or-later
// Help, the reference page and the editor's types are complete.
#include "bindings/lua/editor/help.hpp"

#include <algorithm>

#include "bindings/lua/registry/record_type.hpp"
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::help_test {
namespace {

using Help = LuaTest;

std::vector<const Function*> all_functions() {
  std::vector<const Function*> all;
  for (const Module* module : modules()) {
    for (const Function& f : module->functions) all.push_back(&f);
    if (module->call) all.push_back(&*module->call);
  }
  for (const Class* type : classes())
    for (const Function& f : type->methods) all.push_back(&f);
  return all;
}

TEST_F(Help, ExistsForEverything) {
  for (const Module* module : modules()) {
    EXPECT_FALSE(module->sentence.empty()) << module->path;
    EXPECT_NE(help_text(module->path).find(module->sentence), std::string::npos) << module->path;
    for (const Constant& c : module->constants)
      EXPECT_NE(help_text(module->path + "." + c.name).find(c.sentence), std::string::npos) << c.name;
  }
  for (const Class* type : classes()) {
    EXPECT_FALSE(type->sentence.empty()) << type->name;
    EXPECT_NE(help_text(type->name).find(type->sentence), std::string::npos) << type->name;
    for (const Getter& field : type->fields) {
      EXPECT_FALSE(field.sentence.empty()) << type->name << "." << field.name;
      EXPECT_NE(help_text(type->name + "." + field.name).find(field.sentence), std::string::npos);
    }
  }
  for (const Function* function : all_functions()) {
    const std::string name = qualified_name(*function);
    EXPECT_FALSE(function->sentence.empty()) << name;
    const std::string text = help_text(name);
    EXPECT_NE(text.find(function->sentence), std::string::npos) << name;
    for (const Parameter& p : function->parameters)
      EXPECT_NE(text.find(p.sentence), std::string::npos) << name;
    if (function->options != nullptr)
      for (const OptionInfo* option : function->options->options()) {
        EXPECT_FALSE(option->sentence.empty()) << name << " " << option->name;
        EXPECT_NE(text.find(option->sentence), std::string::npos) << name << " " << option->name;
      }
  }
}

TEST_F(Help, AQuestionFindsSentences) {
  EXPECT_NE(help_text("how do I turn").find("contact:rotate: "), std::string::npos);
  EXPECT_NE(help_text("Which function reads a press log?").find("lab.protocol.read: "), std::string::npos);
  EXPECT_THROW(help_text("how do I"), Error);
  for (const auto& [question, first] : {std::pair{"turn a surface", "surface:rotated"},
                                        {"load a measured map", "lab.surface.read"},
                                        {"save a table", "table:write"},
                                        {"friction angle", "lab.tilt_stage"},
                                        {"fit a line", "table:fit"},
                                        {"roughness of a trace", "profile:roughness"}}) {
    const std::string text = help_text(question);
    EXPECT_EQ(text.substr(text.find('\n')).rfind("\n  " + std::string(first) + ": ", 0), 0u) << text;
  }
  EXPECT_TRUE(help_text("layer").starts_with("`layer` is part of"));
}

TEST_F(Help, ClassesThatFunctionsReturnExist) {
  for (const Function* function : all_functions())
    for (std::string types : result_types(*function)) {
      if (types.starts_with("iterator<")) types = types.substr(9, types.size() - 10);
      types.resize(std::min(types.find(" with "), types.size()));  // fields of a list
      for (std::size_t at = 0; at < types.size();) {
        const std::size_t end = std::min(types.find(" and ", at), types.size());
        std::string type = types.substr(at, end - at);
        at = end + 5;
        if (type.ends_with("?")) type.pop_back();
        while (type.ends_with("[]")) type.resize(type.size() - 2);
        const bool known = type == "number" || type == "integer" || type == "string" || type == "boolean" ||
                           type == "table" || type == "function" || type == "any" ||
                           find_class(type) != nullptr || find_record_type(type) != nullptr;
        EXPECT_TRUE(known) << qualified_name(*function) << " returns " << type;
      }
    }
}

TEST_F(Help, FindsATopicByItsLastNameInAnyCase) {
  EXPECT_EQ(help_text("surface.sine"), help_text("lab.surface.sine"));
  EXPECT_EQ(help_text("grain_profile"), help_text("lab.surface.grain_profile"));
  EXPECT_EQ(help_text("STATE"), help_text("State"));
  EXPECT_EQ(help_text("surface"), help_text("lab.surface"));
  EXPECT_NE(help_text("Surface"), help_text("surface"));
  const std::string both = help_text("roughness");  // of surfaces and of profiles
  EXPECT_NE(both.find("surface:roughness"), std::string::npos);
  EXPECT_NE(both.find("profile:roughness"), std::string::npos);
}

TEST_F(Help, SaysWhatSinglePrecisionIsWorth) {
  EXPECT_NE(help_text("lab.contact").find("\"single\" rounds them on any grid and saves memory"),
            std::string::npos);
}

TEST_F(Help, FindsKeysByTheirNameAndTheCallsThatTakeThem) {
  const std::string text = help_text("hardness");
  EXPECT_NE(text.find("Material.hardness"), std::string::npos);
  EXPECT_NE(text.find("Key `effects.plasticity.hardness` of lab.contact"), std::string::npos);
  EXPECT_NE(help_text("accuracy.tolerance").find("of lab.contact"), std::string::npos);
}

TEST_F(Help, ExplainsFunctionsAndValuesThemselves) {
  EXPECT_EQ(value("lab.help(lab.surface.sine) == lab.help 'lab.surface.sine'"), "true");
  EXPECT_EQ(value("lab.help(lab.surface) == lab.help 'lab.surface'"), "true");
  EXPECT_EQ(value("lab.help(lab.rigid) == lab.help 'Material'"), "true");
  EXPECT_EQ(value("lab.help(lab.surface.flat{ cells=2, size=1 }.rotated) == lab.help 'surface:rotated'"),
            "true");
  EXPECT_EQ(value("lab.help(lab.surface.flat{ cells=2, size=1 }:roughness()):match 'A roughness result'"),
            "A roughness result");
  EXPECT_NE(value("lab.help(math.floor)").find("math.floor: a function of Lua itself"), std::string::npos);
  EXPECT_NE(value("lab.help(io.open)").find("of Lua itself"), std::string::npos);
  EXPECT_NE(value("lab.help(function() end)").find("a function of this script, line 1"), std::string::npos);
  EXPECT_NE(value("lab.help(3)").find("`topic` is the number 3"), std::string::npos);
}

TEST_F(Help, OfAnUnknownTopicNamesTheNearest) {
  EXPECT_NE(run("lab.help 'weierstrass_mandlebrot'").find("(did you mean `weierstrass_mandelbrot`?)"),
            std::string::npos);
  EXPECT_EQ(run("lab.help 'surfase'"),
            "script.lua:1: lab.help: there is no help on `surfase` (did you mean `surface`?); help without a "
            "topic lists all topics");
}

TEST_F(Help, FindsPartsOfNamesAndWordsOfSentences) {
  const std::pair<const char*, const char*> wanted[] = {
      {"weierstras", "lab.surface.weierstrass_mandelbrot: "},
      {"tilt", "lab.tilt_stage: "},
      {"rough", "surface:roughness: "},
      {"stiff", "State.stiffness: "},
      {"plastic", "key `effects.plasticity` of lab.contact: "},
      {"Sq", "surface:roughness: "},
      {"mu", "tiltStage:raise: "},
      {"trials", "tiltStage:raise: "},
      {"half_space", "key `effects.elasticity` of lab.contact: "},
      {"x3p", "lab.surface.read: "},
      {"box", "key `effects.elasticity` of lab.contact: "},
  };
  for (const auto& [asked, found] : wanted) {
    const std::string text = help_text(asked);
    EXPECT_NE(text.find(found), std::string::npos) << asked << ":\n" << text;
  }
  EXPECT_EQ(help_text("observe").find("order_observed") != std::string::npos, true);
  EXPECT_THROW(help_text("serve"), Error);  // in ob-serve-d
  EXPECT_THROW(help_text("w"), Error);
  EXPECT_THROW(help_text("zzzz"), Error);
}

TEST_F(Help, ListsEveryModuleAndValueWithoutATopic) {
  const std::string text = help_text("");
  for (const Module* module : modules()) EXPECT_NE(text.find(module->path), std::string::npos);
  for (const Class* type : classes()) EXPECT_NE(text.find(type->name), std::string::npos);
  EXPECT_EQ(value("lab.help() == lab.help(nil)"), "true");
}

TEST_F(Help, ExamplesAreLua) {
  for (const Function* function : all_functions()) {
    if (function->example.empty()) continue;
    const std::string chunk = function->example;
    const std::string as_expression = "return " + chunk;
    const bool good =
        luaL_loadstring(L, chunk.c_str()) == LUA_OK || luaL_loadstring(L, as_expression.c_str()) == LUA_OK;
    EXPECT_TRUE(good) << qualified_name(*function) << ": " << chunk;
    lua_settop(L, 0);
  }
}

TEST_F(Help, TheReferencePageNamesEverything) {
  const std::string page = reference_page();
  for (const Module* module : modules()) EXPECT_NE(page.find("## `" + module->path + "`"), std::string::npos);
  for (const Class* type : classes()) {
    EXPECT_NE(page.find("## " + type->name + "\n"), std::string::npos) << type->name;
    for (const Getter& field : type->fields)
      EXPECT_NE(page.find("| `" + field.name + "` |"), std::string::npos);
  }
  for (const Function* function : all_functions()) {
    // Notebooks refer to the methods of tables.
    const std::string name = qualified_name(*function);
    const std::string shared = name.starts_with("notebook:") ? "table:" + name.substr(9) : name;
    const bool named = page.find("### `" + name + "`") != std::string::npos;
    EXPECT_TRUE(named || page.find("### `" + shared + "`") != std::string::npos) << name;
    if (function->options == nullptr) continue;
    for (const OptionInfo* option : function->options->options())
      EXPECT_NE(page.find("| `" + option->name + "` |"), std::string::npos) << option->name;
  }
}

TEST_F(Help, AListingStandsBelowItsFunction) {
  const std::string page = reference_page(), help = help_text("surface.read");
  const std::size_t at = page.find("### `lab.surface.read`");
  std::size_t listings = 0;
  for (const Function* function : all_functions()) {
    if (function->listing == nullptr) continue;
    ++listings;
    const Listing listing = function->listing();
    EXPECT_FALSE(listing.rows.empty());
    for (const std::vector<std::string>& row : listing.rows) {
      EXPECT_EQ(row.size(), listing.columns.size()) << row.front();
      EXPECT_NE(page.find("| " + row.front() + " | ", at), std::string::npos) << row.front();
      EXPECT_NE(help.find("\n  " + row.front() + "\n"), std::string::npos) << row.front();
    }
  }
  EXPECT_EQ(listings, 1u);
}

TEST_F(Help, TheEditorsTypesAreLuaAndNameEverything) {
  const std::string types = editor_types();
  ASSERT_EQ(luaL_loadbufferx(L, types.data(), types.size(), "types", "t"), LUA_OK) << lua_tostring(L, -1);
  lua_settop(L, 0);
  EXPECT_EQ(run(types), "");  // valid Lua
  for (const Function* function : all_functions()) {
    const std::string name = qualified_name(*function);
    const std::size_t at = name.find_last_of(".:");
    const bool module =
        std::any_of(modules().begin(), modules().end(), [&](const Module* m) { return m->path == name; });
    const std::string declared =
        module ? "---@class asperity." + name + "\n---@overload fun(" : name.substr(at + 1) + "(";
    EXPECT_NE(types.find(declared), std::string::npos) << name;
  }
  for (const Class* type : classes())
    EXPECT_NE(types.find("---@class asperity." + type->name), std::string::npos);
}

}  // namespace
}  // namespace asperity::lua::help_test
