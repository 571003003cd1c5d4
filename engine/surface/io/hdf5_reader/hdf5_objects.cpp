// SPDX-License-Identifier: GPL-3.0-or-later
// Every walk is bounded by the file's size: a structure takes bytes of it, and no more structures are
// followed than bytes can hold.
#include "engine/surface/io/hdf5_reader/hdf5_objects.hpp"

#include <algorithm>

namespace asperity {

namespace {

constexpr std::string_view signature("\x89HDF\r\n\x1a\n", 8);

// Where the file begins: at 0, or after a block of the user's of 512 bytes or a power of two times that.
std::size_t start_of(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size() && bytes.size() - at >= signature.size();
       at = at == 0 ? 512 : 2 * at)
    if (bytes.substr(at, signature.size()) == signature) return at;
  return std::string_view::npos;
}

bool is_width(std::uint64_t width) { return width == 2 || width == 4 || width == 8; }

// A piece that ends with its checksum; the piece without it.
std::string_view checked(const Hdf5Bytes& file, std::string_view piece, const char* what) {
  constexpr std::size_t width = 4;
  if (piece.size() < width) file.refuse("is damaged: " + std::string(what) + " is too short");
  const std::string_view content = piece.substr(0, piece.size() - width);
  if (hdf5_checksums_are_compared &&
      Hdf5Cursor(file, piece.substr(content.size()), what).number(width) != lookup3(content))
    file.refuse("is damaged: the checksum of " + std::string(what) + " is not that of its bytes",
                "the file was altered after it was written");
  return content;
}

// Messages of a block of a header of version 1 or 2; blocks that continue it are added to `more`.
void take_messages(const Hdf5Bytes& file, std::string_view block, int version, bool ordered,
                   std::vector<Hdf5Message>& messages, std::vector<std::string_view>& more) {
  Hdf5Cursor cursor(file, block, "an object header");
  const std::size_t head = version == 1 ? 8 : ordered ? 6 : 4;
  while (cursor.left() >= head) {
    const std::uint64_t kind = cursor.number(version == 1 ? 2 : 1);
    const std::uint64_t length = cursor.number(2);
    const std::uint64_t flags = cursor.number(1);
    if (version == 1) cursor.skip(3);
    if (version == 2 && ordered) cursor.skip(2);
    const std::string_view body = cursor.take(length);
    if (kind == static_cast<std::uint64_t>(Hdf5MessageKind::continuation)) {
      Hdf5Cursor target(file, body, "a continued header");
      const std::uint64_t at = target.address();
      more.push_back(file.piece(at, target.length(), "a continued header"));
    } else if (kind != 0) {
      messages.push_back({static_cast<Hdf5MessageKind>(kind), (flags & 2) != 0, body});
    }
  }
}

// Members of a group of the older kind: a tree of nodes, whose names stand in a heap.
class SymbolTable {
 public:
  SymbolTable(const Hdf5Bytes& file, std::uint64_t heap) : file_(file) {
    Hdf5Cursor cursor(
        file, file.piece(heap, 8 + 2 * u(file.length_width) + u(file.address_width), "a heap of names"),
        "a heap of names");
    if (!cursor.starts_with("HEAP")) cursor.refuse("has no mark");
    cursor.skip(4);
    const std::uint64_t length = cursor.length();
    cursor.length();
    names_ = file.piece(cursor.address(), length, "a heap of names");
  }

  void walk(std::uint64_t node, int depth, std::vector<Hdf5Link>& links) {
    if (depth > 16 || ++nodes_ > file_.bytes.size() / 24)
      file_.refuse("is damaged: a group goes round in circles");
    const std::uint64_t start = 8 + 2 * u(file_.address_width);
    Hdf5Cursor head(
        file_, file_.piece(node, std::min<std::uint64_t>(start, file_.bytes.size()), "a node of a group"),
        "a node of a group");
    if (head.starts_with("SNOD")) {
      leaf(node, links);
      return;
    }
    if (!head.starts_with("TREE") || head.number(1) != 0) head.refuse("has no mark");
    head.skip(1);
    const std::uint64_t count = head.number(2);
    Hdf5Cursor children(file_,
                        file_.piece(node + start, count * (u(file_.length_width) + u(file_.address_width)),
                                    "a node of a group"),
                        "a node of a group");
    for (std::uint64_t k = 0; k < count; ++k) {
      children.length();
      walk(children.address(), depth + 1, links);
    }
  }

 private:
  static std::uint64_t u(int width) { return static_cast<std::uint64_t>(width); }

  void leaf(std::uint64_t node, std::vector<Hdf5Link>& links) {
    Hdf5Cursor count(file_, file_.piece(node, 8, "a node of a group"), "a node of a group");
    count.skip(6);
    const std::uint64_t entries = count.number(2);
    const std::uint64_t width = 2 * u(file_.address_width) + 24;
    Hdf5Cursor cursor(file_, file_.piece(node + 8, entries * width, "a node of a group"),
                      "a node of a group");
    for (std::uint64_t k = 0; k < entries; ++k) {
      const std::uint64_t name = cursor.address(), header = cursor.address();
      const std::uint64_t cached = cursor.number(4);
      cursor.skip(20);
      constexpr std::uint64_t soft_link = 2;
      if (cached == soft_link) continue;
      if (name >= names_.size()) cursor.refuse("has a name outside its heap");
      const std::string_view rest = names_.substr(static_cast<std::size_t>(name));
      const std::size_t end = rest.find('\0');
      if (end == std::string_view::npos) cursor.refuse("has a name without an end");
      links.push_back({std::string(rest.substr(0, end)), header});
    }
  }

