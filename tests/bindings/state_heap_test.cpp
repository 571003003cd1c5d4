// SPDX-License-Identifier: GPL-3.0-or-later
// Small blocks of a Lua state come from one region and are reused; others are counted by the byte; a limit
// covers both.
#include "bindings/lua/runtime/state_heap.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <vector>

#include "engine/core/memory.hpp"
#include "engine/core/sanitizers.hpp"
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::state_heap_test {
namespace {

struct Region {
  alignas(SmallBlocks::step) std::byte bytes[1024];
  SmallBlocks blocks{bytes, sizeof bytes};
};

TEST(SmallBlocks, AreApartAlignedAndOfTheRegion) {
  Region region;
  std::set<void*> seen;
  for (void* block; (block = region.blocks.take(24)) != nullptr;) {
    EXPECT_TRUE(region.blocks.holds(block));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % SmallBlocks::step, 0u);
    std::memset(block, 1, 24);
    EXPECT_TRUE(seen.insert(block).second);
  }
  EXPECT_EQ(seen.size(), sizeof region.bytes / 32);  // two steps each
}

TEST(SmallBlocks, OneThatIsGivenBackServesItsClassAlone) {
  Region region;
  void* const first = region.blocks.take(40);
  ASSERT_NE(region.blocks.take(40), nullptr);
  region.blocks.give(first, 40);
  EXPECT_NE(region.blocks.take(49), first);  // four steps, not three
  EXPECT_EQ(region.blocks.take(33), first);
}

TEST(SmallBlocks, TheLongestIsTakenOneByteMoreIsNot) {
  Region region;
  EXPECT_EQ(region.blocks.take(SmallBlocks::longest + 1), nullptr);
  EXPECT_NE(region.blocks.take(SmallBlocks::longest), nullptr);
  EXPECT_EQ(region.blocks.take(0), nullptr);
}

TEST(SmallBlocks, OfNoRegionHaveNoRoom) {
  SmallBlocks blocks(nullptr, 0);
  EXPECT_EQ(blocks.take(16), nullptr);
  EXPECT_FALSE(blocks.holds(nullptr));
  EXPECT_FALSE(blocks.holds(&blocks));
}

TEST(SmallBlocks, TheBytesBesideTheRegionAreNotOfIt) {
  alignas(16) std::byte bytes[1024];
  const SmallBlocks blocks(bytes + 16, sizeof bytes - 32);
  EXPECT_TRUE(blocks.holds(bytes + 16));
  EXPECT_TRUE(blocks.holds(bytes + sizeof bytes - 17));
  EXPECT_FALSE(blocks.holds(bytes + sizeof bytes - 16));
  EXPECT_FALSE(blocks.holds(bytes + 15));
}

class Heap : public testing::Test {
 protected:
  void TearDown() override { memory::set_limit(0); }
  void* change(void* block, std::size_t from, std::size_t to) {
    return StateHeap::allocate(&heap, block, from, to);
  }
  static char filled(std::size_t k) { return static_cast<char>('a' + k % 26); }

  const std::int64_t before = memory::held();
  StateHeap heap;
};

TEST_F(Heap, ABlockKeepsItsBytesFromTheRegionIntoTheOpenAndBack) {
  constexpr std::size_t sizes[] = {8, 16, 17, 500, 512, 513, 100000, 600, 512, 64, 63, 1};
  auto* block = static_cast<char*>(change(nullptr, 0, sizes[0]));
  std::size_t size = sizes[0], sound = 0;  // bytes that must be unchanged
  for (const std::size_t next : sizes) {
    block = static_cast<char*>(change(block, size, next));
    ASSERT_NE(block, nullptr);
    sound = std::min(sound, next);
    for (std::size_t k = 0; k < sound; ++k) ASSERT_EQ(block[k], filled(k)) << next << " at " << k;
    for (std::size_t k = 0; k < next; ++k) block[k] = filled(k);
    size = sound = next;
  }
  EXPECT_EQ(change(block, size, 0), nullptr);
}

TEST_F(Heap, WhatTheRegionHasNoRoomForIsCountedByTheByte) {
  std::vector<void*> blocks;
  const std::int64_t region = memory::held() - before;
  EXPECT_EQ(region, sanitized ? 0 : static_cast<std::int64_t>(StateHeap::region_bytes));
  const std::size_t inside = static_cast<std::size_t>(region) / 512;
  for (std::size_t k = 0; k < inside + 3; ++k) blocks.push_back(change(nullptr, 0, 512));
  EXPECT_EQ(memory::held() - before, region + 3 * 512);
  void* const grown = change(blocks.front(), 512, 2000);  // may leave the region
  EXPECT_EQ(memory::held() - before, region + 3 * 512 + 2000 - (sanitized ? 512 : 0));
  change(grown, 2000, 0);
  for (std::size_t k = 1; k < blocks.size(); ++k) change(blocks[k], 512, 0);
  EXPECT_EQ(memory::held() - before, region);
}

TEST_F(Heap, ALimitIsForWhatIsOutsideTheRegion) {
  void* const small = change(nullptr, 0, 100);
  memory::set_limit(memory::held() + 1000);
  EXPECT_EQ(change(small, 100, 1101), nullptr);
  EXPECT_TRUE(memory_limit_met());
  void* const grown = change(small, 100, 901);  // a new size: the refused request was final
  EXPECT_NE(grown, nullptr);
  EXPECT_TRUE(memory::exceeded());
  change(grown, 901, 0);
}

TEST_F(Heap, TheSameRequestThatIsGrantedTheSecondTimeMeetsNoLimit) {
  void* const large = change(nullptr, 0, 5000);
  memory::set_limit(memory::held() + 1000);
  EXPECT_EQ(change(nullptr, 0, 2000), nullptr);
  change(large, 5000, 0);  // as Lua's collector does
  void* const granted = change(nullptr, 0, 2000);
  EXPECT_NE(granted, nullptr);
  EXPECT_FALSE(memory::exceeded());
  change(granted, 2000, 0);
}

TEST(StateHeap, WithoutRoomForItsRegionDoesWithout) {
  const std::int64_t before = memory::held();
  memory::set_limit(before + 1000);
  {
    StateHeap heap;
    EXPECT_EQ(memory::held(), before);
    void* const block = StateHeap::allocate(&heap, nullptr, 0, 100);
    EXPECT_NE(block, nullptr);
    EXPECT_EQ(memory::held(), before + 100);
    StateHeap::allocate(&heap, block, 100, 0);
  }
  memory::set_limit(0);
  EXPECT_EQ(memory::held(), before);
}

class StateMemory : public LuaTest {};

TEST_F(StateMemory, ManySmallObjectsMeetTheLimitAndLeaveNothing) {
  const std::int64_t before = memory::held();
  memory::set_limit(before + (std::int64_t{2} << 20));
  EXPECT_NE(run("local t = {} for k = 1, 1e6 do t[k] = { k } end").find("not enough memory"),
            std::string::npos);
  memory::set_limit(0);
  EXPECT_EQ(run("local t = {} for k = 1, 1e4 do t[k] = { k } end for k = 1, 1e4 do assert(t[k][1] == k) end"),
            "");
  state.reset();
  EXPECT_LE(memory::held(), before);
}

// Few bytes of a fresh state are outside the region.
TEST_F(StateMemory, AFreshStateIsForTheMostPartInItsRegion) {
  if (sanitized) GTEST_SKIP() << "a sanitizer sees every block: there is no region";
  state.reset();
  const std::int64_t before = memory::held();
  state = make_state(session, "");
  const std::int64_t outside = memory::held() - before - static_cast<std::int64_t>(StateHeap::region_bytes);
  const std::int64_t all =
      (std::int64_t{lua_gc(state.get(), LUA_GCCOUNT)} << 10) + lua_gc(state.get(), LUA_GCCOUNTB);
  EXPECT_LT(outside, 24 << 10);
  EXPECT_GT(all - outside, outside) << all << " bytes in all";
  EXPECT_LE(all - outside, static_cast<std::int64_t>(StateHeap::region_bytes));
}

// A new state starts as after a full collection.
TEST_F(StateMemory, TheFirstCollectionWaitsUntilThereIsTwiceAsMuch) {
  EXPECT_EQ(run("local gone = false\n"
                "do setmetatable({}, { __gc=function() gone = true end }) end\n"
                "local begun = collectgarbage 'count'\n"
                "while collectgarbage 'count' < 1.5 * begun do local _ = {} end\n"
                "assert(not gone)\n"
                "while collectgarbage 'count' < 8 * begun and not gone do local _ = {} end\n"
                "assert(gone)"),
            "");
}

}  // namespace
}  // namespace asperity::lua::state_heap_test
