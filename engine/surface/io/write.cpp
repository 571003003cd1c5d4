// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers are written in the shortest form that reads back.
#include "engine/surface/io/write.hpp"

#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/hdf5_surface.hpp"
#include "engine/surface/io/npy_header.hpp"

namespace asperity {

void write_gwy(const Surface& surface, const std::string& path);
void write_x3p(const Surface& surface, const std::string& path);
void write_sdf(const Surface& surface, const std::string& path, Monitor& monitor);
void write_sur(const Surface& surface, const std::string& path, Monitor& monitor);

namespace {

[[noreturn]] void refuse_extension(const std::string& path, const std::string& known) {
  const std::string extension = file_extension(path);
  refuse_bad_file(extension.empty()
                      ? file_name(path) + " has no extension to name the format"
                      : "cannot write " + file_name(path) + ": no format has the extension ." + extension,
                  "use " + known);
}

void write_npy(const std::string& path, const std::string& shape, std::span<const double> values, int rows,
               Monitor& monitor) {
  const std::size_t row = values.size() / static_cast<std::size_t>(rows);
  const auto append = [&](std::int64_t j, std::string& bytes) {
    const auto part = values.subspan(static_cast<std::size_t>(j) * row, row);
    bytes.append(reinterpret_cast<const char*>(part.data()), part.size_bytes());
  };
  write_rows(path, npy_header(shape), rows, append, monitor);
}

void write_matrix(const Surface& surface, const std::string& path, char separator, Monitor& monitor) {
  const Grid& grid = surface.grid();
  const Field& heights = surface.measured_heights();
  std::string head = "# asperity surface\n# cells = " + std::to_string(grid.nx) + " " +
                     std::to_string(grid.ny) + "\n# size [m] = " + format_exact(grid.size_x) + " " +
                     format_exact(grid.size_y) + "\n# unit [m] = 1\n";
  if (!surface.complete())
    head += "# not measured = " + std::to_string(grid.nodes() - surface.measured()) + ", written as nan\n";
  const auto append = [&](std::int64_t j, std::string& text) {
    for (int i = 0; i < grid.nx; ++i) {
      if (i > 0) text += separator;
      text += format_exact(heights(i, static_cast<int>(j)));
    }
    text += '\n';
  };
  write_rows(path, std::move(head), grid.ny, append, monitor);
}

void write_trace(const Profile& profile, const std::string& path, char separator, Monitor& monitor) {
  std::string head = "# asperity profile\n# samples = " + std::to_string(profile.size()) +
                     "\n# spacing [m] = " + format_exact(profile.spacing()) + "\n";
  if (profile.closed_radius())
    head += "# closed radius [m] = " + format_exact(*profile.closed_radius()) + "\n";
  const auto heights = profile.measured_heights();
  if (!profile.complete())
    head += "# not measured = " + std::to_string(heights.size() - profile.measured()) + ", written as nan\n";
  head += "# position [m], height [m]\n";
  const auto append = [&](std::int64_t k, std::string& text) {
    text += format_exact(static_cast<double>(k) * profile.spacing()) + separator +
            format_exact(heights[static_cast<std::size_t>(k)]) + '\n';
  };
  write_rows(path, std::move(head), profile.size(), append, monitor);
}

Surface as_stored(const Surface& surface, std::string_view extension) {
  const Format* const format = format_of_extension(extension);
  if (format == nullptr || format->lines.first == FirstLine::bottom) return surface;
  Field lines = surface.measured_heights();
  turn_over(lines);
  return Surface::with_holes(surface.grid(), std::move(lines));
}

}  // namespace

void write_rows(const std::string& path, std::string head, std::int64_t rows,
                const std::function<void(std::int64_t row, std::string& bytes)>& append, Monitor& monitor) {
  constexpr std::size_t bytes_a_piece = std::size_t{1} << 16;
  AtomicFile file(path, FileWords::data);
  std::string bytes = std::move(head);
  Task task(monitor, "writing", rows);
  for (std::int64_t row = 0; row < rows; ++row) {
    append(row, bytes);
    if (bytes.size() >= bytes_a_piece || row + 1 == rows) {
      file.write(bytes);
      bytes.clear();
    }
    task.advance();
  }
  file.commit();
}

void write_surface(const Surface& given, const std::string& path, Monitor& monitor) {
  const std::string extension = file_extension(path);
  const Surface surface = as_stored(given, extension);
  const Grid& grid = surface.grid();
  if (extension == "npy")
    return write_npy(path, std::to_string(grid.ny) + ", " + std::to_string(grid.nx),
                     surface.measured_heights().values(), grid.ny, monitor);
  if (extension == "x3p") return write_x3p(surface, path);
  if (extension == "h5" || extension == "hdf5") return write_hdf5_surface(surface, path);
  if (extension == "gwy") return write_gwy(surface, path);
  if (extension == "sur") return write_sur(surface, path, monitor);
  if (extension == "sdf") return write_sdf(surface, path, monitor);
  if (extension == "txt" || extension == "asc") return write_matrix(surface, path, ' ', monitor);
  if (extension == "csv") return write_matrix(surface, path, ',', monitor);
  refuse_extension(path, ".h5, .npy, .x3p, .gwy, .sdf, .sur, .txt, .asc or .csv");
}

void write_profile(const Profile& profile, const std::string& path, Monitor& monitor) {
  const std::string extension = file_extension(path);
  if (extension == "npy")
    return write_npy(path, std::to_string(profile.size()) + ",", profile.measured_heights(), profile.size(),
                     monitor);
  if (extension == "txt") return write_trace(profile, path, ' ', monitor);
  if (extension == "csv") return write_trace(profile, path, ',', monitor);
  refuse_extension(path, ".csv, .txt or .npy");
}

}  // namespace asperity
