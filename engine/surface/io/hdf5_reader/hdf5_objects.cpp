// SPDX-License-Identifier: GPL-3.0-or-later
// Walks are bounded by the number of structures that fit into the file.
#include "engine/surface/io/hdf5_reader/hdf5_objects.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace asperity {

namespace {

constexpr std::string_view signature("\x89HDF\r\n\x1a\n", 8);

// At 0, or after a user block of 512 bytes times a power of two.
std::size_t start_of(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size() && bytes.size() - at >= signature.size();
       at = at == 0 ? 512 : 2 * at)
    if (bytes.substr(at, signature.size()) == signature) return at;
  return std::string_view::npos;
}

// Bob Jenkins' lookup3, initial value 0.
std::uint32_t lookup3(std::string_view bytes) {
  std::array<std::uint32_t, 3> words;
  words.fill(0xdeadbeefU + static_cast<std::uint32_t>(bytes.size()));
  if (bytes.empty()) return words[2];
  while (true) {
    for (std::size_t k = 0; k < bytes.size() && k < 12; ++k)
      words[k / 4] += std::uint32_t{static_cast<unsigned char>(bytes[k])} << (8 * (k % 4));
    if (bytes.size() <= 12) break;
    for (std::size_t k = 0; const int bits : {4, 6, 8, 16, 19, 4}) {
      std::uint32_t &x = words[k % 3], &z = words[(k + 2) % 3];
      x = (x - z) ^ std::rotl(z, bits);
      z += words[++k % 3];
    }
    bytes.remove_prefix(12);
  }
  for (std::size_t k = 0; const int bits : {14, 11, 25, 16, 4, 14, 24}) {
    std::uint32_t& x = words[(k + 2) % 3];
    const std::uint32_t y = words[++k % 3];
    x = (x ^ y) - std::rotl(y, bits);
  }
  return words[2];
}

// Returns the piece without its checksum.
std::string_view checked(const Hdf5Bytes& file, std::string_view piece, const char* what) {
  constexpr std::size_t width = 4;
  if (piece.size() < width) file.damaged(std::string(what) + " is too short");
  const std::string_view content = piece.substr(0, piece.size() - width);
  if (hdf5_checksums_are_compared &&
      Hdf5Cursor(file, piece.substr(content.size()), what).number(width) != lookup3(content))
    file.damaged("the checksum of " + std::string(what) + " is not that of its bytes",
                 "the file was altered after it was written");
  return content;
}

// Continuation blocks are added to `more`.
void take_messages(const Hdf5Bytes& file, std::string_view block, int version, bool ordered,
                   std::vector<Hdf5Message>& messages, std::vector<std::string_view>& more) {
  Hdf5Cursor cursor(file, block, "an object header");
  const std::size_t head = version == 1 ? 8 : ordered ? 6 : 4;
  while (cursor.left() >= head) {
    const auto kind = static_cast<Hdf5MessageKind>(cursor.number(version == 1 ? 2 : 1));
    const std::uint64_t length = cursor.number(2);
    const std::uint64_t flags = cursor.number(1);
    cursor.skip(version == 1 ? 3 : ordered ? 2 : 0);
    const std::string_view body = cursor.take(length);
    if (kind == Hdf5MessageKind::continuation) {
      Hdf5Cursor target(file, body, "a continued header");
      const std::uint64_t at = target.address();
      more.push_back(file.piece(at, target.length(), "a continued header"));
    } else if (kind != Hdf5MessageKind{}) {
      messages.push_back({kind, (flags & 2) != 0, body});
    }
  }
}

// Older groups: a tree of nodes, names in a heap.
struct SymbolTable {
  const Hdf5Bytes& file;
  std::string_view names;
  std::vector<Hdf5Link>& links;
  std::size_t nodes = 0;

  void walk(std::uint64_t node, int depth) {
    constexpr const char* what = "a node of a group";
    if (depth > 16 || ++nodes > file.bytes.size() / 24) file.damaged("a group goes round in circles");
    const std::uint64_t start = 8 + 2 * file.address_width;
    Hdf5Cursor head(file, node, std::min<std::uint64_t>(start, file.bytes.size()), what);
    const bool leaf = head.starts_with("SNOD");
    if (!leaf && (!head.starts_with("TREE") || head.number(1) != 0)) head.refuse("has no mark");
    head.skip(leaf ? 2 : 1);
    const std::uint64_t count = head.number(2);
    if (leaf) {
      Hdf5Cursor entries(file, node + 8, count * (2 * file.address_width + 24), what);
      for (std::uint64_t k = 0; k < count; ++k) take_entry(entries);
    } else {
      Hdf5Cursor children(file, node + start, count * (file.length_width + file.address_width), what);
      for (std::uint64_t k = 0; k < count; ++k) {
        children.length();
        walk(children.address(), depth + 1);
      }
    }
  }

