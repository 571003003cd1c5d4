// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that an HDF5 file keeps in chunks, found by a tree (its first version), each perhaps compressed:
// deflate, shuffle and fletcher32 are undone. A chunk that was never written is an error, not a block of fill
// values.
#pragma once

#include "engine/surface/io/hdf5_reader/hdf5_data.hpp"

namespace asperity {

// Why the filters or the chunks of a dataset are not read; empty if they are.
std::string why_chunks_unread(const Hdf5Dataset& dataset);

// The bytes of all numbers in C order, of a dataset in chunks. `room` is lessened by what the chunks take of
// the file. At most 1032 times as many bytes as these, which is what deflate makes of one. Throws
// Error{bad_file}.
Array<char> read_chunks(const Hdf5Bytes& file, const Hdf5Dataset& dataset, std::uint64_t& room,
                        Monitor& monitor);

}  // namespace asperity
