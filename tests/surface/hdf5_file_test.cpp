// SPDX-License-Identifier: GPL-3.0-or-later
// Files of this program; tests/scripts checks other readers.
#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "engine/core/error.hpp"
#include "engine/core/files/source_file.hpp"
#include "tests/support/refusal.hpp"
#include "tests/surface/files.hpp"

namespace asperity::hdf5_file_test {
namespace {

using testing::Scratch;

Hdf5Content example() {
  Hdf5Content content;
  content.texts = {{"title", "a föhn"}, {"empty", ""}, {"long", std::string(50000, 'x')}};
  content.arrays.push_back(
      owning_array<double>("pressure", {2, 3}, {1, -0.0, 5e-324, 1e308, NAN, 0.1}, "Pa"));
  content.arrays.push_back(owning_array<std::int64_t>(
      "bodies/lower/spots", {2},
      {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}));
  content.arrays.push_back(owning_array<std::uint8_t>("bodies/upper/contact", {1, 2, 2}, {0, 1, 255, 7}));
  content.arrays.push_back(owning_array<double>("load", {}, {3.5}, "N"));
  content.numbers = {{"load", 2.5}, {"area", -0.0}};
  content.arrays.push_back(owning_array<double>("nothing", {0, 4}, {}));
  return content;
}

std::string raw_of(const Hdf5Array& array) {
  return std::visit(
      [](const auto& s) { return std::string(reinterpret_cast<const char*>(s.data()), s.size_bytes()); },
      array.values);
}

void expect_same(const Hdf5Content& found, const Hdf5Content& wanted) {
  EXPECT_TRUE(found.unread.empty());
  EXPECT_EQ(found.texts.size(), wanted.texts.size());
  for (const auto& [name, text] : wanted.texts) {
    ASSERT_NE(found.text(name), nullptr) << name;
    EXPECT_EQ(*found.text(name), text);
  }
  EXPECT_EQ(found.numbers, wanted.numbers);
  EXPECT_EQ(found.arrays.size(), wanted.arrays.size());
  for (const Hdf5Array& array : wanted.arrays) {
    const Hdf5Array* const there = found.array(array.name);
    ASSERT_NE(there, nullptr) << array.name;
    EXPECT_EQ(there->shape, array.shape);
    EXPECT_EQ(there->unit, array.unit);
    EXPECT_EQ(there->values.index(), array.values.index());
    EXPECT_EQ(raw_of(*there), raw_of(array)) << array.name;
  }
}

class Hdf5File : public ::testing::Test {
 protected:
  Scratch folder_;
  std::string written(const Hdf5Content& content, const std::string& name = "a.h5") {
    const std::string path = folder_.path(name);
    write_hdf5(path, content);
    return testing::bytes_of(path);
  }
};

TEST_F(Hdf5File, ReadsBackBitForBit) {
  const Hdf5Content content = example();
  const std::string bytes = written(content);
  expect_same(read_hdf5(folder_.path("a.h5")), content);
}

TEST_F(Hdf5File, SameContentGivesTheSameBytes) { EXPECT_EQ(written(example()), written(example(), "b.h5")); }

TEST_F(Hdf5File, ManyMembersAndTextsAreRead) {
  Hdf5Content content;
  for (int k = 0; k < 1000; ++k) {
    content.texts.emplace_back("text " + std::to_string(k), std::to_string(k * k));
    content.arrays.push_back(owning_array<double>("group/" + std::to_string(k % 7) + "/" + std::to_string(k),
                                                  {1}, {static_cast<double>(k)}));
  }
  const std::string bytes = written(content);
  expect_same(read_hdf5(folder_.path("a.h5")), content);
}

TEST_F(Hdf5File, EmptyContentIsAFile) {
  const std::string bytes = written({});
  expect_same(read_hdf5(folder_.path("a.h5")), {});
}

// The written content or an error.
void expect_told(const std::string& bytes, const Hdf5Content& whole, const std::string& how, int& errors) {
  try {
    const Hdf5Content found = read_hdf5(SourceFile("damaged.h5", bytes));
    SCOPED_TRACE(how);
    expect_same(found, whole);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_file) << how << ": " << error.what();
    ++errors;
  }
}

TEST_F(Hdf5File, CutAnywhereIsAnError) {
  const Hdf5Content content = example();
  const std::string bytes = written(content);
  for (std::size_t length = 1; length < bytes.size(); length += length < 4096 ? 1 : 97) {
    SCOPED_TRACE(length);
    EXPECT_THROW(read_hdf5(SourceFile("cut.h5", std::string_view(bytes).substr(0, length))), Error);
  }
}

TEST_F(Hdf5File, FlippedBitIsAnErrorOrMeansNothing) {
  Hdf5Content content = example();
  content.texts.pop_back();
  const std::string bytes = written(content);
  int errors = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (const int bit : {0, 5, 7}) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      expect_told(damaged, content, "bit " + std::to_string(bit) + " of byte " + std::to_string(at), errors);
    }
  // Only unused bytes between structures may change unnoticed.
  EXPECT_GT(errors, static_cast<int>(bytes.size()) / 2);
}

