// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "engine/core/memory.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"

namespace asperity::npy_test {
namespace {

using testing::little;
using testing::measured;
using testing::message_of;
using testing::raw;
using testing::sample;
using testing::Scratch;

std::string npy(const std::string& descr, const std::string& shape, const std::string& data,
                bool fortran = false, int version = 1) {
  const std::string header = "{'descr': '" + descr + "', 'fortran_order': " + (fortran ? "True" : "False") +
                             ", 'shape': " + shape + ", }          \n";
  return std::string("\x93NUMPY") + static_cast<char>(version) + '\0' +
         little(header.size(), version == 1 ? 2 : 4) + header + data;
}

ReadOptions bare() {
  ReadOptions options;
  options.size_x = options.size_y = options.unit = 1;
  return options;
}

template <class T>
std::string swapped(std::vector<T> values) {
  std::string bytes = raw(values);
  for (std::size_t k = 0; k < bytes.size(); k += sizeof(T))
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(k),
                 bytes.begin() + static_cast<std::ptrdiff_t>(k + sizeof(T)));
  return bytes;
}

TEST(Npy, ElementTypesOrdersAndVersions) {
  const Scratch scratch;
  const std::vector<std::string> files{
      npy("<f8", "(2, 3)", raw(std::vector<double>{0, 1, 2, 3, 4, 5})),
      npy("<f4", "(2, 3)", raw(std::vector<float>{0, 1, 2, 3, 4, 5})),
      npy(">f4", "(2, 3)", swapped(std::vector<float>{0, 1, 2, 3, 4, 5})),
      npy(">f8", "(2,3)", swapped(std::vector<double>{0, 1, 2, 3, 4, 5})),
      npy("|i1", "(2, 3)", raw(std::vector<std::int8_t>{0, 1, 2, 3, 4, 5})),
      npy("<i2", "(2, 3)", raw(std::vector<std::int16_t>{0, 1, 2, 3, 4, 5})),
      npy(">i4", "(2, 3)", swapped(std::vector<std::int32_t>{0, 1, 2, 3, 4, 5})),
      npy("<i8", "(2, 3)", raw(std::vector<std::int64_t>{0, 1, 2, 3, 4, 5})),
      npy("|u1", "(2, 3)", raw(std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5})),
      npy("<u2", "(2, 3)", raw(std::vector<std::uint16_t>{0, 1, 2, 3, 4, 5})),
      npy("<u4", "(2, 3)", raw(std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5})),
      npy("<u8", "(2, 3)", raw(std::vector<std::uint64_t>{0, 1, 2, 3, 4, 5})),
      npy("<f8", "(2, 3)", raw(std::vector<double>{0, 3, 1, 4, 2, 5}), true),
      npy("<f8", "(2, 3)", raw(std::vector<double>{0, 1, 2, 3, 4, 5}), false, 2),
      npy("<f8", "(2, 3)", raw(std::vector<double>{0, 1, 2, 3, 4, 5}), false, 3),
      testing::bytes_of(sample("ramp.npy")),
  };
  for (std::size_t k = 0; k < files.size(); ++k) {
    const Surface surface = read_surface(scratch.write("a.npy", files[k]), bare());
    ASSERT_EQ(surface.grid().nx, 3) << k;
    ASSERT_EQ(surface.grid().ny, 2) << k;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i) EXPECT_EQ(surface.height(i, j), i + 3 * j) << k;
  }
  EXPECT_EQ(read_surface(scratch.write("s.npy", npy("|i1", "(1, 1)", "\xFE")), bare()).height(0, 0), -2);
}

TEST(Npy, OneDimensionIsATrace) {
  const Scratch scratch;
  const std::string path = scratch.write("t.npy", npy("<f8", "(3,)", raw(std::vector<double>{1, 2, 3})));
  ReadOptions options;
  options.size_x = 3e-6;
  options.unit = 1e-9;
  const Surface row = read_surface(path, options);
  EXPECT_EQ(row.grid().ny, 1);
  EXPECT_DOUBLE_EQ(row.grid().size_y, 1e-6);
  ReadProfileOptions profile;
  profile.spacing = 1e-6;
  profile.unit = 1e-9;
  EXPECT_DOUBLE_EQ(read_profile(path, profile).heights()[2], 3e-9);
}

TEST(Npy, ShapeThatTheFileCannotHoldIsRefusedBeforeAllocating) {
  const Scratch scratch;
  for (const char* shape :
       {"(60000, 60000)", "(2, 4)", "(4294967296, 4294967296)", "(999999999999999999, 2)", "(2, 2)"}) {
    const std::string path = scratch.write("lie.npy", npy("<f8", shape, std::string(48, '\0')));
    memory::set_limit(memory::held() + 100000);
    const std::string message = message_of([&] { read_surface(path, bare()); });
    memory::set_limit(0);
    EXPECT_NE(message.find("says in its header that it holds"), std::string::npos)
        << shape << ": " << message;
  }
}

TEST(Npy, WhatIsNotRead) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& bytes) {
    return message_of([&] { read_surface(scratch.write("b.npy", bytes), bare()); });
  };
  EXPECT_NE(refusal(npy("<c16", "(1, 1)", std::string(16, '\0'))).find("holds numbers of type \"<c16\""),
            std::string::npos);
  EXPECT_NE(refusal(npy("|O", "(1, 1)", "x")).find("holds numbers of type \"|O\""), std::string::npos);
  EXPECT_NE(refusal(npy("<f8", "(1, 1, 1)", std::string(8, '\0'))).find("an array of 3 dimensions"),
            std::string::npos);
  EXPECT_NE(refusal(npy("<f8", "()", std::string(8, '\0'))).find("an array of 0 dimensions"),
            std::string::npos);
  EXPECT_NE(refusal(npy("<f8", "(0, 3)", "")).find("without elements"), std::string::npos);
  EXPECT_NE(refusal(npy("<f8", "(-1, 3)", "")).find("no list of counts"), std::string::npos);
  EXPECT_NE(refusal(npy("<f8", "(1, 1)", "", false, 9)).find("NPY version 9"), std::string::npos);
  EXPECT_NE(refusal("\x93NUMPY").find("cut short in its NPY header"), std::string::npos);
  EXPECT_NE(refusal(npy("<f8", "(1, 2)", raw(std::vector<double>{1, INFINITY})))
                .find("an infinite height at node (1, 0)"),
            std::string::npos);
  EXPECT_NE(refusal(npy("<f8", "(1, 2)", raw(std::vector<double>{NAN, NAN}))).find("holds no height"),
            std::string::npos);
}

TEST(Npy, DamagedBytesGiveErrors) {
  const Scratch scratch;
  int read = 0;
  testing::damage(testing::bytes_of(sample("ramp.npy")), 5, 200, [&](const std::string& bytes) {
    read_surface(scratch.write("damaged.npy", bytes), bare());
    ++read;
  });
  EXPECT_GT(read, 0);
}

TEST(Npy, MeasuredFile) {
  if (measured("").empty()) GTEST_SKIP() << "ASPERITY_MEASURED is not set: no measured files here";
  const Surface surface = read_surface(measured("example-2d.npy"), bare());
  EXPECT_EQ(surface.height(0, 0), 0.1);
  EXPECT_EQ(surface.height(1, 0), 1);
  EXPECT_EQ(surface.height(0, 1), 4);
  EXPECT_EQ(surface.height(1, 1), 7);
}

}  // namespace
}  // namespace asperity::npy_test
