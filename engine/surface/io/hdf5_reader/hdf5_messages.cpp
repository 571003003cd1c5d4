// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/hdf5_reader/hdf5_messages.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace asperity {

namespace {

constexpr std::size_t most_dimensions = 32;

std::size_t padded(std::size_t length, bool pad) { return pad ? (length + 7) / 8 * 8 : length; }

// IEEE 754 of 4 or 8 bytes, by the places of sign, exponent and fraction.
bool is_ieee(std::uint64_t width, std::uint64_t sign, const std::array<std::uint64_t, 6>& fields,
             std::uint64_t bias) {
  if (width == 4)
    return sign == 31 && fields == std::array<std::uint64_t, 6>{0, 32, 23, 8, 0, 23} && bias == 127;
  return width == 8 && sign == 63 && fields == std::array<std::uint64_t, 6>{0, 64, 52, 11, 0, 52} &&
         bias == 1023;
}

void read_floating(Hdf5Cursor& cursor, std::uint64_t bits, Hdf5Type& type) {
  std::array<std::uint64_t, 6> fields{};
  for (std::size_t k = 0; k < fields.size(); ++k) fields[k] = cursor.number(k < 2 ? 2 : 1);
  const std::uint64_t bias = cursor.number(4);
  type.big_endian = (bits & 1) != 0;
  const bool vax = (bits & 64) != 0;
  const bool hidden_one = ((bits >> 4) & 3) == 2;
  if (!vax && hidden_one && is_ieee(type.width, (bits >> 8) & 0xFF, fields, bias)) {
    type.kind = Hdf5Type::Kind::floating;
  } else {
    type.word = "floating-point numbers of " + std::to_string(type.width) + " bytes";
  }
}

void read_integer(Hdf5Cursor& cursor, std::uint64_t bits, Hdf5Type& type) {
  const std::uint64_t offset = cursor.number(2), precision = cursor.number(2);
  type.big_endian = (bits & 1) != 0;
  type.is_signed = (bits & 8) != 0;
  const bool usual = type.width == 1 || type.width == 2 || type.width == 4 || type.width == 8;
  if (usual && offset == 0 && precision == 8 * type.width) {
    type.kind = Hdf5Type::Kind::integer;
  } else {
    type.word = "integers of " + std::to_string(precision) + " bits";
  }
}

// The bytes of an object of a heap that several texts share.
std::string_view heap_object(const Hdf5Bytes& file, std::uint64_t heap, std::uint64_t index) {
  constexpr const char* what = "a heap of texts";
  const std::size_t start = 8 + static_cast<std::size_t>(file.length_width);
  Hdf5Cursor head(file, file.piece(heap, start, what), what);
  if (!head.starts_with("GCOL")) head.refuse("has no mark");
  head.skip(4);
  const std::uint64_t length = head.length();
  if (length < start) head.refuse("is shorter than its own start");
  Hdf5Cursor cursor(file, file.piece(heap, length, what).substr(start), what);
  while (cursor.left() >= start) {
    const std::uint64_t number = cursor.number(2);
    cursor.skip(6);
    const std::uint64_t bytes = cursor.length();
    if (number == 0) break;
    const std::string_view object = cursor.take(bytes);
    if (number == index) return object;
    const std::size_t rest = (8 - bytes % 8) % 8;
    cursor.skip(std::min(rest, cursor.left()));
  }
  head.refuse("lacks a text that is looked for in it");
}

}  // namespace

std::uint64_t Hdf5Shape::count(const Hdf5Bytes& file) const {
  if (none) return 0;
  constexpr std::uint64_t most = std::uint64_t{1} << 48;
  std::uint64_t product = 1;
  for (const std::uint64_t size : sizes)
    if (size == 0) return 0;
  for (const std::uint64_t size : sizes) {
    if (size > most / product)
      file.refuse("is damaged: it claims an array of more numbers than any disk holds");
    product *= size;
  }
  return product;
}

