// SPDX-License-Identifier: GPL-3.0-or-later
// Named arrays with units, and texts, in HDF5 (format version 1.8): contiguous, uncompressed, C order. `/`
// in names makes groups; texts and single numbers are attributes of the root. Checksums (HDF5's own, and
// attribute "digest" per array) detect damage. The HDF5 library, loaded on demand, writes; our own code
// reads our files and a subset of other programs'.
//
// Why not read with the library (1.10.8) in a child process? Measured on two busy processors by
// bench/hdf5_by_library.cpp: of 10 000 files with changed bytes, 2 killed the child and 116 returned
// numbers although this reader finds damage (zeros for missing parts of truncated files). Reading takes 19
// to 31 ms more for a small map, 28 to 47 ms for 1024², and 37 to 63 ms for a file in memory, the usual
// case. A confined run may start no process at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

class SourceFile;

using Hdf5Values =
    std::variant<std::span<const double>, std::span<const std::int64_t>, std::span<const std::uint8_t>>;

// Copies share the values.
struct Hdf5Array {
  std::string name;                // "bodies/lower/plastic": no empty part, no "." or ".."
  std::vector<std::size_t> shape;  // C order: (ny, nx); empty: one number
  Hdf5Values values;
  std::string unit;
  // Owns the storage; null if the caller keeps it alive.
  std::shared_ptr<const void> keeper{};
  // Marks missing values: attribute "_FillValue", as in netCDF. Only read; we write NaN.
  std::optional<double> missing{};
};

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

template <class T>
Hdf5Array owning_array(std::string name, std::vector<std::size_t> shape, Array<T> values,
                       std::string unit = {}) {
  const auto kept = std::make_shared<const Array<T>>(std::move(values));
  return {std::move(name), std::move(shape), std::span<const T>(*kept), std::move(unit), kept};
}

// Atomic and durable: temporary name, flush, rename. Deterministic: no times, no machine names.
// Thread-safe, serialised. Throws Error{bad_file} for failures of library or disk, Error{bad_value} for an
// invalid name, text or shape.
void write_hdf5(const std::filesystem::path& path, const Hdf5Content& content);

// Returns arrays, texts and numbers in the order of the file. Floating-point numbers become doubles, bytes
// and booleans bytes, other integers int64, or doubles beyond int64. Throws Error{bad_file} for damage.
// Memory: the file's size, or more for compression and narrow types, at most about ten thousand times with
// ideal deflate. Thread-safe.
Hdf5Content read_hdf5(const std::filesystem::path& path, Monitor& monitor = Monitor::silent());
Hdf5Content read_hdf5(const SourceFile& file, Monitor& monitor = Monitor::silent());

}  // namespace asperity
