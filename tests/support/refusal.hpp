// SPDX-License-Identifier: GPL-3.0-or-later
// The text of the Error thrown by a call.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "engine/core/error.hpp"

namespace asperity::test {

template <class Call>
std::string error_of(const Call& call, const char* otherwise = "") {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return otherwise;
}

// As error_of; the error must have this code.
template <class Call>
std::string refusal(const Call& call, ErrorCode code = ErrorCode::bad_value) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "accepted";
}

}  // namespace asperity::test
