// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/sandbox/frames.hpp"

#include <gtest/gtest.h>

#include "engine/core/error.hpp"

namespace asperity::web::frames_test {
namespace {

std::string framed(std::vector<std::string_view> texts) { return frame(texts); }

TEST(TakenFrame, IsTakenOnceItsLastByteIsThere) {
  const std::string whole = framed({"answer", "", std::string_view("\0\1", 2)}), next = framed({"x"});
  std::string arrived;
  for (std::size_t k = 0; k + 1 < whole.size(); ++k) {
    arrived += whole[k];
    ASSERT_FALSE(take_frame(arrived, 100)) << k;
  }
  arrived += whole.back() + next;
  const auto texts = take_frame(arrived, 100);
  ASSERT_TRUE(texts);
  EXPECT_EQ(*texts, (std::vector<std::string>{"answer", "", std::string("\0\1", 2)}));
  EXPECT_EQ(take_frame(arrived, 100)->front(), "x");
  EXPECT_EQ(arrived, "");
  EXPECT_FALSE(take_frame(arrived, 100));
}

TEST(TakenFrame, MayHaveSoManyBytesAndNoMore) {
  std::string arrived = framed({"1234", "567"});
  EXPECT_THROW(take_frame(arrived, 6), Error);
  EXPECT_TRUE(take_frame(arrived, 7));
}

TEST(TakenFrame, IsRefusedBeforeItsBytesCome) {
  std::string length = framed({"x"}).substr(0, 8) + std::string(8, '\xff');
  EXPECT_THROW(take_frame(length, 1 << 20), Error);
  std::string count(8, '\xff');
  EXPECT_THROW(take_frame(count, 1 << 20), Error);
}

}  // namespace
}  // namespace asperity::web::frames_test
