// SPDX-License-Identifier: GPL-3.0-or-later
// The table of laws that changed: whole, and asked by versions.
#include "engine/run/changed_laws.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace asperity::changed_laws_test {
namespace {

TEST(ChangedLaws, AreToldInFullAndUnderNamesOfTheirOwn) {
  std::set<std::string_view> names;
  ASSERT_EQ(changed_laws().size(), law_count);
  for (const ChangedLaw& law : changed_laws()) {
    EXPECT_EQ(&told(law.law), &law);
    EXPECT_TRUE(is_earlier("0.0.0", law.since).has_value()) << law.name;
    EXPECT_TRUE(names.insert(law.name).second) << law.name;
    for (const std::string_view sentence : {law.name, law.before, law.now, law.moves})
      EXPECT_FALSE(sentence.empty()) << law.name;
  }
}

TEST(ChangedLaws, VersionsAreOrderedByTheirNumbers) {
  EXPECT_EQ(is_earlier("0.1.0", "0.2.0"), true);
  EXPECT_EQ(is_earlier("0.9.1", "0.10.0"), true);
  EXPECT_EQ(is_earlier("1.0.0", "0.10.9"), false);
  EXPECT_EQ(is_earlier("0.2.0", "0.2.0"), false);
  for (const char* version :
       {"", "0.1", "0.1.0.1", "0.1.0-rc1", "v0.1.0", "0..1", "-1.0.0", "1.2.x", "99999999999.0.0"}) {
    EXPECT_EQ(is_earlier(version, "0.2.0"), std::nullopt) << version;
    EXPECT_EQ(is_earlier("0.2.0", version), std::nullopt) << version;
  }
}

TEST(ChangedLaws, BetweenTwoVersionsAreThoseOfTheLater) {
  EXPECT_EQ(laws_changed_between("0.1.0", "0.2.0").size(), law_count);
  EXPECT_EQ(laws_changed_between("0.1.0", "0.1.9").size(), 0U);
  EXPECT_EQ(laws_changed_between("0.2.0", "0.2.0").size(), 0U);
  EXPECT_EQ(laws_changed_between("0.2.0", "0.3.0").size(), 0U);
  EXPECT_EQ(laws_changed_between("0.2.0", "0.1.0").size(), 0U);
  EXPECT_EQ(laws_changed_between("", "0.2.0").size(), 0U);
  EXPECT_EQ(laws_changed_between("0.1.0", "0.2.0").front()->law, Law::last_digits);
}

}  // namespace
}  // namespace asperity::changed_laws_test