  void take_entry(Hdf5Cursor& cursor) {
    const std::uint64_t name = cursor.address(), header = cursor.address();
    const std::uint64_t cached = cursor.number(4);
    cursor.skip(20);
    constexpr std::uint64_t soft_link = 2;
    if (cached == soft_link) return;
    if (name >= names.size()) cursor.refuse("has a name outside its heap");
    const std::string_view rest = names.substr(static_cast<std::size_t>(name));
    const std::size_t end = rest.find('\0');
    if (end == std::string_view::npos) cursor.refuse("has a name without an end");
    links.push_back({std::string(rest.substr(0, end)), header});
  }
};

std::string_view heap_of_names(const Hdf5Bytes& file, std::uint64_t heap) {
  constexpr const char* what = "a heap of names";
  Hdf5Cursor cursor(file, heap, 8 + 2 * file.length_width + file.address_width, what);
  if (!cursor.starts_with("HEAP")) cursor.refuse("has no mark");
  cursor.skip(4);
  const std::uint64_t length = cursor.length();
  cursor.length();
  return file.piece(cursor.address(), length, what);
}

// Newer groups; soft and external links are ignored.
void take_link(const Hdf5Bytes& file, const Hdf5Message& message, std::vector<Hdf5Link>& links) {
  Hdf5Cursor cursor(file, message.body, "a link");
  if (cursor.number(1) != 1) cursor.refuse("has a version that is not known");
  const std::uint64_t flags = cursor.number(1);
  const std::uint64_t type = (flags & 8) != 0 ? cursor.number(1) : 0;
  if ((flags & 4) != 0) cursor.skip(8);
  if ((flags & 16) != 0) cursor.skip(1);
  const std::string_view name = cursor.take(cursor.number(1U << (flags & 3)));
  if (type == 0) links.push_back({std::string(name), cursor.address()});
}

constexpr std::size_t most_dimensions = 32;

std::size_t padded(std::size_t length, bool pad) { return pad ? (length + 7) / 8 * 8 : length; }

// IEEE 754, 4 or 8 bytes, by positions of sign, exponent and fraction.
void read_floating(Hdf5Cursor& cursor, std::uint64_t bits, Hdf5Type& type) {
  using Places = std::array<std::uint64_t, 8>;
  Places places{(bits >> 8) & 0xFF};
  for (std::size_t k = 1; k < places.size(); ++k) places[k] = cursor.number(k < 3 ? 2 : k < 7 ? 1 : 4);
  type.big_endian = (bits & 1) != 0;
  const bool vax = (bits & 64) != 0;
  const bool hidden_one = ((bits >> 4) & 3) == 2;
  const bool is_single = type.width == 4 && places == Places{31, 0, 32, 23, 8, 0, 23, 127};
  const bool is_double = type.width == 8 && places == Places{63, 0, 64, 52, 11, 0, 52, 1023};
  if (!vax && hidden_one && (is_single || is_double))
    type.kind = Hdf5Type::Kind::floating;
  else
    type.word = "floating-point numbers of " + std::to_string(type.width) + " bytes";
}

void read_integer(Hdf5Cursor& cursor, std::uint64_t bits, Hdf5Type& type) {
  const std::uint64_t offset = cursor.number(2), precision = cursor.number(2);
  type.big_endian = (bits & 1) != 0;
  type.is_signed = (bits & 8) != 0;
  const bool usual = type.width == 1 || type.width == 2 || type.width == 4 || type.width == 8;
  if (usual && offset == 0 && precision == 8 * type.width)
    type.kind = Hdf5Type::Kind::integer;
  else
    type.word = "integers of " + std::to_string(precision) + " bits";
}

// From a global heap.
std::string_view heap_object(const Hdf5Bytes& file, std::uint64_t heap, std::uint64_t index) {
  constexpr const char* what = "a heap of texts";
  const std::uint64_t start = 8 + file.length_width;
  Hdf5Cursor head(file, heap, start, what);
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
    cursor.skip(std::min<std::uint64_t>((8 - bytes % 8) % 8, cursor.left()));
  }
  head.refuse("lacks a text that is looked for in it");
}

}  // namespace

bool looks_like_hdf5(const SourceFile& file) { return start_of(file.bytes()) != std::string_view::npos; }

std::string_view Hdf5Bytes::piece(std::uint64_t at, std::uint64_t length, const char* what) const {
  if (at > bytes.size() || length > bytes.size() - at)
    refuse_file(file,
                "has " + std::string(what) + " past its end: " + std::to_string(length) + " bytes at " +
                    std::to_string(at) + " of " + std::to_string(bytes.size()),
                "the file is cut short or damaged");
  return bytes.substr(static_cast<std::size_t>(at), static_cast<std::size_t>(length));
}

