// SPDX-License-Identifier: GPL-3.0-or-later
// Parts loaded on first use: `asperity-<name>.so` with a library that few runs need. Search order: the folder
// of this code's object (program or Lua module); the installed lib/asperity; for objects in the build folder,
// the build folder. For security, environment variables have no effect.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace asperity {

struct LoadedPart {
  std::string_view name;     // "hdf5" for asperity-hdf5.so
  std::string_view purpose;  // for errors: "HDF5 files are written"
  std::string_view package;  // Debian package, for errors: "libhdf5-103-1"
};

// In order of search.
std::vector<std::filesystem::path> part_places(const LoadedPart& part);

// Address of a C symbol; the first call loads the part permanently. Thread-safe. Throws Error{bad_file} for a
// missing file, library or symbol.
void* part_symbol(const LoadedPart& part, const char* symbol);
void* part_symbol(const LoadedPart& part, const char* symbol,
                  const std::vector<std::filesystem::path>& places);

template <class Function>
Function* part_function(const LoadedPart& part, const char* symbol) {
  return reinterpret_cast<Function*>(part_symbol(part, symbol));
}

}  // namespace asperity
