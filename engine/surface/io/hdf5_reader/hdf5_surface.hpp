// SPDX-License-Identifier: GPL-3.0-or-later
// A surface as an HDF5 file: `height` of shape (ny, nx) in m and `size` (size_x, size_y) in m, with an XDMF
// file beside it. Reading takes `height` or the only map in the file, whoever wrote it.
#pragma once

#include <filesystem>

#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// The array `size` of a tile, which says in metres what the fields of a file span.
Hdf5Array tile_size(const Grid& grid);

// Throws as write_hdf5.
void write_hdf5_surface(const Surface& surface, const std::filesystem::path& path);

}  // namespace asperity
