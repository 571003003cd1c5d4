// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of a dataset: laid out in one piece or in chunks (deflate, shuffle), of any width and byte
// order, brought to doubles, int64 or bytes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/core/monitor.hpp"
#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"
#include "engine/surface/io/hdf5_reader/hdf5_messages.hpp"

namespace asperity {

struct Hdf5Dataset {
  std::string name;
  Hdf5Shape shape;
  Hdf5Type type;
  Hdf5Layout layout;
  std::vector<Hdf5Filter> filters;
};

// Why the numbers cannot be read though nothing is damaged ("chunks of a newer index"); empty if they can.
std::string why_unread(const Hdf5Dataset& dataset);

// The numbers as an array that owns them. `room` is how many bytes of the file no other array has taken yet,
// and is made less: numbers that stand in the file one time cannot fill memory many times. Throws
// Error{bad_file}.
Hdf5Array read_numbers(const Hdf5Bytes& file, const Hdf5Dataset& dataset, std::uint64_t& room,
                       Monitor& monitor);

}  // namespace asperity