  const Hdf5Bytes& file_;
  std::string_view names_;
  std::size_t nodes_ = 0;
};

// A link message of the newer kind; soft and external links lead to no object of this file.
void take_link(const Hdf5Bytes& file, const Hdf5Message& message, std::vector<Hdf5Link>& links) {
  Hdf5Cursor cursor(file, message.body, "a link");
  if (cursor.number(1) != 1) cursor.refuse("has a version that is not known");
  const std::uint64_t flags = cursor.number(1);
  const std::uint64_t type = (flags & 8) != 0 ? cursor.number(1) : 0;
  if ((flags & 4) != 0) cursor.skip(8);
  if ((flags & 16) != 0) cursor.skip(1);
  const std::uint64_t length = cursor.number(1 << (flags & 3));
  const std::string_view name = cursor.take(length);
  if (type == 0) links.push_back({std::string(name), cursor.address()});
}

}  // namespace

const Hdf5Message* Hdf5Header::find(Hdf5MessageKind kind) const {
  const auto found =
      std::find_if(messages.begin(), messages.end(), [&](const auto& m) { return m.kind == kind; });
  return found == messages.end() ? nullptr : &*found;
}

bool looks_like_hdf5(const SourceFile& file) { return start_of(file.bytes()) != std::string_view::npos; }

Hdf5Root open_hdf5(const SourceFile& file) {
  const std::size_t start = start_of(file.bytes());
  if (start == std::string_view::npos)
    refuse_file(file, "is not an HDF5 file: it does not start with \\x89HDF",
                "if it is another format, name it with `format`");
  Hdf5Root root{{file, file.bytes().substr(start), 8, 8}, 0};
  Hdf5Bytes& bytes = root.file;
  constexpr const char* what = "the superblock";
  Hdf5Cursor cursor(bytes, bytes.bytes, what);
  cursor.skip(signature.size());
  const std::uint64_t version = cursor.number(1);
  if (version > 3)
    bytes.refuse("has an HDF5 superblock of version " + std::to_string(version), "versions 0 to 3 are read");
  if (version < 2) cursor.skip(4);
  const std::uint64_t address_width = cursor.number(1), length_width = cursor.number(1);
  if (!is_width(address_width) || !is_width(length_width))
    cursor.refuse("has no sensible widths of addresses");
  bytes.address_width = static_cast<int>(address_width);
  bytes.length_width = static_cast<int>(length_width);
  cursor.skip(version < 2 ? 1 + 2 + 2 + 4 : 1);
  if (version == 1) cursor.skip(4);
  const std::uint64_t base = cursor.address();
  cursor.address();
  const std::uint64_t end = cursor.address();
  if (version < 2) {
    cursor.address();
    cursor.address();
  }
  root.address = cursor.address();
  if (version >= 2) checked(bytes, bytes.bytes.substr(0, cursor.position() + 4), what);
  // The end is counted as the base is, from wherever: what matters is how far apart they are.
  if (end < base) cursor.refuse("ends before it begins");
  const std::uint64_t length = end - base;
  if (length > bytes.bytes.size() || length < cursor.position())
    bytes.refuse("is cut short: it says that it has " + std::to_string(length) + " bytes and has " +
                     std::to_string(bytes.bytes.size()),
                 "copy it again from where it was whole");
  bytes.bytes = bytes.bytes.substr(0, static_cast<std::size_t>(length));
  return root;
}

Hdf5Header read_header(const Hdf5Bytes& file, std::uint64_t address) {
  constexpr const char* what = "an object header";
  Hdf5Header header;
  Hdf5Cursor cursor(
      file,
      file.piece(address, file.bytes.size() - std::min<std::uint64_t>(address, file.bytes.size()), what),
      what);
  std::vector<std::string_view> blocks;
  int version = 1;
  bool ordered = false;
  if (cursor.starts_with("OHDR")) {
    version = 2;
    if (cursor.number(1) != 2) cursor.refuse("has a version that is not known");
    const std::uint64_t flags = cursor.number(1);
    ordered = (flags & 4) != 0;
    if ((flags & 32) != 0) cursor.skip(16);
    if ((flags & 16) != 0) cursor.skip(4);
    const std::uint64_t length = cursor.number(1 << (flags & 3));
    const std::size_t before = cursor.position();
    cursor.skip(length);
    const std::string_view whole = checked(file, file.piece(address, before + length + 4, what), what);
    blocks.push_back(whole.substr(before));
  } else {
    if (cursor.number(1) != 1) cursor.refuse("has no mark, or a version that is not known");
    cursor.skip(1 + 2 + 4);
    const std::uint64_t length = cursor.number(4);
    cursor.skip(4);
    blocks.push_back(cursor.take(length));
  }
  std::size_t taken = 0;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    std::string_view block = blocks[k];
    taken += block.size();
    if (taken > file.bytes.size() || blocks.size() > file.bytes.size() / 16 + 1)
      file.refuse("is damaged: an object header goes round in circles");
    if (version == 2 && k > 0) {
      block = checked(file, block, "a continued header");
      if (!block.starts_with("OCHK")) file.refuse("is damaged: a continued header has no mark");
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
      SymbolTable(file, cursor.address()).walk(tree, 0, links);
    }
    if (message.kind == Hdf5MessageKind::link_info) {
      Hdf5Cursor cursor(file, message.body, "a group");
      cursor.skip(1);
      if ((cursor.number(1) & 1) != 0) cursor.skip(8);
      if (!is_nowhere(file, cursor.address()))
        unread.emplace_back("the members of a group that keeps them in a fractal heap");
    }
  }
  return links;
}

}  // namespace asperity
