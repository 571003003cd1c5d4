// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the program loaded on first use: `asperity-<name>.so` with a library that few runs need. Search
// order: the folder of the object with this code (program or Lua module), then the installed lib/asperity
// (../lib/asperity from a program, ../../asperity from a module), then, only for objects inside the build
// folder, the build folder. For security, no environment variable changes the search.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace asperity {

struct LoadedPart {
  std::string_view name;     // "hdf5" for asperity-hdf5.so
  std::string_view purpose;  // for errors: "HDF5 files are written"
  std::string_view package;  // required Debian package, for errors: "libhdf5-103-1"
};

// In order of search.
std::vector<std::filesystem::path> part_places(const LoadedPart& part);

// Address of a C symbol. The first call loads the part permanently; later calls are look-ups. Thread-safe.
// Throws Error{bad_file} if the file is missing (names the places), a library is missing (names the package)
// or the symbol is missing (part of another version).
void* part_symbol(const LoadedPart& part, const char* symbol);
// Searches these places only.
void* part_symbol(const LoadedPart& part, const char* symbol,
                  const std::vector<std::filesystem::path>& places);

template <class Function>
Function* part_function(const LoadedPart& part, const char* symbol) {
  return reinterpret_cast<Function*>(part_symbol(part, symbol));
}

}  // namespace asperity
