// SPDX-License-Identifier: GPL-3.0-or-later
// A surface in HDF5: `height` of shape (ny, nx) in m and `size` (size_x, size_y) in m, plus an XDMF file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/grid.hpp"
#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// XDMF describes an HDF5 file for ParaView and VisIt: a regular grid of nodes at height 0, with fields per
// node; "Warp By Scalar" raises a relief.

// Same path, extension .xdmf.
std::filesystem::path xdmf_path(const std::filesystem::path& hdf5);

// True for an HDF5 extension.
bool has_xdmf_beside(const std::filesystem::path& file);

// Arrays of shape (ny, nx) in `hdf5`, in the same folder.
std::string xdmf_text(const Grid& grid, std::string_view name, const Hdf5Content& content,
                      const std::filesystem::path& hdf5);

// HDF5 first: the description never names missing data. Throws as write_hdf5().
void write_hdf5_and_xdmf(const std::filesystem::path& hdf5, const Grid& grid, std::string_view name,
                         const Hdf5Content& content);

// `size`, in metres.
Hdf5Array tile_size(const Grid& grid);

// Throws as write_hdf5().
void write_hdf5_surface(const Surface& surface, const std::filesystem::path& path);

}  // namespace asperity
