// SPDX-License-Identifier: GPL-3.0-or-later
// The structures of an HDF5 file: its bytes (little-endian, with the widths of addresses and lengths that the
// file states, never taken past their end), its objects (superblock, groups of both kinds, headers of
// versions 1 and 2 with checksums where the format has them), what the messages of a header say, and the
// numbers of a dataset. Source: HDF5 File Format Specification, version 3.0, The HDF Group. Not read: groups
// with more members than a header holds in the newer layout ("dense", a fractal heap) and chunks of the newer
// indices.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/monitor.hpp"
#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"

namespace asperity {

// Only a fuzzer sets it to false, before all else: it would get no further than the first checksum.
inline bool hdf5_checksums_are_compared = true;

// Whether a file begins as HDF5 does.
bool looks_like_hdf5(const SourceFile& file);

// A file in memory and how it counts.
struct Hdf5Bytes {
  const SourceFile& file;
  std::string_view bytes;  // from the base address on, to the end that the superblock states
  std::uint64_t address_width = 8, length_width = 8;
  std::uint64_t root = 0;  // the address of the root group's header
  std::uint64_t over = 0;  // how many bytes of the file come after that end

  // A piece of the file. Throws Error{bad_file} naming `what` unless it lies within.
  std::string_view piece(std::uint64_t at, std::uint64_t length, const char* what) const;
  // Whether an address stands for none: all bits set.
  bool is_nowhere(std::uint64_t address) const {
    return address == ~std::uint64_t{0} >> (64 - 8 * address_width);
  }
  // The error of the file: "is damaged: " and the finding.
  [[noreturn]] void damaged(const std::string& finding, const std::string& hint = {}) const;
};

// Reads forward in a piece; every call throws Error{bad_file} naming `what` at its end.
class Hdf5Cursor {
 public:
  Hdf5Cursor(const Hdf5Bytes& file, std::string_view piece, const char* what)
      : file_(file), piece_(piece), what_(what) {}
  Hdf5Cursor(const Hdf5Bytes& file, std::uint64_t at, std::uint64_t length, const char* what)
      : Hdf5Cursor(file, file.piece(at, length, what), what) {}

  std::uint64_t number(std::uint64_t width);
  std::uint64_t address() { return number(file_.address_width); }
  std::uint64_t length() { return number(file_.length_width); }
  std::string_view take(std::uint64_t count);
  void skip(std::uint64_t count) { take(count); }
  std::size_t left() const { return piece_.size() - at_; }
  std::size_t position() const { return at_; }
  // Whether the next bytes are these; goes past them if so.
  bool starts_with(std::string_view mark);
  [[noreturn]] void refuse(const std::string& finding) const;

 private:
  const Hdf5Bytes& file_;
  std::string_view piece_;
  std::size_t at_ = 0;
  const char* what_;
};

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

struct Hdf5Shape {
  bool none = false;  // the dataspace that holds nothing
  std::vector<std::uint64_t> sizes;
  bool is_empty() const { return none || std::ranges::find(sizes, 0U) != sizes.end(); }
  // Elements; throws Error{bad_file} when the product is past what 48 bits hold.
  std::uint64_t count(const Hdf5Bytes& file) const;
};

struct Hdf5Type {
  enum class Kind { floating, integer, fixed_text, running_text, other };
  Kind kind = Kind::other;
  std::size_t width = 0;  // bytes of an element
  bool big_endian = false;
  bool is_signed = false;
  std::string word;  // "strings", "compound values": for what is no number
  bool is_number() const { return kind == Kind::floating || kind == Kind::integer; }
};

struct Hdf5Layout {
  enum class Kind { compact, contiguous, chunked, other };
  Kind kind = Kind::other;
  std::string_view compact;               // the bytes themselves
  std::uint64_t address = 0, length = 0;  // contiguous; of the tree of chunks
  bool nowhere = false;                   // never written
  std::vector<std::uint64_t> chunk;       // elements along each side, then the bytes of one
};

struct Hdf5Filter {
  enum Id : std::uint64_t { deflate = 1, shuffle = 2, fletcher32 = 3 };
};

struct Hdf5Attribute {
  std::string name;
  Hdf5Type type;
  Hdf5Shape shape;
  std::string_view data;
};

struct Hdf5Dataset {
  std::string name;
  Hdf5Shape shape;
  Hdf5Type type;
  Hdf5Layout layout;
  std::vector<std::uint64_t> filters;
};

// All of these throw Error{bad_file} for what is cut short or damaged.
Hdf5Bytes open_hdf5(const SourceFile& file);
Hdf5Header read_header(const Hdf5Bytes& file, std::uint64_t address);
// The members of a group by hard links, in the order of the file; what is not read goes to `unread`.
std::vector<Hdf5Link> read_members(const Hdf5Bytes& file, const Hdf5Header& header,
                                   std::vector<std::string>& unread);
Hdf5Shape read_shape(const Hdf5Bytes& file, std::string_view body);
Hdf5Type read_type(const Hdf5Bytes& file, std::string_view body);
// `rank` is that of the dataset.
Hdf5Layout read_layout(const Hdf5Bytes& file, std::string_view body, std::size_t rank);
std::vector<std::uint64_t> read_filters(const Hdf5Bytes& file, std::string_view body);
Hdf5Attribute read_attribute(const Hdf5Bytes& file, std::string_view body);
// The text or number of an attribute of one; none for another kind. Texts of running length stand in a heap
// of the file.
std::optional<std::string> text_of(const Hdf5Bytes& file, const Hdf5Attribute& attribute);
std::optional<double> number_of(const Hdf5Bytes& file, const Hdf5Attribute& attribute);

// Why the numbers cannot be read though nothing is damaged ("chunks of a newer index"); empty if they can.
std::string why_unread(const Hdf5Dataset& dataset);
// The numbers as an array that owns them: doubles, int64 or bytes. `room` is how many bytes of the file no
// other array has taken yet, and is made less: numbers that stand in the file one time cannot fill memory
// many times. Of chunks at most 1032 times as many bytes as they take of the file, which is what deflate
// makes of one; a chunk that was never written is an error, not a block of fill values.
Hdf5Array read_numbers(const Hdf5Bytes& file, const Hdf5Dataset& dataset, std::uint64_t& room,
                       Monitor& monitor);

}  // namespace asperity
