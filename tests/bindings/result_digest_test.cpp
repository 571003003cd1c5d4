// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/call_record.hpp"

#include <gtest/gtest.h>

#include "bindings/lua/surface/surface.hpp"
#include "engine/surface/surface.hpp"

namespace asperity::lua::result_digest_test {
namespace {

Values result(double mu, double seconds, double third, const char* file = "a.svg") {
  Record record{"raise", {}};
  record.add("mu", mu, dimension::number).add("seconds", seconds, dimension::time).add("file", file);
  record.add("trials", List({Value(1.0), Value(true), Value(third)}));
  return {Value(std::move(record))};
}

TEST(ResultDigest, EveryNumberCountsAndCostsDoNot) {
  const std::string one = digest_of(result(0.4, 1, 3));
  EXPECT_EQ(one.size(), 32U);
  EXPECT_EQ(digest_of(result(0.4, 2, 3)), one);
  EXPECT_NE(digest_of(result(0.41, 1, 3)), one);
  EXPECT_NE(digest_of(result(0.4, 1, 4)), one);
  EXPECT_NE(digest_of(result(0.4, 1, 3, "b.svg")), one);
}

TEST(ResultDigest, OfTablesOfNumbers) {
  const auto numbers = [](double last) {
    return Values{Value(Value::Numbers(std::make_shared<const Array<double>>(Array<double>{1.0, last})))};
  };
  EXPECT_EQ(digest_of(numbers(2)), digest_of(numbers(2)));
  EXPECT_NE(digest_of(numbers(2)), digest_of(numbers(3)));
  const auto rows = [](int nx, int ny) {
    return Values{Value(Value::Rows(std::make_shared<const Field>(nx, ny, 1.0)))};
  };
  EXPECT_NE(digest_of(rows(2, 3)), digest_of(rows(3, 2)));
}

TEST(ResultDigest, OfANativeValueIsItsOwn) {
  const Value surface = object(Surface(make_grid(4, 4, 1, 1), Field(4, 4)));
  const Object& native = std::get<Object>(surface.data);
  EXPECT_FALSE(digest_of(native).empty());
  EXPECT_EQ(digest_of(Values{surface}), digest_of(native));
}

TEST(ResultDigest, OfPlacesAndOfNothingThereIsNone) {
  EXPECT_EQ(digest_of(Values{}), "");
  EXPECT_EQ(digest_of(Values{Value("/tmp/run/chart.svg")}), "");
  EXPECT_EQ(digest_of(Values{Value()}), "");
}

}  // namespace
}  // namespace asperity::lua::result_digest_test
