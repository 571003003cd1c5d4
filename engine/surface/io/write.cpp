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

constexpr std::size_t bytes_a_piece = std::size_t{1} << 16;

[[noreturn]] void refuse_extension(const std::string& path, const std::string& known) {
  const std::string extension = file_extension(path);
  refuse_bad_file(extension.empty()
                      ? file_name(path) + " has no extension to name the format"
                      : "cannot write " + file_name(path) + ": no format has the extension ." + extension,
                  "use " + known);
}

void write_npy(const std::string& path, const std::string& shape, std::span<const double> values, int rows,
               Monitor& monitor) {
  AtomicFile file(path, FileWords::data);
  file.write(npy_header(shape));
  Task task(monitor, "writing", rows);
  const std::size_t row = values.size() / static_cast<std::size_t>(rows);
  for (int j = 0; j < rows; ++j) {
    const auto part = values.subspan(static_cast<std::size_t>(j) * row, row);
    file.write({reinterpret_cast<const char*>(part.data()), part.size_bytes()});
    task.advance();
  }
  file.commit();
}

void write_matrix(const Surface& surface, const std::string& path, char separator, Monitor& monitor) {
  const Grid& grid = surface.grid();
  const Field& heights = surface.measured_heights();
  AtomicFile file(path, FileWords::data);
  std::string text = "# asperity surface\n# cells = " + std::to_string(grid.nx) + " " +
                     std::to_string(grid.ny) + "\n# size [m] = " + format_exact(grid.size_x) + " " +
                     format_exact(grid.size_y) + "\n# unit [m] = 1\n";
  if (!surface.complete())
    text += "# not measured = " + std::to_string(grid.nodes() - surface.measured()) + ", written as nan\n";
  Task task(monitor, "writing", grid.ny);
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      if (i > 0) text += separator;
      text += format_exact(heights(i, j));
    }
    text += '\n';
    if (text.size() >= bytes_a_piece || j + 1 == grid.ny) {
      file.write(text);
      text.clear();
    }
    task.advance();
  }
  file.commit();
}

void write_trace(const Profile& profile, const std::string& path, char separator, Monitor& monitor) {
  AtomicFile file(path, FileWords::data);
  std::string text = "# asperity profile\n# samples = " + std::to_string(profile.size()) +
                     "\n# spacing [m] = " + format_exact(profile.spacing()) + "\n";
  if (profile.closed_radius())
    text += "# closed radius [m] = " + format_exact(*profile.closed_radius()) + "\n";
  const auto heights = profile.measured_heights();
  if (!profile.complete())
    text += "# not measured = " + std::to_string(heights.size() - profile.measured()) + ", written as nan\n";
  text += "# position [m], height [m]\n";
  Task task(monitor, "writing", profile.size());
  for (std::size_t k = 0; k < heights.size(); ++k) {
    text += format_exact(static_cast<double>(k) * profile.spacing()) + separator + format_exact(heights[k]) +
            '\n';
    if (text.size() >= bytes_a_piece || k + 1 == heights.size()) {
      file.write(text);
      text.clear();
    }
    task.advance();
  }
  file.commit();
}

Surface as_stored(const Surface& surface, std::string_view extension) {
  const Format* const format = format_of_extension(extension);
  if (format == nullptr || format->lines.first == FirstLine::bottom) return surface;
  Field lines = surface.measured_heights();
  turn_over(lines);
  return Surface::with_holes(surface.grid(), std::move(lines));
}

}  // namespace

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
    return write_npy(path, std::to_string(profile.size()) + ",", profile.measured_heights(), 1, monitor);
  if (extension == "txt") return write_trace(profile, path, ' ', monitor);
  if (extension == "csv") return write_trace(profile, path, ',', monitor);
  refuse_extension(path, ".csv, .txt or .npy");
}

}  // namespace asperity