Hdf5Shape read_shape(const Hdf5Bytes& file, std::string_view body) {
  Hdf5Cursor cursor(file, body, "a dataspace");
  const std::uint64_t version = cursor.number(1);
  if (version != 1 && version != 2) cursor.refuse("has a version that is not known");
  const std::uint64_t rank = cursor.number(1);
  cursor.skip(1);
  const std::uint64_t kind = cursor.number(1);
  if (version == 1) cursor.skip(4);
  if (rank > most_dimensions) cursor.refuse("has " + std::to_string(rank) + " dimensions");
  Hdf5Shape shape;
  shape.none = version == 2 && kind == 2;
  for (std::uint64_t k = 0; k < rank; ++k) shape.sizes.push_back(cursor.length());
  return shape;
}

Hdf5Type read_type(const Hdf5Bytes& file, std::string_view body) {
  Hdf5Cursor cursor(file, body, "a datatype");
  const std::uint64_t mark = cursor.number(1);
  const std::uint64_t bits = cursor.number(3);
  Hdf5Type type;
  type.width = cursor.number(4);
  constexpr std::size_t widest = std::size_t{1} << 20;
  if (type.width == 0 || type.width > widest)
    cursor.refuse("has elements of " + std::to_string(type.width) + " bytes");
  switch (mark & 15) {
    case 0:
      read_integer(cursor, bits, type);
      break;
    case 1:
      read_floating(cursor, bits, type);
      break;
    case 3:
      type.kind = Hdf5Type::Kind::fixed_text;
      type.word = "texts";
      break;
    case 6:
      type.word = "compound values";
      break;
    case 8: {
      // Truth values: an enumeration whose values are bytes.
      const Hdf5Type base = read_type(file, body.substr(cursor.position()));
      type.word = "named values";
      if (base.kind == Hdf5Type::Kind::integer && base.width == 1 && type.width == 1) {
        type.kind = base.kind;
        type.truth = true;
      }
      break;
    }
    case 9:
      type.word = (bits & 15) == 1 ? "texts" : "lists of running length";
      if ((bits & 15) == 1) type.kind = Hdf5Type::Kind::running_text;
      break;
    default:
      type.word = "values that are no numbers";
  }
  type.taken = cursor.position();
  return type;
}

Hdf5Layout read_layout(const Hdf5Bytes& file, std::string_view body, std::size_t rank) {
  Hdf5Cursor cursor(file, body, "a data layout");
  const std::uint64_t version = cursor.number(1);
  Hdf5Layout layout;
  if (version == 0 || version > 4) cursor.refuse("has a version that is not known");
  if (version < 3) {
    const std::uint64_t sides = cursor.number(1), kind = cursor.number(1);
    cursor.skip(5);
    if (kind != 1 && kind != 2) return layout;
    layout.address = cursor.address();
    layout.nowhere = is_nowhere(file, layout.address);
    layout.kind = kind == 1 ? Hdf5Layout::Kind::contiguous : Hdf5Layout::Kind::chunked;
    if (sides > most_dimensions + 1) cursor.refuse("has too many dimensions");
    std::uint64_t product = 1;
    for (std::uint64_t k = 0; k < sides; ++k) layout.chunk.push_back(cursor.number(4));
    for (const std::uint64_t side : layout.chunk) product *= side;
    layout.length = product;
    return layout;
  }
  switch (cursor.number(1)) {
    case 0:
      layout.kind = Hdf5Layout::Kind::compact;
      layout.compact = cursor.take(cursor.number(2));
      break;
    case 1:
      layout.kind = Hdf5Layout::Kind::contiguous;
      layout.address = cursor.address();
      layout.length = cursor.length();
      layout.nowhere = is_nowhere(file, layout.address);
      break;
    case 2: {
      if (version == 4) break;
      layout.kind = Hdf5Layout::Kind::chunked;
      const std::uint64_t sides = cursor.number(1);
      if (sides != rank + 1) cursor.refuse("has chunks of other dimensions than the array");
      layout.address = cursor.address();
      layout.nowhere = is_nowhere(file, layout.address);
      for (std::uint64_t k = 0; k < sides; ++k) layout.chunk.push_back(cursor.number(4));
      break;
    }
    default:
      break;
  }
  return layout;
}

