// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of an HDF5 file, taken out one number after another and never past their end: what every reader
// of its structures stands on. Little-endian, with the widths of addresses and lengths that the file states.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/surface/io/source_file.hpp"

namespace asperity {

// A file in memory and how it counts.
struct Hdf5Bytes {
  const SourceFile& file;
  std::string_view bytes;  // from the base address on, to the end that the superblock states
  int address_width = 8, length_width = 8;

  // A piece of the file. Throws Error{bad_file} naming `what` unless it lies within.
  std::string_view piece(std::uint64_t at, std::uint64_t length, const char* what) const;
  [[noreturn]] void refuse(const std::string& finding, const std::string& hint = {}) const;
};

// Reads forward in a piece; every call throws Error{bad_file} naming `what` at its end.
class Hdf5Cursor {
 public:
  Hdf5Cursor(const Hdf5Bytes& file, std::string_view piece, const char* what)
      : file_(file), piece_(piece), what_(what) {}

  std::uint64_t number(int width);
  std::uint64_t address() { return number(file_.address_width); }
  std::uint64_t length() { return number(file_.length_width); }
  std::string_view take(std::uint64_t count);
  void skip(std::uint64_t count) { take(count); }
  std::size_t left() const { return piece_.size() - at_; }
  std::size_t position() const { return at_; }
  // Whether the next bytes are these; goes past them if so.
  bool starts_with(std::string_view mark);
  [[noreturn]] void refuse(const std::string& finding) const;

 private:
  const Hdf5Bytes& file_;
  std::string_view piece_;
  std::size_t at_ = 0;
  const char* what_;
};

// An address that stands for none: all bits set.
bool is_nowhere(const Hdf5Bytes& file, std::uint64_t address);

// Bob Jenkins' lookup3 of the bytes with a start of 0, the checksum of the format's structures.
std::uint32_t lookup3(std::string_view bytes);

}  // namespace asperity
