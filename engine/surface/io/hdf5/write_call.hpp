// SPDX-License-Identifier: GPL-3.0-or-later
// Plain C interface to asperity-hdf5.so. The function's name contains the version of these structures.
#pragma once

#include <cstddef>

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
  const char* name;  // with `/` between groups
  AsperityHdf5Kind kind;
  int rank;
  const std::size_t* shape;
  const void* values;
  const char *unit, *digest;  // UTF-8; "": no unit
};

struct AsperityHdf5File {
  const AsperityHdf5Text* texts;
  std::size_t text_count;
  const AsperityHdf5Number* numbers;
  std::size_t number_count;
  const AsperityHdf5Array* arrays;
  std::size_t array_count;
};

// Replaces `path`. Returns 0, or 1 with a message in `reason`. Not thread-safe.
using AsperityHdf5Write = int(const char* path, const AsperityHdf5File* file, char* reason, std::size_t room);
}
