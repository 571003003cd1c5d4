// SPDX-License-Identifier: GPL-3.0-or-later
// Each script ends in its new message.
#include <fstream>
#include <string>

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::changed_messages_test {
namespace {

using ChangedMessages = LuaTest;

TEST_F(ChangedMessages, AreThoseListed) {
  ASSERT_EQ(run("steel = lab.material{ young='200 GPa', poisson=0.3, hardness='2 GPa' }\n"
                "surface = lab.surface.sine{ cells=16, size='1 mm', amplitude='1 um', material=steel }"),
            "");
  std::ifstream file(std::string(ASPERITY_TEST_DATA) + "/../bindings/changed_messages.txt");
  std::string line, script, old;
  int count = 0;
  while (std::getline(file, line)) {
    const auto after = [&](const std::string& mark) {
      return line.starts_with(mark) ? line.substr(mark.size()) : std::string();
    };
    if (const std::string text = after("script: "); !text.empty()) script = text;
    if (const std::string text = after("old: "); !text.empty()) old = text;
    const std::string now = after("new: ");
    if (now.empty()) continue;
    ++count;
    const std::string message = run(script);
    EXPECT_NE(message.find(now), std::string::npos) << script << "\n" << message;
    EXPECT_EQ(message.find(old), std::string::npos) << script << "\n" << message;
  }
  EXPECT_GE(count, 7);
}

}  // namespace
}  // namespace asperity::lua::changed_messages_test
