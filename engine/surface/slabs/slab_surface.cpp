// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/slabs/slab_surface.hpp"

#include <filesystem>
#include <fstream>

#include "engine/core/digest.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/io/npy_header.hpp"

namespace asperity {

namespace {

// Combines the digests of all slabs.
std::string digest_of(Team& team, const Grid& grid, const Array<double>& heights) {
  Digester own;
  std::array<double, 32> letters{};
  team.work([&] {
    own.add(std::span<const double>(heights));
    const std::string hex = own.hex();
    std::copy(hex.begin(), hex.end(), letters.begin());
  });
  const Array<double> all = team.gather(letters);
  Digester together;
  together.add(grid.nx).add(grid.ny).add(grid.size_x).add(grid.size_y).add(std::span<const double>(all));
  return together.hex();
}

void check_finite(const Slab& slab, const Array<double>& heights) {
  for (std::size_t k = 0; k < heights.size(); ++k)
    if (!std::isfinite(heights[k]))
      refuse("the height of node (" + std::to_string(k % slab.width()) + ", " +
                 std::to_string(static_cast<std::size_t>(slab.first()) + k / slab.width()) + ") is " +
                 format_short(heights[k]),
             "every height must be a finite number of metres");
}

SlabSurface finish(Team& team, const Grid& grid, std::shared_ptr<Array<double>> heights) {
  SlabSurface surface;
  surface.grid = grid;
  surface.slab = team.slab(grid.nx, grid.ny);
  std::array<double, 3> own{0, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::infinity()};
  team.work([&] {
    check_finite(surface.slab, *heights);
    own[0] = block_sum(*heights);
    if (heights->empty()) return;
    const Range between = range(*heights);
    own[1] = between.min;
    own[2] = -between.max;
  });
  const auto found = team.reduce<1, 2>(own);
  const double n = surface.slab.all_nodes();
  surface.mean = found[0] / n;
  surface.valley = found[1];
  surface.peak = -found[2];
  std::array<double, 1> squares{};
  for (const double h : *heights) squares[0] += (h - surface.mean) * (h - surface.mean);
  surface.rms = std::sqrt(team.reduce<1>(squares)[0] / n);
  surface.digest = digest_of(team, grid, *heights);
  surface.heights = std::move(heights);
  return surface;
}

struct SlabFile {
  NpyHeader header;
  int nx = 0, ny = 0;
};

SlabFile open_npy(const std::string& path, std::ifstream& stream) {
  std::error_code failure;
  stream.open(path, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(path, failure))
    refuse_bad_file("there is no file " + file_name(path) + " that can be read");
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
    refuse_file(file, "is stored by columns, and ranks read rows", "save it with numpy.ascontiguousarray");
  const std::uint64_t ny = header.shape[0], nx = header.shape[1];
  const std::uint64_t present = std::filesystem::file_size(path, failure) - header.data_at;
  constexpr std::uint64_t most = max_cells;
  if (nx < 1 || ny < 1 || nx > most || ny > most || nx * ny * header.type.width != present)
    refuse_file(file,
                "says in its header that it holds " + std::to_string(ny) + " x " + std::to_string(nx) +
                    " numbers of " + std::to_string(header.type.width) + " bytes but has " +
                    std::to_string(present) + " bytes of data",
                "the file is cut short or its header is wrong; a side has at most " +
                    std::to_string(max_cells) + " cells");
  found.nx = static_cast<int>(nx);
  found.ny = static_cast<int>(ny);
  return found;
}

}  // namespace

SlabSurface slab_surface(Team& team, const Grid& asked, const SlabRow& row, Monitor& monitor) {
  const Grid grid = make_grid(asked.nx, asked.ny, asked.size_x, asked.size_y);
  const Slab slab = team.slab(grid.nx, grid.ny);
  std::shared_ptr<Array<double>> heights;
  team.work([&] {
    heights = std::make_shared<Array<double>>(slab.nodes());
    Task task(monitor, "heights in slabs", std::max(1, slab.rows()));
    for (int j = 0; j < slab.rows(); ++j, task.advance())
      row(slab.first() + j, heights->data() + static_cast<std::size_t>(j) * slab.width());
  });
  team.agree();
  return finish(team, grid, std::move(heights));
}

SlabSurface slab_flat(Team& team, const Grid& grid, Monitor& monitor) {
  return slab_surface(
      team, grid, [&](int, double* to) { std::fill_n(to, grid.nx, 0.0); }, monitor);
}

SlabSurface slab_sine(Team& team, const SineOptions& options, Monitor& monitor) {
  const SineFactors factors = sine_factors(options);
  const auto row = [&](int j, double* to) {
    for (std::size_t i = 0; i < factors.x.size(); ++i)
      to[i] = options.amplitude * (factors.x[i] * factors.y[static_cast<std::size_t>(j)]);
  };
  return slab_surface(team, options.grid, row, monitor);
}

SlabSurface slab_self_affine(Team& team, const SelfAffineOptions& options, Monitor& monitor) {
  const Grid grid = make_grid(options.grid.nx, options.grid.ny, options.grid.size_x, options.grid.size_y);
  const SelfAffineBand band = checked_band(options, grid);
  const Slab slab = team.slab(grid.nx, grid.ny);
  const std::unique_ptr<SlabFourier> fourier = team.fourier(grid.nx, grid.ny);
  std::array<double, 2> sums{};
  team.work([&] {
    SelfAffineModes modes(options, grid, band);
    const int waves = fourier->waves(), first = fourier->first_wave();
    parallel_for(waves, [&](std::int64_t a) {
      for (int b = 0; b < grid.ny; ++b) fourier->bin(first + static_cast<int>(a), b) = 0;
    });
    Task task(monitor, "self-affine surface in slabs", modes.turns());
    modes.fill(first, waves, task, [&](int a, int b, std::complex<double> z) { fourier->bin(a, b) = z; });
    sums = {modes.mean_square_height(), modes.mean_square_slope()};
  });
  sums = team.reduce<2>(sums);
  if (sums[0] == 0) refuse_empty(band);
  double scale = self_affine_scale(options, std::sqrt(sums[0]), std::sqrt(sums[1]));
  fourier->inverse();
  if (options.ra) {
    std::array<double, 1> absolute{};
    for (int j = 0; j < slab.rows(); ++j)
      for (int i = 0; i < grid.nx; ++i) absolute[0] += std::abs(scale * fourier->row(j)[i]);
    scale *= *options.ra / (team.reduce<1>(absolute)[0] / slab.all_nodes());
  }
  std::shared_ptr<Array<double>> heights;
  team.work([&] {
    heights = std::make_shared<Array<double>>(slab.nodes());
    for (int j = 0; j < slab.rows(); ++j)
      std::transform(fourier->row(j), fourier->row(j) + grid.nx,
                     heights->begin() + static_cast<std::ptrdiff_t>(j) * grid.nx,
                     [scale](double z) { return z * scale; });
  });
  team.agree();
  return finish(team, grid, std::move(heights));
}

SlabSurface slab_read(Team& team, const std::string& path, const SlabFileOptions& options, Monitor& monitor) {
  if (!options.size_x || !options.size_y)
    refuse(file_name(path) + " does not say its size", "give `size` in the call");
  SlabFile file;
  std::ifstream stream;
  team.work([&] { file = open_npy(path, stream); });
  team.agree();
  const NumberType type = file.header.type;
  const double unit = options.unit.value_or(1);
  std::string bytes;
  const auto row = [&](int j, double* to) {
    const std::size_t length = static_cast<std::size_t>(file.nx) * type.width;
    bytes.resize(length);
    stream.seekg(static_cast<std::streamoff>(file.header.data_at + static_cast<std::size_t>(j) * length));
    stream.read(bytes.data(), static_cast<std::streamsize>(length));
    if (!stream) refuse_bad_file(file_name(path) + " changed while it was read");
    for (int i = 0; i < file.nx; ++i) {
      to[i] = unit * type.read(bytes.data() + static_cast<std::size_t>(i) * type.width);
      if (std::isnan(to[i]))
        refuse(file_name(path) + " has no height at node (" + std::to_string(i) + ", " + std::to_string(j) +
                   "), and over ranks every point is needed",
               "fill it with the key `fill` of lab.surface.read, and write it again");
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
    file->write(npy_header(std::to_string(slab.ny) + ", " + std::to_string(slab.nx)));
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
