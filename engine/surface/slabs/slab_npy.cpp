// SPDX-License-Identifier: GPL-3.0-or-later
// NPY files in slabs: each process reads its rows; blocks are written in sequence.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/require.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/npy_header.hpp"
#include "engine/surface/slabs/slab_surface.hpp"

namespace asperity {

namespace {

struct SlabFile {
  NpyHeader header;
  int nx = 0, ny = 0;
};

SlabFile open_npy(const std::string& path, std::ifstream& stream) {
  std::error_code failure;
  stream.open(path, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(path, failure))
    throw Error(ErrorCode::bad_file, "there is no file " + file_name(path) + " that can be read");
  constexpr std::size_t head = std::size_t{1} << 17;
  std::string bytes(head, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(head));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  stream.clear();
  const SourceFile file(path, bytes);
  SlabFile found;
  found.header = read_npy_header(file);
  const NpyHeader& header = found.header;
  if (header.shape.size() != 2)
    refuse_file(file, "holds an array of " + std::to_string(header.shape.size()) + " dimensions",
                "a surface has shape (ny, nx)");
  if (header.fortran_order)
    refuse_file(file, "keeps its columns together, so that no process could read its rows alone",
                "save it with numpy.ascontiguousarray");
  const std::uint64_t ny = header.shape[0], nx = header.shape[1];
  const std::uint64_t present = std::filesystem::file_size(path, failure) - header.data_at;
  constexpr std::uint64_t most = max_cells;
  if (nx < 1 || ny < 1 || nx > most || ny > most || nx * ny * header.width != present)
    refuse_file(file,
                "says in its header that it holds " + std::to_string(ny) + " x " + std::to_string(nx) +
                    " numbers of " + std::to_string(header.width) + " bytes but has " +
                    std::to_string(present) + " bytes of data",
                "the file is cut short or its header is wrong; a side has at most " +
                    std::to_string(max_cells) + " cells");
  found.nx = static_cast<int>(nx);
  found.ny = static_cast<int>(ny);
  return found;
}

std::string npy_head(int nx, int ny) {
  std::string dictionary =
      "{'descr': '" + std::string(std::endian::native == std::endian::little ? "<" : ">") +
      "f8', 'fortran_order': False, 'shape': (" + std::to_string(ny) + ", " + std::to_string(nx) + "), }";
  constexpr std::size_t start = 10, aligned = 64;
  dictionary.append(aligned - 1 - (start + dictionary.size()) % aligned, ' ');
  dictionary += '\n';
  std::string head("\x93NUMPY\x01\x00", 8);
  head += static_cast<char>(dictionary.size() & 0xff);
  head += static_cast<char>(dictionary.size() >> 8);
  return head + dictionary;
}

}  // namespace

SlabSurface slab_read(Team& team, const std::string& path, const SlabFileOptions& options, Monitor& monitor) {
  if (!options.size_x || !options.size_y)
    refuse(file_name(path) + " does not say its size", "give `size` in the call");
  SlabFile file;
  std::ifstream stream;
  team.work([&] { file = open_npy(path, stream); });
  team.agree();
  const NpyNumber number = npy_number(file.header);
  const bool swap = file.header.swapped();
  const double unit = options.unit.value_or(1);
  std::string bytes;
  const auto row = [&](int j, double* to) {
    const std::size_t length = static_cast<std::size_t>(file.nx) * file.header.width;
    bytes.resize(length);
    stream.seekg(static_cast<std::streamoff>(file.header.data_at + static_cast<std::size_t>(j) * length));
    stream.read(bytes.data(), static_cast<std::streamsize>(length));
    if (!stream) throw Error(ErrorCode::bad_file, file_name(path) + " changed while it was read");
    for (int i = 0; i < file.nx; ++i) {
      to[i] = unit * number(bytes.data() + static_cast<std::size_t>(i) * file.header.width, swap);
      if (std::isnan(to[i]))
        refuse(file_name(path) + " has no height at node (" + std::to_string(i) + ", " + std::to_string(j) +
                   "), and over ranks every point is needed",
               "read it with lab.surface.read, whose `fill` fills what was not measured, and write it again");
    }
  };
  return slab_surface(team, {file.nx, file.ny, *options.size_x, *options.size_y}, row, monitor);
}

void write_slabs(Team& team, const Slab& slab, const SlabRow& row, const std::string& path,
                 Monitor& monitor) {
  constexpr int rows_a_turn = 64;
  Array<double> out, in;
  std::optional<AtomicFile> file;
  std::vector<int> out_counts, in_counts;
  std::optional<Task> task;
  team.work([&] {
    out.resize(slab.width() * rows_a_turn);
    in.resize(slab.rank == 0 ? slab.width() * rows_a_turn : 0);
    out_counts.resize(static_cast<std::size_t>(slab.ranks));
    in_counts.resize(static_cast<std::size_t>(slab.ranks));
    task.emplace(monitor, "writing", slab.ny);
    if (slab.rank != 0) return;
    file.emplace(path, FileWords::data);
    file->write(npy_head(slab.nx, slab.ny));
  });
  team.agree();
  for (int owner = 0; owner < slab.ranks; ++owner) {
    for (int done = 0; done < slab.rows_of(owner); done += rows_a_turn) {
      const int rows = std::min(rows_a_turn, slab.rows_of(owner) - done);
      const int count = rows * slab.nx;
      out_counts[0] = slab.rank == owner ? count : 0;
      std::fill(in_counts.begin(), in_counts.end(), 0);
      if (slab.rank == 0) in_counts[static_cast<std::size_t>(owner)] = count;
      if (slab.rank == owner)
        team.work([&] {
          for (int j = 0; j < rows; ++j)
            row(slab.first() + done + j, out.data() + static_cast<std::size_t>(j) * slab.width());
        });
      team.exchange(out.data(), out_counts.data(), in.data(), in_counts.data());
      team.work([&] {
        if (slab.rank == 0)
          file->write(
              {reinterpret_cast<const char*>(in.data()), static_cast<std::size_t>(count) * sizeof(double)});
        task->advance(rows);
      });
      team.agree();
    }
  }
  team.work([&] {
    if (file) file->commit();
  });
  team.agree();
}

}  // namespace asperity
