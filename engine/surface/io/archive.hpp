// SPDX-License-Identifier: GPL-3.0-or-later
// A zip archive held in memory, read entry by entry in pieces, with the MD5 of what was read. Sizes
// that a directory claims are not believed: a caller states how much it wants, and an entry that
// holds more or less is an error. Wraps libzip and libmd.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/files/source_file.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

// MD5 of a stream of bytes; a check against damage, not against forgery.
class Md5 {
 public:
  Md5();
  ~Md5();
  Md5(const Md5&) = delete;
  Md5& operator=(const Md5&) = delete;
  void add(std::span<const char> bytes);
  // 32 lower-case hexadecimal digits; once.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

class Archive {
 public:
  // `file` must outlive the archive. Throws Error{bad_file} if it is not a whole zip archive.
  explicit Archive(const SourceFile& file);
  ~Archive();
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  // Position of an entry; a leading "./" or "/", backslashes and the case of letters do not count.
  // -1 if there is none.
  std::int64_t find(std::string_view name) const;
  // The folder, with its stroke, in which the one entry called so lies; empty where it lies at the top,
  // nowhere, or in several folders.
  std::string folder_of(std::string_view name) const;
  // As the directory has it, for errors: `the entry "main.xml"`.
  std::string entry_text(std::int64_t index) const;
  // Bytes of entry `index` unpacked, as the directory says. Throws Error{bad_file} when no packing
  // could have made so much of so little, or the packing is neither stored nor deflated.
  std::uint64_t claimed_size(std::int64_t index) const;
  // The whole of a small entry, at most `limit` bytes.
  Array<char> contents(std::int64_t index, std::uint64_t limit) const;

 private:
  friend class ArchiveEntry;
  struct State;
  const SourceFile& file_;
  std::unique_ptr<State> state_;
};

// One entry being read from its beginning.
class ArchiveEntry {
 public:
  ArchiveEntry(const Archive& archive, std::int64_t index);
  ~ArchiveEntry();
  ArchiveEntry(const ArchiveEntry&) = delete;
  ArchiveEntry& operator=(const ArchiveEntry&) = delete;
  // Fills `bytes` wholly. Throws Error{bad_file} if the entry ends before or is damaged.
  void read(std::span<char> bytes);
  // Throws Error{bad_file} if anything is left, or if the entry's checksum is not that of the bytes.
  void expect_end();
  Md5& md5() { return md5_; }

 private:
  [[noreturn]] void refuse(const std::string& finding) const;

  const Archive& archive_;
  const std::int64_t index_;
  struct Handle;
  std::unique_ptr<Handle> handle_;
  Md5 md5_;
};

}  // namespace asperity