void Hdf5Bytes::damaged(const std::string& finding, const std::string& hint) const {
  refuse_file(file, "is damaged: " + finding, hint);
}

std::uint64_t Hdf5Cursor::number(std::uint64_t width) {
  const std::string_view raw = take(width);
  std::uint64_t value = 0;
  for (std::size_t k = raw.size(); k-- > 0;) value = value << 8 | static_cast<unsigned char>(raw[k]);
  return value;
}

bool Hdf5Cursor::starts_with(std::string_view mark) {
  if (!rest().starts_with(mark)) return false;
  skip(mark.size());
  return true;
}

void Hdf5Cursor::refuse(const std::string& finding) const {
  file_.damaged(std::string(what_) + " " + finding, "the file was cut short or altered");
}

const Hdf5Message* Hdf5Header::find(Hdf5MessageKind kind) const {
  const auto found = std::ranges::find(messages, kind, &Hdf5Message::kind);
  return found == messages.end() ? nullptr : &*found;
}

Hdf5Bytes open_hdf5(const SourceFile& file) {
  const std::size_t start = start_of(file.bytes());
  if (start == std::string_view::npos)
    refuse_file(file, "is not an HDF5 file: it does not start with \\x89HDF",
                "if it is another format, name it with `format`");
  Hdf5Bytes bytes{file, file.bytes().substr(start)};
  constexpr const char* what = "the superblock";
  Hdf5Cursor cursor(bytes, bytes.bytes, what);
  cursor.skip(signature.size());
  const std::uint64_t version = cursor.number(1);
  if (version > 3)
    refuse_file(file, "has an HDF5 superblock of version " + std::to_string(version),
                "versions 0 to 3 are read");
  const bool old = version < 2;
  cursor.skip(old ? 4 : 0);
  bytes.address_width = cursor.number(1);
  bytes.length_width = cursor.number(1);
  for (const std::uint64_t width : {bytes.address_width, bytes.length_width})
    if (width != 2 && width != 4 && width != 8) cursor.refuse("has no sensible widths of addresses");
  cursor.skip(old ? 1 + 2 + 2 + 4 : 1);
  if (version == 1) cursor.skip(4);
  const std::uint64_t base = cursor.address();
  cursor.address();
  const std::uint64_t end = cursor.address();
  cursor.skip(old ? 2 * bytes.address_width : 0);
  bytes.root = cursor.address();
  if (!old) checked(bytes, bytes.bytes.substr(0, cursor.position() + 4), what);
  // Base and end share an arbitrary origin.
  if (end < base) cursor.refuse("ends before it begins");
  const std::uint64_t length = end - base;
  if (length > bytes.bytes.size() || length < cursor.position())
    refuse_file(file,
                "is cut short: it says that it has " + std::to_string(length) + " bytes and has " +
                    std::to_string(bytes.bytes.size()),
                "copy it again from its source");
  bytes.over = bytes.bytes.size() - length;
  bytes.bytes = bytes.bytes.substr(0, static_cast<std::size_t>(length));
  return bytes;
}

Hdf5Header read_header(const Hdf5Bytes& file, std::uint64_t address) {
  constexpr const char* what = "an object header";
  const std::uint64_t size = file.bytes.size();
  Hdf5Cursor cursor(file, address, size - std::min(address, size), what);
  std::vector<std::string_view> blocks;
  const int version = cursor.starts_with("OHDR") ? 2 : 1;
  bool ordered = false;
  if (version == 2) {
    if (cursor.number(1) != 2) cursor.refuse("has a version that is not known");
    const std::uint64_t flags = cursor.number(1);
    ordered = (flags & 4) != 0;
    if ((flags & 32) != 0) cursor.skip(16);
    if ((flags & 16) != 0) cursor.skip(4);
    const std::uint64_t length = cursor.number(1U << (flags & 3));
    const std::size_t before = cursor.position();
    cursor.skip(length);
    blocks.push_back(checked(file, file.piece(address, before + length + 4, what), what).substr(before));
  } else {
    if (cursor.number(1) != 1) cursor.refuse("has no mark, or a version that is not known");
    cursor.skip(1 + 2 + 4);
    const std::uint64_t length = cursor.number(4);
    cursor.skip(4);
    blocks.push_back(cursor.take(length));
  }
  Hdf5Header header;
  std::size_t taken = 0;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    std::string_view block = blocks[k];
    taken += block.size();
    if (taken > size || blocks.size() > size / 16 + 1) file.damaged("an object header goes round in circles");
    if (version == 2 && k > 0) {
      block = checked(file, block, "a continued header");
      if (!block.starts_with("OCHK")) file.damaged("a continued header has no mark");
      block.remove_prefix(4);
    }
    take_messages(file, block, version, ordered, header.messages, blocks);
  }
  return header;
}

