// SPDX-License-Identifier: GPL-3.0-or-later
// PLU of Sensofar's profilers (PLu 2300, PLu neox): date, comment, calibration, settings, then the layers,
// single precision. All lengths are in micrometres. A missing point is 1000001. Layout: Gwyddion's and
// SurfaceTopography's readers. The only mark is the form of its date.
#include <cctype>

#include "engine/surface/io/instruments/instrument_header.hpp"

namespace asperity {

namespace {

constexpr std::size_t plu_header_bytes = 500, plu_date_bytes = 128, plu_comment_bytes = 256;

// "Fri Mar 10 16:35:59 2023" and a zero byte.
bool recognises_plu(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  constexpr std::string_view form("Aaa Aaa 00 00:00:00 0000\0", 25);
  if (bytes.size() < form.size()) return false;
  for (std::size_t k = 0; k < form.size(); ++k) {
    const auto byte = static_cast<unsigned char>(bytes[k]);
    const bool fits = form[k] == 'A'   ? std::isupper(byte) != 0
                      : form[k] == 'a' ? std::islower(byte) != 0
                      : form[k] == '0' ? std::isdigit(byte) != 0 || (k == 8 && byte == ' ')
                                       : byte == static_cast<unsigned char>(form[k]);
    if (!fits) return false;
  }
  return true;
}

HeightMap read_plu(const SourceFile& file, Monitor& monitor) {
  BinaryCursor cursor(file, file.bytes(), "its header of 508 bytes");
  cursor.skip(plu_date_bytes + 4 + plu_comment_bytes);
  const std::uint64_t lines = cursor.number<std::uint32_t>(), columns = cursor.number<std::uint32_t>();
  cursor.skip(4 + 4);
  const double dx = std::abs(static_cast<double>(cursor.number<float>()));
  const double dy = std::abs(static_cast<double>(cursor.number<float>()));
  cursor.skip(4 * 4);
  const std::uint32_t type = cursor.number<std::uint32_t>();
  constexpr std::uint32_t topography = 3;
  if (type != topography)
    refuse_file(file, "holds a measurement of type " + std::to_string(type) + ", which is no topography",
                "topographies are read: type 3");
  cursor.skip(4 * 4 + 40 + 1);
  const int layers = cursor.number<std::uint8_t>();
  cursor.skip(plu_header_bytes - cursor.position());
  const std::uint64_t ny = cursor.number<std::uint32_t>(), nx = cursor.number<std::uint32_t>();
  if (nx != columns || ny != lines)
    refuse_file(file,
                "holds " + std::to_string(columns) + " x " + std::to_string(lines) +
                    " points by its header and by its first layer " + std::to_string(nx) + " x " +
                    std::to_string(ny),
                "its header is wrong or the file is damaged");
  const std::string_view data = file.bytes().substr(cursor.position());
  require_numbers(file, nx, ny, sizeof(float), data.size());
  if (layers > 1)
    monitor.warn(file_name(file.path()) + " holds " + std::to_string(layers) + " layers; the first is read");
  constexpr double missing = 1000001;
  constexpr double micrometre = 1e-6;
  constexpr const char* distance = "um as the distance of its points";
  return {.heights = field_of_numbers(number_type<float>, data, nx, ny, monitor,
                                      [](double value) { return value == missing; }),
          .unit = micrometre,
          .size_x = above_zero(file, dx, distance) * micrometre * static_cast<double>(nx),
          .size_y = above_zero(file, dy, distance) * micrometre * static_cast<double>(ny)};
}

}  // namespace

extern constexpr Format plu_format{
    "plu",
    "a date of 24 letters and a zero byte at the start",
    {"PLU of Sensofar profilers: the first layer of a topography.",
     "Profiles, pictures, thicknesses; pictures beside a topography are passed over.",
     "Two files of the public test sets of SurfaceTopography and surfalize, every height and size; they "
     "have no missing points."},
    {FirstLine::top, "Gwyddion's reader shows the first line at the top."},
    {"plu", "apx"},
    recognises_plu,
    read_plu};

}  // namespace asperity
