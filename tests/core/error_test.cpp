// SPDX-License-Identifier: GPL-3.0-or-later
// The exception of the engine.
#include "engine/core/error.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

namespace asperity::error_test {
namespace {

TEST(Error, JoinsSentenceAndHint) {
  const Error error(ErrorCode::bad_value, "`D` is 3.5", "give a number from 2 to 3");
  EXPECT_EQ(error.code(), ErrorCode::bad_value);
  EXPECT_EQ(error.sentence(), "`D` is 3.5");
  EXPECT_EQ(error.hint(), "give a number from 2 to 3");
  EXPECT_STREQ(error.what(), "`D` is 3.5; give a number from 2 to 3");
}

TEST(Error, StandsWithoutAHint) {
  EXPECT_STREQ(Error(ErrorCode::interrupted, "interrupted").what(), "interrupted");
}

TEST(Error, WhatItRepeatsIsPlainText) {
  const Error error(ErrorCode::bad_file, "\"\x1b[31m\xC2\"", "a\tb\n\xC2\xB5m\r");
  EXPECT_EQ(error.sentence(), "\"?[31m?\"");
  EXPECT_EQ(error.hint(), "a\tb\n\xC2\xB5m?");
  EXPECT_STREQ(error.what(), "\"?[31m?\"; a\tb\n\xC2\xB5m?");
}

TEST(Error, EveryCodeHasItsOwnName) {
  std::set<std::string_view> names;
  for (int code = 0; code <= static_cast<int>(ErrorCode::internal); ++code)
    names.insert(name(static_cast<ErrorCode>(code)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(ErrorCode::internal) + 1);
  EXPECT_EQ(name(ErrorCode::not_converged), "not_converged");
}

}  // namespace
}  // namespace asperity::error_test