TEST_F(Hdf5File, ChangedNumbersAreTold) {
  const Hdf5Content content = example();
  std::string bytes = written(content);
  const std::string number = raw_of(*content.array("pressure")).substr(5 * 8);
  const std::size_t at = bytes.find(number);
  ASSERT_NE(at, std::string::npos);
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  try {
    read_hdf5(SourceFile("a.h5", bytes));
    FAIL() << "read";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "\"a.h5\" is damaged: the numbers of `pressure` do not have the digest that they were written "
              "with; the "
              "file was altered after it was written");
  }
}

// Written by h5py, from the fuzzing corpus.
Hdf5Content sample_content(const std::string& name) {
  return read_hdf5(std::string(ASPERITY_TEST_DATA) + "/../fuzz/corpus/hdf5/" + name + ".h5");
}

TEST_F(Hdf5File, FilesOfOtherProgramsAreRead) {
  const std::vector<double> wanted{0, 1, 2, 3, 4, 5, -6, 7.5, 8, 9, 10, 11};
  for (const char* const name : {"contiguous", "compact", "deflated", "shuffled", "checked", "every_filter",
                                 "big_endian", "new_headers", "user_block", "attributes"}) {
    SCOPED_TRACE(name);
    const Hdf5Content content = sample_content(name);
    const Hdf5Array* const height = content.array("height");
    ASSERT_NE(height, nullptr);
    EXPECT_EQ(height->shape, (std::vector<std::size_t>{3, 4}));
    const auto values = std::get<std::span<const double>>(height->values);
    for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_EQ(values[k], wanted[k] * 1e-6);
    EXPECT_EQ(height->unit, std::string(name) == "compact" ? "" : "m");
  }
  const Hdf5Content attributes = sample_content("attributes");
  EXPECT_EQ(*attributes.text("title"), "a text");
  EXPECT_EQ(*attributes.number("n"), -3);
  EXPECT_EQ(*attributes.number("b"), 1.5);
}

TEST_F(Hdf5File, NumbersOfOtherTypesKeepTheirValues) {
  const auto as_float = sample_content("floats");
  const auto floats = std::get<std::span<const double>>(as_float.array("height")->values);
  EXPECT_EQ(floats[7], static_cast<double>(7.5e-6F));
  const auto as_integer = sample_content("integers_big_endian");
  EXPECT_EQ(std::get<std::span<const std::int64_t>>(as_integer.array("height")->values)[6], -6);
  const auto as_byte = sample_content("bytes");
  EXPECT_EQ(std::get<std::span<const std::uint8_t>>(as_byte.array("height")->values)[11], 11);
  const auto past = sample_content("past_int64");
  EXPECT_EQ(std::get<std::span<const double>>(past.array("height")->values)[1], std::ldexp(1.0, 63));
  const auto cube = sample_content("cube");
  const auto all = std::get<std::span<const std::int64_t>>(cube.array("t")->values);
  for (std::size_t k = 0; k < 24; ++k) EXPECT_EQ(all[k], static_cast<std::int64_t>(k));
}

