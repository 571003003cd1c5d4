// SPDX-License-Identifier: GPL-3.0-or-later
// Digests of equal and different content.
#include "engine/core/digest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace asperity::digest_test {
namespace {

TEST(Digest, HasThirtyTwoDigitsAndMayBeReadOften) {
  Digester digester;
  digester.add("grid").add(3).add(0.5);
  const std::string first = digester.hex();
  EXPECT_EQ(first.size(), 32u);
  EXPECT_EQ(first.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(digester.hex(), first);
  EXPECT_NE(digester.add(1).hex(), first);
  EXPECT_EQ(Digester().add("grid").add(3).add(0.5).hex(), first);
}

TEST(Digest, ItemsDoNotRunTogether) {
  const std::vector<double> one_two = {1, 2};
  const std::set<std::string> all = {
      Digester().hex(),
      Digester().add("").hex(),
      Digester().add("ab").add("c").hex(),
      Digester().add("a").add("bc").hex(),
      Digester().add("abc").hex(),
      Digester().add(1).hex(),
      Digester().add(1.0).hex(),
      Digester().add("1").hex(),
      Digester().add(one_two).hex(),
      Digester().add(1.0).add(2.0).hex(),
      Digester().add(2.0).add(1.0).hex(),
  };
  EXPECT_EQ(all.size(), 11u);
}

TEST(Digest, SeesTheLastBit) {
  EXPECT_NE(Digester().add(1.0).hex(), Digester().add(std::nextafter(1.0, 2.0)).hex());
  EXPECT_NE(Digester().add(0.0).hex(), Digester().add(-0.0).hex());
  std::vector<double> values(100000, 0.25);
  const std::string before = Digester().add(values).hex();
  values[99999] = std::nextafter(0.25, 1.0);
  EXPECT_NE(Digester().add(values).hex(), before);
}

TEST(Digest, MovedStateGoesOn) {
  Digester a;
  a.add("x");
  Digester b = std::move(a);
  EXPECT_EQ(b.add("y").hex(), Digester().add("x").add("y").hex());
}

}  // namespace
}  // namespace asperity::digest_test
