// SPDX-License-Identifier: GPL-3.0-or-later
// A surface in HDF5: `height` of shape (ny, nx) in m and `size` (size_x, size_y) in m, plus an XDMF file.
// Reading takes `height` or the only map.
#pragma once

#include <filesystem>

#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// `size`, in metres.
Hdf5Array tile_size(const Grid& grid);

// Throws as write_hdf5().
void write_hdf5_surface(const Surface& surface, const std::filesystem::path& path);

}  // namespace asperity