std::vector<Hdf5Filter> read_filters(const Hdf5Bytes& file, std::string_view body) {
  Hdf5Cursor cursor(file, body, "a list of filters");
  const std::uint64_t version = cursor.number(1), count = cursor.number(1);
  if (version != 1 && version != 2) cursor.refuse("has a version that is not known");
  if (version == 1) cursor.skip(6);
  std::vector<Hdf5Filter> filters;
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::uint64_t id = cursor.number(2);
    const std::uint64_t name = version == 1 || id >= 256 ? cursor.number(2) : 0;
    cursor.skip(2);
    const std::uint64_t values = cursor.number(2);
    cursor.skip(padded(name, version == 1));
    cursor.skip(4 * values);
    if (version == 1 && values % 2 == 1) cursor.skip(4);
    filters.push_back({id});
  }
  return filters;
}

Hdf5Attribute read_attribute(const Hdf5Bytes& file, std::string_view body) {
  Hdf5Cursor cursor(file, body, "an attribute");
  const std::uint64_t version = cursor.number(1);
  if (version == 0 || version > 3) cursor.refuse("has a version that is not known");
  const std::uint64_t flags = cursor.number(1);
  const std::size_t name = cursor.number(2), type = cursor.number(2), space = cursor.number(2);
  if (version == 3) cursor.skip(1);
  const bool pad = version == 1;
  Hdf5Attribute attribute;
  const std::string_view written = cursor.take(padded(name, pad));
  attribute.name = std::string(written.substr(0, std::min(name, written.find('\0'))));
  const std::string_view type_body = cursor.take(padded(type, pad));
  const std::string_view space_body = cursor.take(padded(space, pad));
  const bool shared = version > 1 && (flags & 3) != 0;
  if (shared) {
    attribute.type.word = "values of a type kept elsewhere";
    return attribute;
  }
  attribute.type = read_type(file, type_body);
  attribute.shape = read_shape(file, space_body);
  attribute.data = cursor.take(cursor.left());
  return attribute;
}

std::optional<std::string> text_of(const Hdf5Bytes& file, const Hdf5Attribute& attribute) {
  if (attribute.type.kind != Hdf5Type::Kind::fixed_text &&
      attribute.type.kind != Hdf5Type::Kind::running_text)
    return {};
  if (attribute.shape.count(file) != 1) return {};
  Hdf5Cursor cursor(file, attribute.data, "the text of an attribute");
  std::string_view text;
  if (attribute.type.kind == Hdf5Type::Kind::fixed_text) {
    text = cursor.take(attribute.type.width);
  } else {
    const std::uint64_t length = cursor.number(4);
    const std::uint64_t heap = cursor.address();
    const std::uint64_t index = cursor.number(4);
    if (length > 0) text = heap_object(file, heap, index).substr(0, length);
  }
  return std::string(text.substr(0, text.find('\0')));
}

std::optional<double> number_of(const Hdf5Bytes& file, const Hdf5Attribute& attribute) {
  const Hdf5Type& type = attribute.type;
  const bool floating = type.kind == Hdf5Type::Kind::floating;
  if ((!floating && type.kind != Hdf5Type::Kind::integer) || attribute.shape.count(file) != 1) return {};
  Hdf5Cursor cursor(file, attribute.data, "the number of an attribute");
  std::string raw(cursor.take(type.width));
  if (type.big_endian) std::reverse(raw.begin(), raw.end());
  const std::uint64_t bits = Hdf5Cursor(file, raw, "").number(static_cast<int>(type.width));
  if (floating)
    return type.width == 8 ? std::bit_cast<double>(bits)
                           : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  if (!type.is_signed) return static_cast<double>(bits);
  const auto unused = static_cast<int>(64 - 8 * type.width);
  return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
}

}  // namespace asperity
