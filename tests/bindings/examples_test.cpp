// SPDX-License-Identifier: GPL-3.0-or-later
// Every example runs alone after the preamble of the reference.
#include <vector>

#include "bindings/lua/editor/help.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::examples_test {
namespace {

using Example = LuaTest;

std::vector<const Function*> all_functions() {
  std::vector<const Function*> found;
  for (const Module* module : modules()) {
    if (module->call) found.push_back(&*module->call);
    for (const Function& function : module->functions) found.push_back(&function);
  }
  for (const Class* type : classes())
    for (const Function& method : type->methods) found.push_back(&method);
  return found;
}

TEST_F(Example, EveryFunctionHasOneThatNamesIt) {
  for (const Function* function : all_functions()) {
    EXPECT_NE(function->example, "") << qualified_name(*function);
    EXPECT_NE(function->example.find(function->name), std::string::npos) << qualified_name(*function);
  }
}

TEST_F(Example, ThePreambleRunsAndIsShown) {
  EXPECT_EQ(run(example_preamble()), "");
  EXPECT_NE(reference_page().find(example_preamble()), std::string::npos);
}

TEST_F(Example, EveryOneRunsAfterThePreambleAlone) {
  for (const Function* function : all_functions()) {
    TearDown();
    SetUp();
    EXPECT_EQ(run(example_preamble() + "do " + function->example + "\nend"), "")
        << qualified_name(*function) << ": " << function->example;
    ASSERT_NE(session.run, nullptr);
    EXPECT_EQ(session.run->expectations().failed(), 0) << qualified_name(*function);
  }
}

TEST_F(Example, EveryOperatorHasOneThatRuns) {
  std::string all;
  for (const Class* type : classes())
    for (const Operator& operation : type->operators) {
      EXPECT_NE(operation.example, "") << operation.form;
      EXPECT_NE(reference_page().find(operation.example), std::string::npos) << operation.form;
      all += "do " + operation.example + " end\n";
    }
  EXPECT_EQ(run(example_preamble() + all), "");
}

}  // namespace
}  // namespace asperity::lua::examples_test