std::vector<Hdf5Link> read_members(const Hdf5Bytes& file, const Hdf5Header& header,
                                   std::vector<std::string>& unread) {
  std::vector<Hdf5Link> links;
  for (const Hdf5Message& message : header.messages) {
    if (message.kind == Hdf5MessageKind::link) take_link(file, message, links);
    if (message.kind == Hdf5MessageKind::symbol_table) {
      Hdf5Cursor cursor(file, message.body, "a symbol table");
      const std::uint64_t tree = cursor.address();
      SymbolTable{file, heap_of_names(file, cursor.address()), links}.walk(tree, 0);
    }
    if (message.kind == Hdf5MessageKind::link_info) {
      Hdf5Cursor cursor(file, message.body, "a group");
      cursor.skip(1);
      if ((cursor.number(1) & 1) != 0) cursor.skip(8);
      if (!file.is_nowhere(cursor.address()))
        unread.emplace_back("the members of a group that keeps them in a fractal heap");
    }
  }
  return links;
}

std::uint64_t Hdf5Shape::count(const Hdf5Bytes& file) const {
  if (is_empty()) return 0;
  constexpr std::uint64_t most = std::uint64_t{1} << 48;
  std::uint64_t product = 1;
  for (const std::uint64_t size : sizes) {
    if (size > most / product) file.damaged("it claims an array of more numbers than any disk holds");
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
      // Booleans: an enumeration with byte values.
      const Hdf5Type base = read_type(file, body.substr(cursor.position()));
      type.word = "named values";
      if (base.kind == Hdf5Type::Kind::integer && base.width == 1 && type.width == 1) type.kind = base.kind;
      break;
    }
    case 9:
      type.word = (bits & 15) == 1 ? "texts" : "lists of running length";
      if ((bits & 15) == 1) type.kind = Hdf5Type::Kind::running_text;
      break;
    default:
      type.word = "values that are no numbers";
  }
  return type;
}

Hdf5Layout read_layout(const Hdf5Bytes& file, std::string_view body, std::size_t rank) {
  Hdf5Cursor cursor(file, body, "a data layout");
  const std::uint64_t version = cursor.number(1);
  if (version == 0 || version > 4) cursor.refuse("has a version that is not known");
  const bool old = version < 3;
  std::uint64_t sides = old ? cursor.number(1) : 0;
  const std::uint64_t kind = cursor.number(1);
  Hdf5Layout layout;
  if (old) cursor.skip(5);
  if (!old && kind == 0) {
    layout.kind = Hdf5Layout::Kind::compact;
    layout.compact = cursor.take(cursor.number(2));
  }
  if (kind != 1 && (kind != 2 || version == 4)) return layout;
  if (!old && kind == 2 && (sides = cursor.number(1)) != rank + 1)
    cursor.refuse("has chunks of other dimensions than the array");
  layout.kind = kind == 1 ? Hdf5Layout::Kind::contiguous : Hdf5Layout::Kind::chunked;
  layout.address = cursor.address();
  layout.nowhere = file.is_nowhere(layout.address);
  if (sides > most_dimensions + 1) cursor.refuse("has too many dimensions");
  for (std::uint64_t k = 0; k < sides; ++k) layout.chunk.push_back(cursor.number(4));
  layout.length = old ? 1 : kind == 1 ? cursor.length() : 0;
  for (const std::uint64_t side : layout.chunk) layout.length *= side;
  return layout;
}

std::vector<std::uint64_t> read_filters(const Hdf5Bytes& file, std::string_view body) {
  Hdf5Cursor cursor(file, body, "a list of filters");
  const std::uint64_t version = cursor.number(1), count = cursor.number(1);
  if (version != 1 && version != 2) cursor.refuse("has a version that is not known");
  if (version == 1) cursor.skip(6);
  std::vector<std::uint64_t> filters;
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::uint64_t id = cursor.number(2);
    const std::uint64_t name = version == 1 || id >= 256 ? cursor.number(2) : 0;
    cursor.skip(2);
    const std::uint64_t values = cursor.number(2);
    cursor.skip(padded(name, version == 1));
    cursor.skip(4 * values);
    if (version == 1 && values % 2 == 1) cursor.skip(4);
    filters.push_back(id);
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
  const bool kept_elsewhere = version > 1 && (flags & 3) != 0;
  if (kept_elsewhere) return attribute;
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

}  // namespace asperity
