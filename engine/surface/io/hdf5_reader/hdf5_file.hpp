// SPDX-License-Identifier: GPL-3.0-or-later
// Named arrays with units, and texts, in HDF5 (format version 1.8): contiguous, uncompressed, C order. `/` in
// names makes groups; texts and single numbers are attributes of the root. Checksums (HDF5's own, and
// attribute "digest" per array) detect damage. The HDF5 library, loaded on demand, writes; our own code
// reads.
//
// Why not read with the library (1.10.8) in a child process? bench/hdf5_by_library.cpp: of 10 000 damaged
// files, 2 killed the child and 116 returned wrong numbers; reading takes 19 to 63 ms more. A confined run
// may start no process.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/monitor.hpp"
#include "engine/surface/io/hdf5_reader/hdf5_objects.hpp"

namespace asperity {

struct Hdf5Content {
  std::vector<std::pair<std::string, std::string>> texts;  // attributes of the root below 60 000 bytes
  std::vector<Hdf5Array> arrays;
  std::vector<std::pair<std::string, double>> numbers{};  // attributes of the root
  std::vector<std::string> unread{};                      // skipped contents and reasons

  // Null if missing.
  const Hdf5Array* array(std::string_view name) const;
  const std::string* text(std::string_view name) const;
  const double* number(std::string_view name) const;
};

// Atomic and durable. Deterministic: no times, no machine names. Thread-safe, serialised. Throws
// Error{bad_file}, and Error{bad_value} for an invalid name, text or shape.
void write_hdf5(const std::filesystem::path& path, const Hdf5Content& content);

// In the order of the file. Floating-point numbers become doubles, bytes and booleans bytes, other integers
// int64, or doubles beyond int64. Throws Error{bad_file} for damage. Memory: the file's size, at most about
// ten thousand times with ideal deflate. Thread-safe.
Hdf5Content read_hdf5(const std::filesystem::path& path, Monitor& monitor = Monitor::silent());
Hdf5Content read_hdf5(const SourceFile& file, Monitor& monitor = Monitor::silent());

}  // namespace asperity
