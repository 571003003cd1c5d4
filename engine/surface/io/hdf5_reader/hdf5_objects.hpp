// SPDX-License-Identifier: GPL-3.0-or-later
// The objects of an HDF5 file: where they are (superblock, groups of both kinds) and the messages of their
// headers (versions 1 and 2, with checksums where the format has them). Source: HDF5 File Format
// Specification, version 3.0, The HDF Group. Groups with more members than a header holds in the newer layout
// ("dense", a fractal heap) are not read.
#pragma once

#include <string>
#include <vector>

#include "engine/surface/io/hdf5_reader/hdf5_bytes.hpp"

namespace asperity {

// Only a fuzzer sets it to false, before all else: it would get no further than the first checksum.
inline bool hdf5_checksums_are_compared = true;

enum class Hdf5MessageKind : std::uint16_t {
  dataspace = 0x01,
  link_info = 0x02,
  datatype = 0x03,
  link = 0x06,
  layout = 0x08,
  filters = 0x0B,
  attribute = 0x0C,
  continuation = 0x10,
  symbol_table = 0x11,
  attribute_info = 0x15,
};

struct Hdf5Message {
  Hdf5MessageKind kind;
  bool shared;            // the body stands elsewhere in the file
  std::string_view body;  // bytes of the file
};

struct Hdf5Header {
  std::vector<Hdf5Message> messages;
  // Null where there is none; the first otherwise.
  const Hdf5Message* find(Hdf5MessageKind kind) const;
};

struct Hdf5Link {
  std::string name;
  std::uint64_t address;  // of the object's header
};

// Whether a file begins as HDF5 does.
bool looks_like_hdf5(const SourceFile& file);

struct Hdf5Root {
  Hdf5Bytes file;
  std::uint64_t address;  // of the root group's header
};

// Throws Error{bad_file} when the file is none, is cut short, or its superblock is damaged.
Hdf5Root open_hdf5(const SourceFile& file);

// The messages of the header there. Throws Error{bad_file}.
Hdf5Header read_header(const Hdf5Bytes& file, std::uint64_t address);

// The members of a group by hard links, in the order of the file; what is not read goes to `unread`.
std::vector<Hdf5Link> read_members(const Hdf5Bytes& file, const Hdf5Header& header,
                                   std::vector<std::string>& unread);

}  // namespace asperity
