// SPDX-License-Identifier: GPL-3.0-or-later
// Structures of an HDF5 file: bounds-checked bytes, objects (both kinds of groups, headers of versions 1 and
// 2), messages and numbers. Source: HDF5 File Format Specification, version 3.0, The HDF Group. Not read:
// dense groups (fractal heap) and chunks with newer indices.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"

namespace asperity {

using Hdf5Values =
    std::variant<std::span<const double>, std::span<const std::int64_t>, std::span<const std::uint8_t>>;

// Copies share the values.
struct Hdf5Array {
  std::string name;                // "bodies/lower/plastic": no empty part, no "." or ".."
  std::vector<std::size_t> shape;  // C order: (ny, nx); empty: one number
  Hdf5Values values;
  std::string unit;
  // Owns the storage; null if the caller keeps it alive.
  std::shared_ptr<const void> keeper{};
  // Marks missing values: attribute "_FillValue", as in netCDF. We write NaN.
  std::optional<double> missing{};
};

template <class T>
Hdf5Array owning_array(std::string name, std::vector<std::size_t> shape, Array<T> values,
                       std::string unit = {}) {
  const auto kept = std::make_shared<const Array<T>>(std::move(values));
  return {std::move(name), std::move(shape), std::span<const T>(*kept), std::move(unit), kept};
}

// Only a fuzzer sets false, at start.
inline bool hdf5_checksums_are_compared = true;

bool looks_like_hdf5(const SourceFile& file);

struct Hdf5Bytes {
  const SourceFile& file;
  std::string_view bytes;  // from base address to stated end
  std::uint64_t address_width = 8, length_width = 8;
  std::uint64_t root = 0;  // address of the root header
  std::uint64_t over = 0;  // bytes after the stated end

  // Throws Error{bad_file} naming `what` if out of range.
  std::string_view piece(std::uint64_t at, std::uint64_t length, const char* what) const;
  // All bits set: undefined address.
  bool is_nowhere(std::uint64_t address) const {
    return address == ~std::uint64_t{0} >> (64 - 8 * address_width);
  }
  [[noreturn]] void damaged(const std::string& finding, const std::string& hint = {}) const;
};

class Hdf5Cursor : public BinaryCursor {
 public:
  Hdf5Cursor(const Hdf5Bytes& file, std::string_view piece, const char* what)
      : BinaryCursor(file.file, piece, what), file_(file), what_(what) {}
  Hdf5Cursor(const Hdf5Bytes& file, std::uint64_t at, std::uint64_t length, const char* what)
      : Hdf5Cursor(file, file.piece(at, length, what), what) {}

  std::uint64_t number(std::uint64_t width);
  std::uint64_t address() { return number(file_.address_width); }
  std::uint64_t length() { return number(file_.length_width); }
  // Skips equal bytes.
  bool starts_with(std::string_view mark);
  [[noreturn]] void refuse(const std::string& finding) const;

 private:
  const Hdf5Bytes& file_;
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
  bool shared;  // body elsewhere in the file
  std::string_view body;
};

struct Hdf5Header {
  std::vector<Hdf5Message> messages;
  // The first match, or null.
  const Hdf5Message* find(Hdf5MessageKind kind) const;
};

struct Hdf5Link {
  std::string name;
  std::uint64_t address;
};

struct Hdf5Shape {
  bool none = false;  // null dataspace
  std::vector<std::uint64_t> sizes;
  bool is_empty() const { return none || std::ranges::find(sizes, 0U) != sizes.end(); }
  // Elements; throws Error{bad_file} above 48 bits.
  std::uint64_t count(const Hdf5Bytes& file) const;
};

struct Hdf5Type {
  enum class Kind { floating, integer, fixed_text, running_text, other };
  Kind kind = Kind::other;
  std::size_t width = 0;  // bytes
  bool big_endian = false;
  bool is_signed = false;
  std::string word;  // "strings", "compound values"
  bool is_number() const { return kind == Kind::floating || kind == Kind::integer; }
};

struct Hdf5Layout {
  enum class Kind { compact, contiguous, chunked, other };
  Kind kind = Kind::other;
  std::string_view compact;
  std::uint64_t address = 0, length = 0;  // contiguous data or tree of chunks
  bool nowhere = false;                   // never written
  std::vector<std::uint64_t> chunk;       // elements per side, then bytes
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

// All throw Error{bad_file} for truncated or damaged structures.
Hdf5Bytes open_hdf5(const SourceFile& file);
Hdf5Header read_header(const Hdf5Bytes& file, std::uint64_t address);
// By hard links, in the order of the file; `unread` lists the rest.
std::vector<Hdf5Link> read_members(const Hdf5Bytes& file, const Hdf5Header& header,
                                   std::vector<std::string>& unread);
Hdf5Shape read_shape(const Hdf5Bytes& file, std::string_view body);
Hdf5Type read_type(const Hdf5Bytes& file, std::string_view body);
Hdf5Layout read_layout(const Hdf5Bytes& file, std::string_view body, std::size_t rank);
std::vector<std::uint64_t> read_filters(const Hdf5Bytes& file, std::string_view body);
Hdf5Attribute read_attribute(const Hdf5Bytes& file, std::string_view body);
// None for other kinds. Variable-length texts are in a heap.
std::optional<std::string> text_of(const Hdf5Bytes& file, const Hdf5Attribute& attribute);
std::optional<double> number_of(const Hdf5Bytes& file, const Hdf5Attribute& attribute);

// Reason for an unsupported layout, or empty.
std::string why_unread(const Hdf5Dataset& dataset);
// `room`: bytes of the file not yet used by arrays, so shared bytes cannot multiply in memory. A chunk never
// written is an error.
Hdf5Array read_numbers(const Hdf5Bytes& file, const Hdf5Dataset& dataset, std::uint64_t& room,
                       Monitor& monitor);

}  // namespace asperity
