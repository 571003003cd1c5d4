// SPDX-License-Identifier: GPL-3.0-or-later
// What passes between the engine and asperity-hdf5.so: plain C data, so that the part shares neither types
// nor memory nor exceptions with the program that loads it. The name of the function carries the
// version of these structures.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

enum AsperityHdf5Kind { asperity_hdf5_double = 0, asperity_hdf5_int64 = 1, asperity_hdf5_uint8 = 2 };

struct AsperityHdf5Text {
  const char* name;
  const char* value;  // UTF-8
};

struct AsperityHdf5Number {
  const char* name;
  double value;
};

struct AsperityHdf5Array {
  const char* name;  // with `/` between the groups
  AsperityHdf5Kind kind;
  int rank;
  const std::uint64_t* shape;
  const void* values;
  const AsperityHdf5Text* attributes;
  std::size_t attribute_count;
};

struct AsperityHdf5File {
  const AsperityHdf5Text* texts;
  std::size_t text_count;
  const AsperityHdf5Number* numbers;
  std::size_t number_count;
  const AsperityHdf5Array* arrays;
  std::size_t array_count;
};

// Writes a file at `path`, replacing one. 0, or 1 with what the library says in `reason` (ends with a zero
// byte). Not thread-safe.
using AsperityHdf5Write = int(const char* path, const AsperityHdf5File* file, char* reason, std::size_t room);
}
