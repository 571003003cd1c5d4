// SPDX-License-Identifier: GPL-3.0-or-later
// UTF-16 and single-byte text as UTF-8.
#include "engine/core/files/text_encoding.hpp"

#include <gtest/gtest.h>

namespace asperity::text_encoding_test {
namespace {

using namespace std::string_literals;

TEST(TextEncoding, Utf16OfBothOrdersWithAndWithoutAMark) {
  const std::string little = "a\0,\0b\0\n\0001\0,\0002\0\n\0\xE4\0"s;
  const std::string big = "\0a\0,\0b\0\n\0001\0,\0002\0\n\0\xE4"s;
  const std::string wanted = "a,b\n1,2\n\xC3\xA4";
  EXPECT_EQ(utf8_of_utf16("\xFF\xFE" + little), wanted);
  EXPECT_EQ(utf8_of_utf16("\xFE\xFF" + big), wanted);
  EXPECT_EQ(utf8_of_utf16(little), wanted);
  EXPECT_EQ(utf8_of_utf16(big), wanted);
  EXPECT_EQ(utf8_of_utf16("a,b\n1,2\n3,4\n5,6\n"), std::nullopt);
  EXPECT_EQ(utf8_of_utf16("a\0b\0"s), std::nullopt);  // too short without a byte order mark
  EXPECT_EQ(utf8_of_utf16(""), std::nullopt);
}

TEST(TextEncoding, PairsAndHalvesOfThem) {
  EXPECT_EQ(utf8_of_utf16("\xFF\xFE\x3D\xD8\x00\xDE"s), "\xF0\x9F\x98\x80");
  EXPECT_EQ(utf8_of_utf16("\xFF\xFE\x3D\xD8z\0"s), "\xEF\xBF\xBDz");
  EXPECT_EQ(utf8_of_utf16("\xFF\xFE\x00\xDE"s), "\xEF\xBF\xBD");
  EXPECT_EQ(utf8_of_utf16("\xFF\xFE\xAC\x20\x61"s), "\xE2\x82\xAC");  // half a unit at the end
}

TEST(TextEncoding, BytesThatAreNotUtf8AreWindows1252) {
  EXPECT_EQ(utf8_or_cp1252("H\xE4rte \xB5m"), "H\xC3\xA4rte \xC2\xB5m");
  EXPECT_EQ(utf8_or_cp1252("H\xC3\xA4rte"), "H\xC3\xA4rte");
  EXPECT_EQ(utf8_or_cp1252("\xC3"), "\xC3\x83");
  EXPECT_EQ(utf8_or_cp1252("\xED\xA0\x80"), "\xC3\xAD\xC2\xA0\xE2\x82\xAC");  // half of a pair
  EXPECT_EQ(utf8_or_cp1252("\xC0\xAF"), "\xC3\x80\xC2\xAF");                  // overlong
  EXPECT_EQ(utf8_or_cp1252("\xF4\x90\x80\x80"), "\xC3\xB4\xEF\xBF\xBD\xE2\x82\xAC\xE2\x82\xAC");
  EXPECT_EQ(utf8_or_cp1252("\x80 \x96 \x9F"), "\xE2\x82\xAC \xE2\x80\x93 \xC5\xB8");
}

}  // namespace
}  // namespace asperity::text_encoding_test
