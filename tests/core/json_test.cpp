// SPDX-License-Identifier: GPL-3.0-or-later
// JSON: exact numbers, order, invalid texts.
#include "engine/core/files/json.hpp"

#include <cmath>
#include <limits>

#include "tests/support/run_fixture.hpp"

namespace asperity::json_test {
namespace {

using Limits = std::numeric_limits<double>;

TEST(Json, KeepsTheOrderOfMembers) {
  Json json;
  json.set("b", 1).set("a", "x").set("list", Json::List{true, 2.5, Json()});
  EXPECT_EQ(json.text(), R"({"b":1,"a":"x","list":[true,2.5,null]})");
  json.set("b", 2);
  EXPECT_EQ(json.text(), R"({"b":2,"a":"x","list":[true,2.5,null]})");
}

TEST(Json, NumbersReadBackAsTheSameDouble) {
  for (const double value :
       {0.1, 1.0 / 3, 5e-324, Limits::max(), Limits::min(), std::nextafter(1.0, 2.0), -0.0, 3.0}) {
    const Json back = Json::parse(Json(value).text(), "test");
    EXPECT_EQ(back.number(), value) << Json(value).text();
    EXPECT_EQ(std::signbit(back.number()), std::signbit(value));
  }
}

TEST(Json, WritesWhatIsNoNumberAsText) {
  EXPECT_EQ(Json(Limits::quiet_NaN()).text(), "\"nan\"");
  EXPECT_EQ(Json(-Limits::infinity()).text(), "\"-inf\"");
  EXPECT_TRUE(std::isnan(Json::parse("\"nan\"", "test").number()));
  EXPECT_EQ(Json::parse("\"inf\"", "test").number(), Limits::infinity());
}

TEST(Json, KeepsWholeNumbersPastInt64AsText) {
  EXPECT_EQ(Json(std::numeric_limits<std::int64_t>::max()).text(), "9223372036854775807");
  EXPECT_EQ(Json(std::uint64_t{1} << 63).text(), "\"9223372036854775808\"");
}

TEST(Json, SurvivesBytesThatAreNotText) {
  EXPECT_EQ(Json(std::string("a\xff\n")).text(), "\"a\xEF\xBF\xBD\\n\"");
}

TEST(Json, SaysWhereTextStopsBeingJson) {
  EXPECT_EQ(error_of([] { Json::parse("{\"a\":", "manifest.json"); }),
            "bad_file: manifest.json is not JSON past byte 6; the file was cut short or damaged");
}

TEST(Json, NumbersBeyondAnyDoubleAreRefused) {
  EXPECT_EQ(error_of([] { Json::parse("[1e999]", "journal.jsonl"); }),
            "bad_file: journal.jsonl holds a number beyond any double; the file was cut short or damaged");
  EXPECT_EQ(Json::parse("[1e-999]", "j").list()[0].number(), 0);
}

TEST(Json, ListsInListsAreTakenApartOnlySoDeep) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(Json::parse(nested(256), "j").text(), nested(256));
  EXPECT_NE(error_of([&] { Json::parse(nested(258), "j"); }).find("deeper than 256"), std::string::npos);
  EXPECT_NE(error_of([&] { Json::parse(nested(1000000), "j"); }).find("deeper than 256"), std::string::npos);
}

TEST(Json, SaysWhatItHoldsInsteadOfWhatWasWanted) {
  EXPECT_EQ(error_of([] { Json(true).number(); }),
            "bad_file: a record holds a boolean instead of a number; the file was written by another "
            "program or damaged");
  EXPECT_EQ(Json().find("a"), nullptr);
  EXPECT_NE(error_of([] { Json(1).set("a", 2); }), "");
}

}  // namespace
}  // namespace asperity::json_test
