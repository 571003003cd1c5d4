// SPDX-License-Identifier: GPL-3.0-or-later
// NumPy's NPY format, versions 1 to 3. Shape is (ny, nx) for a surface and (n,) for a trace. The data size
// is checked against the file before any allocation. Objects, records and complex numbers are refused.
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "engine/core/error.hpp"
#include "engine/core/files/text_table.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/npy_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view magic("\x93NUMPY", 6);

// The text after "'key':", or empty.
std::string_view value_of(std::string_view dictionary, std::string_view key) {
  for (const char quote : {'\'', '"'}) {
    const std::string name = quote + std::string(key) + quote;
    const std::size_t at = dictionary.find(name);
    if (at == std::string_view::npos) continue;
    const std::size_t colon = dictionary.find_first_not_of(' ', at + name.size());
    if (colon == std::string_view::npos || dictionary[colon] != ':') continue;
    const std::size_t start = dictionary.find_first_not_of(' ', colon + 1);
    return start == std::string_view::npos ? std::string_view() : dictionary.substr(start);
  }
  return {};
}

}  // namespace

NpyHeader read_npy_header(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  require_format(file, bytes.starts_with(magic), "is not a NPY file: it does not start with \\x93NUMPY");
  if (bytes.size() < 10) refuse_file(file, "is cut short in its NPY header");
  const auto byte = [&](std::size_t at) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at]));
  };
  const std::size_t version = byte(6);
  if (version < 1 || version > 3)
    refuse_file(file, "has NPY version " + std::to_string(version), "1 to 3 are read");
  const std::size_t start = version == 1 ? 10 : 12;
  if (bytes.size() < start) refuse_file(file, "is cut short in its NPY header");
  std::size_t length = byte(8) | byte(9) << 8;
  if (version > 1) length |= byte(10) << 16 | byte(11) << 24;
  if (length > bytes.size() - start) refuse_file(file, "is cut short in its NPY header");
  const std::string_view dictionary = bytes.substr(start, length);

  NpyHeader header;
  header.data_at = start + length;
  const std::string_view descr = value_of(dictionary, "descr");
  const std::string_view type =
      descr.size() > 1 ? descr.substr(1, descr.find(descr[0], 1) - 1) : std::string_view();
  const bool known = type.size() == 3 && std::string_view("<>|=").find(type[0]) != std::string_view::npos &&
                     (((type[1] == 'i' || type[1] == 'u') &&
                       std::string_view("1248").find(type[2]) != std::string_view::npos) ||
                      (type[1] == 'f' && (type[2] == '4' || type[2] == '8')));
  if (!known)
    refuse_file(file, "holds numbers of type " + shown(type.empty() ? descr : type),
                "save it as float64; f4, f8, i1 … i8 and u1 … u8 are read");
  header.order = type[0];
  header.kind = type[1];
  header.width = static_cast<std::size_t>(type[2] - '0');
  const std::string_view order = value_of(dictionary, "fortran_order");
  header.fortran_order = order.starts_with("True");
  if (!header.fortran_order && !order.starts_with("False"))
    refuse_file(file, "has a NPY header without fortran_order");

  std::string_view shape = value_of(dictionary, "shape");
  const std::size_t close = shape.find(')');
  if (!shape.starts_with("(") || close == std::string_view::npos)
    refuse_file(file, "has a NPY header without shape");
  for (const std::string_view part : cells_of(shape.substr(1, close - 1), Separator::comma)) {
    if (part.empty()) continue;
    if (part.size() > 18 || part.find_first_not_of("0123456789") != std::string_view::npos)
      refuse_file(file, "has a NPY shape that is no list of counts: " + shown(shape));
    header.shape.push_back(std::stoull(std::string(part)));
  }
  return header;
}

namespace {

template <class T>
double element(const char* at, bool swap) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), at, sizeof(T));
  if (swap)
    for (std::size_t k = 0; k < sizeof(T) / 2; ++k) std::swap(raw[k], raw[sizeof(T) - 1 - k]);
  return static_cast<double>(std::bit_cast<T>(raw));
}

}  // namespace

NpyNumber npy_number(const NpyHeader& header) {
  const std::string type = header.kind + std::to_string(header.width);
  if (type == "f4") return element<float>;
  if (type == "f8") return element<double>;
  if (type == "i1") return element<std::int8_t>;
  if (type == "i2") return element<std::int16_t>;
  if (type == "i4") return element<std::int32_t>;
  if (type == "i8") return element<std::int64_t>;
  if (type == "u1") return element<std::uint8_t>;
  if (type == "u2") return element<std::uint16_t>;
  if (type == "u4") return element<std::uint32_t>;
  return element<std::uint64_t>;
}

bool NpyHeader::swapped() const {
  return order == '>' ? std::endian::native == std::endian::little
                      : order == '<' && std::endian::native == std::endian::big;
}

namespace {

bool recognises_npy(const SourceFile& file) { return file.bytes().starts_with(magic); }

HeightMap read_npy(const SourceFile& file, Monitor& monitor) {
  const NpyHeader header = read_npy_header(file);
  if (header.shape.empty() || header.shape.size() > 2)
    refuse_file(file, "holds an array of " + std::to_string(header.shape.size()) + " dimensions",
                "a surface has shape (ny, nx), a trace (n,)");
  const std::uint64_t ny = header.shape.size() == 2 ? header.shape[0] : 1;
  const std::uint64_t nx = header.shape.back();
  if (nx == 0 || ny == 0) refuse_file(file, "holds an array without elements");
  const std::uint64_t present = file.bytes().size() - header.data_at;
  const std::uint64_t room = present / header.width;
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  if (nx > most || ny > most || nx > room / ny || nx * ny * header.width != present)
    refuse_file(file,
                "says in its header that it holds " + std::to_string(ny) + " x " + std::to_string(nx) +
                    " numbers of " + std::to_string(header.width) + " bytes but has " +
                    std::to_string(present) + " bytes of data",
                "the file is cut short or its header is wrong");
  HeightMap map;
  map.trace = header.shape.size() == 1;
  map.heights = Field(static_cast<int>(nx), static_cast<int>(ny));
  const bool swap = header.swapped();
  const NpyNumber reader = npy_number(header);
  const char* const data = file.bytes().data() + header.data_at;
  Task task(monitor, "reading", static_cast<std::int64_t>(ny));
  for (std::uint64_t j = 0; j < ny; ++j) {
    for (std::uint64_t i = 0; i < nx; ++i) {
      const std::uint64_t k = header.fortran_order ? i * ny + j : j * nx + i;
      map.heights[j * nx + i] = reader(data + k * header.width, swap);
    }
    task.advance();
  }
  return map;
}

}  // namespace

const Format& npy_format() {
  static const Format format{
      "npy",
      "\\x93NUMPY at the start",
      {"NumPy arrays of one or two axes, integers or floating-point numbers.",
       "Complex numbers, records and objects; arrays of three axes.", "Arrays written by NumPy."},
      {FirstLine::bottom, "A matrix: its first row is j = 0."},
      {"npy"},
      recognises_npy,
      read_npy};
  return format;
}

}  // namespace asperity
