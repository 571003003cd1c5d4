// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/memory.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#endif
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <limits>
#include <string>

#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/sanitizers.hpp"
#include "engine/core/text.hpp"

namespace asperity::memory {

namespace {
std::atomic<std::int64_t> held_bytes{0};
std::atomic<std::int64_t> limit_bytes{0};
std::atomic<bool> limit_exceeded{false};

constexpr std::size_t alignment = 64;
constexpr std::size_t huge_page = std::size_t{2} << 20;
constexpr double mebibyte = 1024.0 * 1024.0;

// Sized for a solve on 1024². Empty under a sanitizer, which must detect use after release. Never destroyed,
// because static arrays are released last.
BlockPool& kept() {
  static BlockPool& blocks = *new BlockPool(sanitized ? 0 : std::size_t{128} << 20);
  return blocks;
}

// 4 KiB pages need a page-table walk for nearly every row of a column.
void ask_for_huge_pages([[maybe_unused]] void* pointer, [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
  madvise(pointer, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
}

std::size_t boundary_of(std::size_t bytes) { return bytes >= huge_page ? huge_page : alignment; }
std::size_t rounded_up(std::size_t bytes) {
  const std::size_t boundary = boundary_of(bytes);
  return (bytes + boundary - 1) / boundary * boundary;
}

[[noreturn]] void refuse(std::size_t bytes) {
  const std::int64_t cap = limit_bytes.load();
  std::string sentence = "out of memory: requested " +
                         format_short(static_cast<double>(bytes) / mebibyte, 4) + " MiB with " +
                         format_short(static_cast<double>(held_bytes.load()) / mebibyte, 4) + " MiB in use";
  if (cap > 0) sentence += " of a limit of " + format_short(static_cast<double>(cap) / mebibyte, 4) + " MiB";
  throw Error(ErrorCode::out_of_memory, sentence, "give fewer `cells`, or raise `--limit-memory`");
}
}  // namespace

std::int64_t of_machine() {
#if defined(__EMSCRIPTEN__)
  return std::int64_t{4} << 30;  // sysconf reports the present size of the heap
#else
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? static_cast<std::int64_t>(pages) * page : std::int64_t{4} << 30;
#endif
}

std::int64_t held() { return held_bytes.load(); }
void set_limit(std::int64_t bytes) {
  limit_bytes.store(bytes);
  limit_exceeded.store(false);
}
void note_exceeded() noexcept {
  if (limit_bytes.load() > 0) limit_exceeded.store(true);
}
bool exceeded() noexcept { return limit_exceeded.load(); }
std::int64_t limit() { return limit_bytes.load(); }

bool account(std::int64_t change) noexcept {
  const std::int64_t now = held_bytes.fetch_add(change) + change;
  const std::int64_t cap = limit_bytes.load();
  if (change > 0 && cap > 0 && now > cap) {
    held_bytes.fetch_sub(change);
    return false;
  }
  return true;
}

void* acquire(std::size_t bytes) {
  constexpr std::size_t largest = std::size_t{1} << (std::numeric_limits<std::size_t>::digits - 2);
  if (bytes > largest) refuse(bytes);
  const std::size_t boundary = boundary_of(bytes), rounded = rounded_up(bytes);
  if (!account(static_cast<std::int64_t>(bytes))) refuse(bytes);
  void* pointer = kept().take(rounded);
  if (pointer == nullptr) {
    const auto fresh = [&] { return std::aligned_alloc(boundary, rounded == 0 ? boundary : rounded); };
    pointer = fresh();
    if (pointer == nullptr) {
      kept().drop();
      pointer = fresh();
    }
    if (pointer == nullptr) {
      account(-static_cast<std::int64_t>(bytes));
      refuse(bytes);
    }
    if (boundary == huge_page) ask_for_huge_pages(pointer, bytes);
  }
  cost::count_bytes(static_cast<std::int64_t>(bytes));
  return pointer;
}

void release(void* pointer, std::size_t bytes) noexcept {
  if (pointer == nullptr) return;
  if (!kept().give(pointer, rounded_up(bytes))) std::free(pointer);
  account(-static_cast<std::int64_t>(bytes));
  cost::count_bytes(-static_cast<std::int64_t>(bytes));
}

void* BlockPool::take(std::size_t bytes) {
  if (!takes(bytes)) return nullptr;
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(blocks_.rbegin(), blocks_.rend(),
                                  [bytes](const Block& block) { return block.bytes == bytes; });
  if (found == blocks_.rend()) return nullptr;
  void* const block = found->at;
  blocks_.erase(std::next(found).base());
  bytes_ -= bytes;
  return block;
}

bool BlockPool::give(void* block, std::size_t bytes) noexcept {
  if (!takes(bytes)) return false;
  const std::lock_guard lock(mutex_);
  try {
    blocks_.push_back({block, bytes});
  } catch (const std::bad_alloc&) {
    return false;
  }
  bytes_ += bytes;
  while (bytes_ > most_bytes_ || blocks_.size() > most_blocks) drop_oldest();
  return true;
}

void BlockPool::drop() noexcept {
  const std::lock_guard lock(mutex_);
  while (!blocks_.empty()) drop_oldest();
}

std::size_t BlockPool::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

void BlockPool::drop_oldest() noexcept {
  std::free(blocks_.front().at);
  bytes_ -= blocks_.front().bytes;
  blocks_.pop_front();
}

}  // namespace asperity::memory