TEST_F(Hdf5File, WhatIsNotReadIsNamed) {
  const Hdf5Content groups = sample_content("groups");
  EXPECT_NE(groups.array("a/b/height"), nullptr);
  const auto truth = std::get<std::span<const std::uint8_t>>(groups.array("truth")->values);
  EXPECT_EQ(truth[0], 1);
  EXPECT_EQ(truth[1], 0);
  EXPECT_EQ(groups.unread, (std::vector<std::string>{"`a/c`: another name of something read already",
                                                     "`pair`: compound values",
                                                     "`unwritten`: numbers that were never written"}));
  EXPECT_EQ(sample_content("lzf").unread,
            (std::vector<std::string>{
                "`height`: numbers compressed by the filter 32000 (deflate and shuffle are read)"}));
  EXPECT_EQ(
      sample_content("new_chunks").unread,
      (std::vector<std::string>{
          "`height`: numbers in a layout that is not known (h5repack --layout=CONTI writes one that is)"}));
}

TEST_F(Hdf5File, LiesOfOtherFilesAreErrors) {
  for (const char* const name : {"claims_1e6_by_1e6", "claims_2_to_80", "cut", "magic_only",
                                 "too_many_members", "tree_in_itself", "wrong_tree"}) {
    SCOPED_TRACE(name);
    const auto error = testing::error_of([&] { sample_content(name); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ErrorCode::bad_file);
  }
}

TEST_F(Hdf5File, DamagedFilesOfOtherProgramsCrashNothing) {
  for (const char* const name : {"attributes", "every_filter", "groups", "cube", "compact", "new_headers"})
    testing::damage(
        testing::bytes_of(std::string(ASPERITY_TEST_DATA) + "/../fuzz/corpus/hdf5/" + name + ".h5"), 61, 2000,
        [](const std::string& bytes) { read_hdf5(SourceFile("a.h5", bytes)); });
}

std::string refusal(const Hdf5Content& content, const std::string& path = "never.h5") {
  return test::error_of([&] { write_hdf5(path, content); }, "no error");
}

TEST_F(Hdf5File, NamesAndShapesAreChecked) {
  const auto one = [](const std::string& name) { return owning_array<double>(name, {1}, {1}); };
  for (const char* const name : {"", "/a", "a/", "a//b", "a/../b", "."})
    EXPECT_EQ(refusal({{}, {one(name)}}),
              "`" + std::string(name) +
                  "` cannot be a name in an HDF5 file; parts between `/` are neither empty "
                  "nor `.` nor `..`");
  EXPECT_EQ(refusal({{}, {one("a"), one("a/b")}}),
            "`a` is given twice for one HDF5 file; give each array, group and text its own name");
  EXPECT_EQ(refusal({{}, {owning_array<double>("a", {2, 2}, {1})}}),
            "the shape of `a` holds 4 numbers and there are 1");
  EXPECT_EQ(refusal({{{"t", std::string(70000, 'x')}}, {}}),
            "the text `t` has 70000 bytes, more than an attribute of an HDF5 file holds; store it as an "
            "array of bytes");
}

TEST_F(Hdf5File, NothingIsLeftWhereItCannotBeWritten) {
  EXPECT_EQ(refusal({}, folder_.path("no/such/a.h5")),
            "there is no directory \"" + folder_.path("no/such") + "\" to write in; make it first");
  std::filesystem::create_directory(folder_.path("taken.h5"));
  EXPECT_NE(refusal({}, folder_.path("taken.h5")).find("is a directory"), std::string::npos);
}

}  // namespace
}  // namespace asperity::hdf5_file_test
