// SPDX-License-Identifier: GPL-3.0-or-later
// XDMF describes an HDF5 file for ParaView and VisIt: a regular grid of nodes (i hx, j hy) at height 0,
// with fields per node. A filter such as ParaView's "Warp By Scalar" raises a relief.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/grid.hpp"
#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"

namespace asperity {

// Same path, extension .xdmf.
std::filesystem::path xdmf_path(const std::filesystem::path& hdf5);

// True for an HDF5 extension.
bool has_xdmf_beside(const std::filesystem::path& file);

// For arrays of shape (ny, nx); `hdf5` is their file in the same folder.
std::string xdmf_text(const Grid& grid, std::string_view name, const Hdf5Content& content,
                      const std::filesystem::path& hdf5);

// Writes the HDF5 file first, so the description never names missing data. Throws as write_hdf5().
void write_hdf5_and_xdmf(const std::filesystem::path& hdf5, const Grid& grid, std::string_view name,
                         const Hdf5Content& content);

}  // namespace asperity
