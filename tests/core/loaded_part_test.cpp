// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/loaded_part.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "engine/core/error.hpp"

namespace asperity::loaded_part_test {
namespace {

constexpr LoadedPart unknown{"nothing", "nothing is done", "no-package"};

std::string refusal(const std::vector<std::filesystem::path>& places, const char* symbol = "f") {
  try {
    part_symbol(unknown, symbol, places);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_file);
    return error.what();
  }
  return "no error";
}

TEST(LoadedPart, ProgramsInTheBuildFolderLookThere) {
  const auto places = part_places(unknown);
  ASSERT_EQ(places.size(), 4u);
  for (const auto& place : places) EXPECT_EQ(place.filename(), "asperity-nothing.so");
  const auto own = std::filesystem::canonical("/proc/self/exe").parent_path();
  EXPECT_EQ(places[0], own / "asperity-nothing.so");
  EXPECT_EQ(places[1], own.parent_path() / "lib/asperity/asperity-nothing.so");
  // Last: the install folder.
  EXPECT_EQ(places[3].parent_path().filename(), "asperity");
}

TEST(LoadedPart, MissingFileNamesThePlaces) {
  EXPECT_EQ(refusal({"/nowhere/a.so", "/nowhere/b.so"}),
            "nothing is done by asperity-nothing.so, a file that is missing; looked for `/nowhere/a.so` and "
            "`/nowhere/b.so`; build or install the whole program, with Debian's package no-package");
}

TEST(LoadedPart, FileThatIsNoPartNamesThePackage) {
  const auto path = std::filesystem::temp_directory_path() / "asperity-nothing-test.so";
  std::ofstream(path) << "no library";
  const std::string text = refusal({path});
  std::filesystem::remove(path);
  EXPECT_NE(text.find(", which cannot be loaded: "), std::string::npos) << text;
  EXPECT_NE(text.find("; install Debian's package no-package"), std::string::npos) << text;
}

TEST(LoadedPart, LibraryWithoutTheFunctionIsOfAnotherVersion) {
  const std::string text = refusal({"/lib/x86_64-linux-gnu/libm.so.6"}, "asperity_no_such_function");
  if (!std::filesystem::exists("/lib/x86_64-linux-gnu/libm.so.6")) GTEST_SKIP() << "libm stands elsewhere";
  EXPECT_NE(text.find("a file of another version: it has no `asperity_no_such_function`"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace asperity::loaded_part_test
