// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the program that are loaded when they are first needed: `asperity-<name>.so`, each of which brings
// a library that most runs never touch and whose loading they should not pay for. A part is looked for beside
// the object that holds this code (the program, or the Lua module), then in lib/asperity, where installing
// puts it (../lib/asperity from a program, ../../asperity from a module), then, only for what runs inside the
// folder it was built in, in that folder. Nothing else is searched: no variable of the environment decides
// what is run.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace asperity {

struct LoadedPart {
  std::string_view name;     // "hdf5" for asperity-hdf5.so
  std::string_view purpose;  // what needs it, for errors: "HDF5 files are written"
  std::string_view package;  // the Debian package it stands on, for errors: "libhdf5-103-1"
};

// Where the file of a part is looked for, in this order.
std::vector<std::filesystem::path> part_places(const LoadedPart& part);

// The address of a C symbol of the part, which is loaded at the first call and stays. Thread-safe; after the
// first call a look-up. Throws Error{bad_file}: no file, naming the places; a library it needs is missing,
// naming the package; no such symbol (a part of another version).
void* part_symbol(const LoadedPart& part, const char* symbol);
// The same, looking in these places.
void* part_symbol(const LoadedPart& part, const char* symbol,
                  const std::vector<std::filesystem::path>& places);

template <class Function>
Function* part_function(const LoadedPart& part, const char* symbol) {
  return reinterpret_cast<Function*>(part_symbol(part, symbol));
}

}  // namespace asperity
