// SPDX-License-Identifier: GPL-3.0-or-later
// A zip archive in memory, read in pieces, with MD5. An entry of any other size than the caller's is an
// error: the directory may be wrong. Wraps libzip and libmd.
#pragma once

#include <md5.h>
#include <zip.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

// Detects damage, not forgery.
class Md5 {
 public:
  Md5() { MD5Init(&context_); }
  void add(std::span<const char> bytes);
  // 32 lower-case hexadecimal digits. Call once.
  std::string hex();

 private:
  MD5_CTX context_;
};

class Archive {
 public:
  // `file` must outlive the archive. Throws Error{bad_file} if the archive is incomplete.
  explicit Archive(const SourceFile& file);

  // -1 if missing. Ignores case, a leading "./" or "/" and the kind of slash.
  std::int64_t find(std::string_view name) const;
  // With its slash; empty if the entry is at the top, missing or ambiguous.
  std::string folder_of(std::string_view name) const;
  // For errors: `the entry "main.xml"`.
  std::string entry_text(std::int64_t index) const;
  // Unpacked bytes, from the directory. Throws Error{bad_file} for an impossible ratio or unknown method.
  std::uint64_t claimed_size(std::int64_t index) const;
  // Throws Error{bad_file} above `limit` bytes.
  Array<char> contents(std::int64_t index, std::uint64_t limit) const;

 private:
  friend class ArchiveEntry;
  const SourceFile& file_;
  std::unique_ptr<zip_t, void (*)(zip_t*)> zip_;
  std::vector<std::string> names_;  // lower case, without a leading slash
};

class ArchiveEntry {
 public:
  ArchiveEntry(const Archive& archive, std::int64_t index);
  // Throws Error{bad_file} if the entry is too short or damaged.
  void read(std::span<char> bytes);
  // Throws Error{bad_file} for surplus bytes or a wrong checksum.
  void expect_end();
  Md5& md5() { return md5_; }

 private:
  [[noreturn]] void refuse(const std::string& finding) const;

  const Archive& archive_;
  const std::int64_t index_;
  std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> handle_;
  Md5 md5_;
};

}  // namespace asperity
