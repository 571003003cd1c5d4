// SPDX-License-Identifier: GPL-3.0-or-later
// Files that this program writes, whole and damaged. That other programs read them is tested in
// tests/scripts.
#include "engine/surface/io/hdf5_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "engine/core/error.hpp"
#include "engine/surface/io/source_file.hpp"
#include "tests/surface/files.hpp"

namespace asperity {
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

// What was written, or an error: never something else, and no crash.
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
  // Room that the format leaves between its structures may change unseen; what says something may not.
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

std::string refusal(const Hdf5Content& content, const std::string& path = "never.h5") {
  try {
    write_hdf5(path, content);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(Hdf5File, NamesAndShapesAreChecked) {
  const auto one = [](const std::string& name) { return owning_array<double>(name, {1}, {1}); };
  for (const char* const name : {"", "/a", "a/", "a//b", "a/../b", "."})
    EXPECT_EQ(refusal({{}, {one(name)}}),
              "`" + std::string(name) +
                  "` cannot be a name in an HDF5 file; parts between `/` are neither empty "
                  "nor `.` nor `..`");
  EXPECT_EQ(
      refusal({{}, {one("a"), one("a/b")}}),
      "`a` stands twice among what an HDF5 file shall hold; each array, group and text has its own name");
  EXPECT_EQ(refusal({{}, {owning_array<double>("a", {2, 2}, {1})}}),
            "the shape of `a` holds 4 numbers and there are 1");
  EXPECT_EQ(refusal({{{"t", std::string(70000, 'x')}}, {}}),
            "the text `t` has 70000 bytes, more than an attribute of an HDF5 file holds; keep it as an array "
            "of bytes");
}

TEST_F(Hdf5File, NothingIsLeftWhereItCannotBeWritten) {
  EXPECT_EQ(refusal({}, folder_.path("no/such/a.h5")),
            "there is no directory \"" + folder_.path("no/such") + "\" to write in; make it first");
  std::filesystem::create_directory(folder_.path("taken.h5"));
  EXPECT_NE(refusal({}, folder_.path("taken.h5")).find("is a directory"), std::string::npos);
}

}  // namespace
}  // namespace asperity
