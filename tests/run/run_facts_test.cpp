// SPDX-License-Identifier: GPL-3.0-or-later
// Facts about the surroundings of a run.
#include "engine/run/run_facts.hpp"

#include "engine/core/files/atomic_file.hpp"
#include "tests/support/run_fixture.hpp"

namespace asperity::run_facts_test {
namespace {

using RunFactsTest = InFolder;

TEST(RunFacts, DateIsIso8601) {
  std::string pattern = utc_now();
  for (char& c : pattern)
    if (c >= '0' && c <= '9') c = '0';
  EXPECT_EQ(pattern, "0000-00-00T00:00:00Z");
}

TEST(RunFacts, MachineHasProcessors) {
  EXPECT_GE(machine_facts().find("processors")->number(), 1);
  EXPECT_NE(machine_facts().find("system"), nullptr);
}

TEST(RunFacts, MachineNamesWhatLastDigitsHangOn) {
  const Json here = machine_facts();
  for (const char* name : {"c_library_functions", "build"}) EXPECT_NE(here.find(name), nullptr) << name;
  EXPECT_TRUE(differing_machines(here, here).empty());
  Json there = here;
  there.set("processor", "Z80")
      .set("c_library", "another 1.0")
      .set("c_library_functions", "0")
      .set("memory", 1);
  const std::vector<std::string> lines = differing_machines(there, here);
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  if (here.find("processor") != nullptr) {
    EXPECT_NE(all.find("another processor: Z80, here "), std::string::npos);
  }
  EXPECT_NE(all.find("rounding of the C library's functions"), std::string::npos) << all;
  EXPECT_EQ(all.find("memory"), std::string::npos);
  // A run of an earlier version noted less.
  EXPECT_TRUE(differing_machines(Json::object(), here).empty());
}

TEST_F(RunFactsTest, DigestTellsContentsApart) {
  const std::string large(3 << 20, 'x');
  write_atomically(folder / "a", large);
  write_atomically(folder / "b", large);
  write_atomically(folder / "c", large.substr(1) + "y");
  write_atomically(folder / "empty", "");
  EXPECT_EQ(file_digest(folder / "a"), file_digest(folder / "b"));
  EXPECT_NE(file_digest(folder / "a"), file_digest(folder / "c"));
  EXPECT_EQ(file_digest(folder / "empty").size(), 32U);
  EXPECT_NE(error_of([&] { file_digest(folder / "missing"); }).find("bad_file: cannot read"),
            std::string::npos);
}

}  // namespace
}  // namespace asperity::run_facts_test
