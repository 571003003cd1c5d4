// SPDX-License-Identifier: GPL-3.0-or-later
// What the messages of an object's header say: shape, kind of number, where the numbers lie, attributes.
// Source: HDF5 File Format Specification, version 3.0, The HDF Group. Reads what arrays of numbers and
// texts need; other kinds come back as "other" with a word for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/surface/io/hdf5_reader/hdf5_objects.hpp"

namespace asperity {

struct Hdf5Shape {
  bool none = false;  // the dataspace that holds nothing
  std::vector<std::uint64_t> sizes;
  // Elements; throws Error{bad_file} when the product is past what 48 bits hold.
  std::uint64_t count(const Hdf5Bytes& file) const;
};

struct Hdf5Type {
  enum class Kind { floating, integer, fixed_text, running_text, other };
  Kind kind = Kind::other;
  std::size_t width = 0;  // bytes of an element
  bool big_endian = false;
  bool is_signed = false;
  bool truth = false;     // an enumeration of one byte, as h5py writes truth values
  std::string word;       // "strings", "compound values": for Kind::other, and for errors
  std::size_t taken = 0;  // bytes of the message
};

struct Hdf5Filter {
  enum Id : std::uint64_t { deflate = 1, shuffle = 2, fletcher32 = 3 };
  std::uint64_t id;
};

struct Hdf5Layout {
  enum class Kind { compact, contiguous, chunked, other };
  Kind kind = Kind::other;
  std::string_view compact;               // the bytes themselves
  std::uint64_t address = 0, length = 0;  // contiguous; of the tree of chunks
  bool nowhere = false;                   // never written
  std::vector<std::uint64_t> chunk;       // elements along each side
};

struct Hdf5Attribute {
  std::string name;
  Hdf5Type type;
  Hdf5Shape shape;
  std::string_view data;
};

Hdf5Shape read_shape(const Hdf5Bytes& file, std::string_view body);
Hdf5Type read_type(const Hdf5Bytes& file, std::string_view body);
// `rank` is that of the dataset, `type` its type.
Hdf5Layout read_layout(const Hdf5Bytes& file, std::string_view body, std::size_t rank);
std::vector<Hdf5Filter> read_filters(const Hdf5Bytes& file, std::string_view body);
Hdf5Attribute read_attribute(const Hdf5Bytes& file, std::string_view body);

// The text of an attribute of one text; none for another kind. Texts of running length stand in a heap of the
// file.
std::optional<std::string> text_of(const Hdf5Bytes& file, const Hdf5Attribute& attribute);

// The number of an attribute of one number; none for another kind.
std::optional<double> number_of(const Hdf5Bytes& file, const Hdf5Attribute& attribute);

}  // namespace asperity
