// SPDX-License-Identifier: GPL-3.0-or-later
// Least recently used results are dropped first; a store is the second level.
#include "engine/run/result_files.hpp"

#include <gtest/gtest.h>

#include "engine/core/memory.hpp"

namespace asperity::result_memory_test {
namespace {

Field filled(double value, int n = 16) {
  Field field(n, n);
  for (double& z : field.values()) z = value;
  return field;
}

void keep(ResultStore& store, const std::string& key, double value, int n = 16) {
  const Field field = filled(value, n);
  ResultFacts facts;
  facts.numbers = {{"x", value}};
  facts.texts = {{"t", key}};
  facts.cost.transforms = 3;
  facts.least_seconds = 1;
  store.keep(key, "test", facts, {{"f", &field}});
}

TEST(ResultMemory, GivesBackWhatWasKeptHoweverCheap) {
  ResultMemory memory(1 << 20);
  EXPECT_FALSE(memory.find("a"));
  keep(memory, "a", 0.1);
  auto found = memory.find("a");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->number("x"), 0.1);
  EXPECT_EQ(found->text("t"), "a");
  EXPECT_EQ(found->cost.transforms, 3);
  EXPECT_EQ(found->take("f")(15, 15), 0.1);
  EXPECT_EQ(memory.find("a")->take("f")(0, 0), 0.1);  // copied
  EXPECT_EQ(memory.counts().found, 2);
  EXPECT_EQ(memory.counts().missed, 1);
}

TEST(ResultMemory, DropsWhatWasUsedLongestAgo) {
  ResultMemory memory(3 * 2048 + 2048);  // three of 16 x 16 nodes, with overhead
  keep(memory, "a", 1);
  keep(memory, "b", 2);
  keep(memory, "c", 3);
  ASSERT_TRUE(memory.find("a"));
  keep(memory, "d", 4);
  EXPECT_TRUE(memory.find("a"));
  EXPECT_FALSE(memory.find("b"));
  EXPECT_TRUE(memory.find("c"));
  EXPECT_TRUE(memory.find("d"));
  EXPECT_EQ(memory.counts().dropped, 1);
  EXPECT_LE(memory.counts().bytes, 4 * 2048);
}

TEST(ResultMemory, WhatIsTooBigIsNotKeptAndDropsNothing) {
  ResultMemory memory(4096);
  keep(memory, "a", 1);
  keep(memory, "big", 2, 64);
  EXPECT_TRUE(memory.find("a"));
  EXPECT_FALSE(memory.find("big"));
  ResultMemory none(0);
  keep(none, "a", 1);
  EXPECT_FALSE(none.find("a"));
}

TEST(ResultMemory, KeptAgainTakesThePlaceOfWhatWas) {
  ResultMemory memory(1 << 20);
  keep(memory, "a", 1);
  const std::int64_t bytes = memory.counts().bytes;
  keep(memory, "a", 2);
  EXPECT_EQ(memory.find("a")->number("x"), 2);
  EXPECT_EQ(memory.counts().bytes, bytes);
}

TEST(ResultMemory, AsksAndGivesTheStoreBehind) {
  ResultMemory behind(1 << 20);
  keep(behind, "old", 1);
  ResultMemory memory(1 << 20, &behind);
  EXPECT_EQ(memory.find("old")->number("x"), 1);
  EXPECT_EQ(memory.find("old")->number("x"), 1);
  EXPECT_EQ(behind.counts().found, 1);
  keep(memory, "new", 2);
  EXPECT_TRUE(behind.find("new"));
  memory.clear();
  EXPECT_EQ(memory.find("new")->number("x"), 2);
}

TEST(ResultMemory, WhereMemoryIsShortItGivesUpItsOwn) {
  ResultMemory memory(std::int64_t{1} << 30);
  keep(memory, "a", 1, 128);
  const Field field = filled(2, 128);
  memory::set_limit(memory::held() + 1000);
  memory.keep("b", "test", {}, {{"f", &field}});
  memory::set_limit(0);
  EXPECT_FALSE(memory.find("b"));
  EXPECT_EQ(memory.counts().bytes, 0);
}

}  // namespace
}  // namespace asperity::result_memory_test
