// SPDX-License-Identifier: GPL-3.0-or-later
// Named arrays with units, and texts, in an HDF5 file (version 1.8 of the format, which every reader of today
// knows): arrays lie in one piece, uncompressed, in C order, groups are made from the `/` of their names,
// texts and single numbers are attributes of the root. What is written carries checksums of its structure
// (HDF5's own) and of each array (attribute "digest"), so that a damaged file is told from a whole one. Files
// are written by the HDF5 library, which is loaded at the first of them; they are read by code of this
// project, other programs' as far as that code knows them.
//
// Why not by the library (1.10.8) too, in a child process that may fail? Measured on two busy processors by
// bench/hdf5_by_library.cpp: of 10 000 files with changed bytes 2 killed the child, and 116 gave numbers
// where this reader finds the file damaged (what is missing of a file that is cut short comes as zeros). A
// reading takes 19 to 31 ms more for a small map, 28 to 47 ms for 1024², and 37 to 63 ms where the file is
// in memory, as it is once its format is known. And a confined run may start no process: it could read no
// file at all.
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

// One array; copying shares the values.
struct Hdf5Array {
  std::string name;                // "pressure" or "bodies/lower/plastic": no empty part, no "." or ".."
  std::vector<std::size_t> shape;  // C order: (ny, nx) of a field; empty: one number
  Hdf5Values values;               // as many as the shape holds
  std::string unit;                // attribute "unit"; left out where empty
  // What the values stand in, where the array owns them; null where whoever made it keeps them alive.
  std::shared_ptr<const void> keeper{};
  // The number that stands for a value that is not there: the attribute "_FillValue", as netCDF writes it.
  // Only read; what this program writes has NaN there.
  std::optional<double> missing{};
};

struct Hdf5Content {
  std::vector<std::pair<std::string, std::string>> texts;  // attributes of the root, each below 60 000 bytes
  std::vector<Hdf5Array> arrays;
  std::vector<std::pair<std::string, double>> numbers{};  // attributes of the root as well
  std::vector<std::string>
      unread{};  // filled by reading: what stands in the file and is not among these, and why

  // Null where there is none.
  const Hdf5Array* array(std::string_view name) const;
  const std::string* text(std::string_view name) const;
  const double* number(std::string_view name) const;
};

// An array that owns its values.
template <class T>
Hdf5Array owning_array(std::string name, std::vector<std::size_t> shape, Array<T> values,
                       std::string unit = {}) {
  const auto kept = std::make_shared<const Array<T>>(std::move(values));
  return {std::move(name), std::move(shape), std::span<const T>(*kept), std::move(unit), kept};
}

// Writes the whole file or nothing: under a temporary name, waits for the disk, then renames. The same
// content gives the same bytes: no times, no names of machines. Thread-safe; two calls take turns. Throws
// Error{bad_file} when the library or the disk refuses, Error{bad_value} for a name, text or shape that
// cannot be written.
void write_hdf5(const std::filesystem::path& path, const Hdf5Content& content);

// Everything in the file that is an array of numbers, or a text or number of the root, in the order that the
// file keeps. Floating-point numbers come as doubles, bytes and truth values as bytes, all other integers as
// int64, or as doubles where they are past it. Throws Error{bad_file} for whatever is damaged. Memory: once
// the file's size where nothing is compressed or narrow, at most some ten thousand times where deflate was at
// its best. Thread-safe.
Hdf5Content read_hdf5(const std::filesystem::path& path, Monitor& monitor = Monitor::silent());
Hdf5Content read_hdf5(const SourceFile& file, Monitor& monitor = Monitor::silent());

}  // namespace asperity
