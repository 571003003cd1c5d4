// SPDX-License-Identifier: GPL-3.0-or-later
// Methods and their settings; knobs as Lua source.
#include "engine/study/study_setting.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::study_setting_test {
namespace {

std::string failure_of(std::vector<KnobSweep> knobs) {
  return test::error_of([&] { make_way("fine", std::move(knobs)); });
}

const std::vector<KnobValue> two = {std::int64_t{1}, std::int64_t{2}};
const std::vector<KnobValue> three = {0.1, 0.01, 0.001};
const std::vector<KnobValue> one = {std::string("box")};

TEST(StudyWay, ListsGoAlongTogether) {
  const StudyWay way =
      make_way("fine", {{"tolerance", {1e-2, 1e-3}, true}, {"model", one, false}, {"cells", two, true}});
  ASSERT_EQ(way.settings.size(), 2U);
  EXPECT_EQ(lua_source(way.settings[0]), "{ cells=1, model=\"box\", tolerance=0.01 }");
  EXPECT_EQ(lua_source(way.settings[1]), "{ cells=2, model=\"box\", tolerance=0.001 }");
}

TEST(StudyWay, WithoutAListItIsOneSetting) {
  EXPECT_EQ(make_way("plain", {{"model", one, false}}).settings.size(), 1U);
  EXPECT_EQ(make_way("plain", {}).settings.size(), 1U);
  EXPECT_EQ(lua_source(make_way("plain", {}).settings[0]), "{}");
}

TEST(StudyWay, RefusesListsOfUnequalLength) {
  EXPECT_EQ(failure_of({{"tolerance", three, true}, {"cells", two, true}}),
            "the way `fine` lists 2 values of `cells` and 3 of `tolerance`; give lists of equal length, or "
            "make two ways");
}

TEST(StudyWay, RefusesEmptyListsAndClashingNames) {
  EXPECT_EQ(failure_of({{"cells", {}, true}}),
            "the way `fine` gives an empty list for `cells`; list at least one value, from coarse to fine");
  EXPECT_EQ(
      failure_of({{"seconds", two, true}}),
      "the way `fine` has a knob `seconds`, and the rows of a study have a column of that name; call the "
      "knob something else");
  EXPECT_EQ(failure_of({{"cells", two, true}, {"cells", two, true}}), "the way `fine` gives `cells` twice");
  EXPECT_EQ(failure_of({{"", two, true}}), "the way `fine` has a knob with an empty name");
}

TEST(StudyWay, RunsFromCoarseToFine) {
  using Order = std::vector<std::size_t>;
  EXPECT_EQ(coarse_to_fine(make_way("a", {{"cells", two, true}})), (Order{0, 1}));
  EXPECT_EQ(coarse_to_fine(make_way("a", {{"cells", {std::int64_t{2}, std::int64_t{1}}, true}})),
            (Order{1, 0}));
  EXPECT_EQ(coarse_to_fine(make_way("a", {{"tolerance", three, true}})), (Order{0, 1, 2}));
  EXPECT_EQ(coarse_to_fine(make_way("a", {{"tolerance", {1e-6, 1e-2}, true}})), (Order{1, 0}));
  EXPECT_EQ(coarse_to_fine(make_way("a", {{"terms", {std::int64_t{9}, std::int64_t{3}}, true}})),
            (Order{0, 1}));
}

TEST(KnobSource, ReadsBackAsTheSameValue) {
  EXPECT_EQ(lua_source(KnobValue(true)), "true");
  EXPECT_EQ(lua_source(KnobValue(std::int64_t{-3})), "-3");
  EXPECT_EQ(lua_source(KnobValue(0.1)), "0.1");
  EXPECT_EQ(lua_source(KnobValue(1e-6)), "1e-06");
  EXPECT_EQ(lua_source(KnobValue(std::numeric_limits<double>::infinity())), "math.huge");
  EXPECT_EQ(lua_source(KnobValue(std::string("a \"b\" \\ \n\x01"))), "\"a \\\"b\\\" \\\\ \\010\\001\"");
}

TEST(KnobSource, NamesThatAreNoNamesStandInBrackets) {
  EXPECT_EQ(lua_source(Knobs{{"end", true}, {"my knob", true}, {"x_1", true}}),
            "{ [\"end\"]=true, [\"my knob\"]=true, x_1=true }");
}

}  // namespace
}  // namespace asperity::study_setting_test
