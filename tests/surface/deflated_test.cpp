// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/deflated.hpp"

#include <gtest/gtest.h>

#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/optical_files.hpp"

namespace asperity::deflated_test {
namespace {

using testing::error_of;
using testing::gzipped;
using testing::message_of;
using testing::Scratch;

const std::string matrix = "# Width: 3 um\n# Height: 2 um\n# Value units: nm\n1 2 3\n4 5 6\n";

TEST(Gzip, AFileInsideIsReadAsItIs) {
  const Surface plain = read_surface(SourceFile("map.txt", matrix));
  const Surface packed = read_surface(SourceFile("map.txt.gz", gzipped(matrix)));
  EXPECT_EQ(plain.grid(), packed.grid());
  EXPECT_EQ(packed.height(2, 0), 6 * 1e-9);
  const std::string sur = testing::SurExample{}(std::vector<std::int16_t>{1, 2, 3, 4, 5, 6});
  EXPECT_EQ(read_surface(SourceFile("map", gzipped(sur))).grid().nx, 3);
  EXPECT_EQ(read_profile(SourceFile("a.csv.gz", gzipped("x [mm],z [um]\n0,1\n1,2\n2,4\n"))).size(), 3);
}

TEST(Gzip, TheEndingBeforeGzCounts) {
  EXPECT_EQ(inside_gzip(SourceFile("a.XYZ.gz", gzipped("1")), Monitor::silent())->extension(), "xyz");
  EXPECT_EQ(inside_gzip(SourceFile("a.gz", gzipped("1")), Monitor::silent())->extension(), "");
  EXPECT_EQ(inside_gzip(SourceFile("a.sur", gzipped("1")), Monitor::silent())->extension(), "sur");
  EXPECT_FALSE(inside_gzip(SourceFile("a.gz", "1 2 3"), Monitor::silent()));
}

TEST(Gzip, PiecesOneBehindAnotherAreOneFile) {
  const std::string both = gzipped(matrix.substr(0, 50)) + gzipped(matrix.substr(50));
  EXPECT_EQ(read_surface(SourceFile("map.txt.gz", both)).height(2, 0), 6 * 1e-9);
  EXPECT_EQ(read_surface(SourceFile("map.txt.gz", both + std::string(512, '\0'))).height(2, 0), 6 * 1e-9);
}

TEST(Gzip, EachFaultIsSaid) {
  const std::string whole = gzipped(matrix);
  for (const std::size_t length : {std::size_t{4}, std::size_t{12}, whole.size() / 2, whole.size() - 1})
    EXPECT_EQ(message_of([&] { read_surface(SourceFile("a.gz", whole.substr(0, length))); }),
              "\"a.gz\" is packed with gzip and cut short; fetch or pack it again")
        << length;
  std::string damaged = whole;
  damaged[damaged.size() - 6] = static_cast<char>(damaged[damaged.size() - 6] + 1);  // in the checksum
  EXPECT_EQ(message_of([&] { read_surface(SourceFile("a.gz", damaged)); }),
            "\"a.gz\" is packed with gzip and does not unpack; the file is damaged");
  EXPECT_EQ(message_of([&] { read_surface(SourceFile("a.gz", whole + "more")); }),
            "\"a.gz\" has 4 bytes after its packed data; the file is damaged");
  EXPECT_NE(message_of([&] { read_surface(SourceFile("a.gz", gzipped(whole))); }).find("packed with gzip"),
            std::string::npos);
  EXPECT_NE(message_of([&] { read_surface(SourceFile("a.gz", gzipped(""))); }).find("is empty"),
            std::string::npos);
}

TEST(Gzip, WhatComesOutIsBounded) {
  const std::string zeros = gzipped(std::string(std::size_t{17} << 20, '0'));
  const SourceFile file("a.txt.gz", zeros);
  EXPECT_EQ(most_of_gzip(file), std::uint64_t{16} << 20);
  const std::string message = message_of([&] { read_surface(file); });
  EXPECT_NE(message.find("\"a.txt.gz\" unpacks to more than 16 MiB out of "), std::string::npos) << message;
  EXPECT_NE(message_of([&] { read_profile(file); }).find("unpacks to more than"), std::string::npos);
  const SourceFile just("a.gz", gzipped(std::string(std::size_t{16} << 20, '0')));
  EXPECT_EQ(inside_gzip(just, Monitor::silent())->bytes().size(), std::size_t{16} << 20);
}

TEST(Gzip, DamageIsAnErrorOrAnotherSurface) {
  testing::damage(gzipped(matrix), 19, 2000,
                  [](const std::string& bytes) { read_surface(SourceFile("map.txt.gz", bytes)); });
}

}  // namespace
}  // namespace asperity::deflated_test
