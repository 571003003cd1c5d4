// SPDX-License-Identifier: GPL-3.0-or-later
// NumPy's NPY format, versions 1 to 3. Shape is (ny, nx) for a surface and (n,) for a trace. Objects, records
// and complex numbers are refused.
#include "engine/core/files/text_table.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/npy_header.hpp"

namespace asperity {

namespace {

constexpr std::string_view magic("\x93NUMPY", 6);

struct NpyType {
  std::string_view name;
  NumberType little, big;
};
template <class T>
constexpr NpyType npy_type(std::string_view name) {
  return {name, number_type<T>, number_type<T, big_endian<T>>};
}
constexpr std::array npy_types{npy_type<float>("f4"),         npy_type<double>("f8"),
                               npy_type<std::int8_t>("i1"),   npy_type<std::int16_t>("i2"),
                               npy_type<std::int32_t>("i4"),  npy_type<std::int64_t>("i8"),
                               npy_type<std::uint8_t>("u1"),  npy_type<std::uint16_t>("u2"),
                               npy_type<std::uint32_t>("u4"), npy_type<std::uint64_t>("u8")};

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

HeightMap read_npy(const SourceFile& file, Monitor& monitor) {
  const NpyHeader header = read_npy_header(file);
  if (header.shape.empty() || header.shape.size() > 2)
    refuse_file(file, "holds an array of " + std::to_string(header.shape.size()) + " dimensions",
                "a surface has shape (ny, nx), a trace (n,)");
  const std::uint64_t ny = header.shape.size() == 2 ? header.shape[0] : 1;
  const std::uint64_t nx = header.shape.back();
  if (nx == 0 || ny == 0) refuse_file(file, "holds an array without elements");
  const std::string_view data = file.bytes().substr(header.data_at);
  HeightMap map;
  map.trace = header.shape.size() == 1;
  if (!header.fortran_order) {
    map.heights = exact_field(file, header.type, data, nx, ny, monitor);
    return map;
  }
  const Field columns = exact_field(file, header.type, data, ny, nx, monitor);
  map.heights = Field(static_cast<int>(nx), static_cast<int>(ny));
  for (std::uint64_t k = 0; k < nx * ny; ++k) map.heights[k] = columns[k % nx * ny + k / nx];
  return map;
}

}  // namespace

NpyHeader read_npy_header(const SourceFile& file) {
  if (!file.bytes().starts_with(magic))
    refuse_file(file, "is not a NPY file: it does not start with \\x93NUMPY");
  BinaryCursor cursor(file, file.bytes(), "its NPY header");
  cursor.skip(magic.size());
  const int version = cursor.number<std::uint8_t>();
  cursor.skip(1);
  if (version < 1 || version > 3)
    refuse_file(file, "has NPY version " + std::to_string(version), "1 to 3 are read");
  const std::uint32_t length = version == 1 ? cursor.number<std::uint16_t>() : cursor.number<std::uint32_t>();
  const std::string_view dictionary = cursor.take(length);

  NpyHeader header;
  header.data_at = cursor.position();
  const std::string_view descr = value_of(dictionary, "descr");
  const std::string_view type =
      descr.size() > 1 ? descr.substr(1, descr.find(descr[0], 1) - 1) : std::string_view();
  const bool ordered = !type.empty() && std::string_view("<>|=").find(type[0]) != std::string_view::npos;
  const auto known = std::ranges::find(npy_types, ordered ? type.substr(1) : "", &NpyType::name);
  if (known == npy_types.end())
    refuse_file(file, "holds numbers of type " + shown(type.empty() ? descr : type),
                "save it as float64; f4, f8, i1 … i8 and u1 … u8 are read");
  header.type = type[0] == '>' ? known->big : known->little;
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

std::string npy_header(const std::string& shape) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + shape + "), }";
  constexpr std::size_t before = 10, alignment = 64;
  header.append(alignment - (before + header.size() + 1) % alignment, ' ');
  header += '\n';
  std::string start = std::string(magic) + std::string("\x01\x00", 2);
  start += static_cast<char>(header.size() & 0xFF);
  start += static_cast<char>(header.size() >> 8);
  return start + header;
}

extern constexpr Format npy_format{
    "npy",
    "\\x93NUMPY at the start",
    {"NumPy arrays of one or two axes, integers or floating-point numbers.",
     "Complex numbers, records and objects; arrays of three axes.", "Arrays written by NumPy."},
    {FirstLine::bottom, "A matrix: its first row is j = 0."},
    {"npy"},
    begins_with<magic>,
    read_npy};

}  // namespace asperity
