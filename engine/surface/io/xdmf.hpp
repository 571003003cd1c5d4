// SPDX-License-Identifier: GPL-3.0-or-later
// XDMF beside HDF5: a few lines of XML that tell ParaView, VisIt and their like where the nodes of the fields
// of an HDF5 file stand. The tile is a regular grid of nodes (i hx, j hy) at height 0; every field has a
// value at each node, so that a filter such as ParaView's "Warp By Scalar" raises it to a relief.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/grid.hpp"
#include "engine/surface/io/hdf5_reader/hdf5_file.hpp"

namespace asperity {

// The path of the XDMF file that goes with an HDF5 file: the same with the ending .xdmf.
std::filesystem::path xdmf_path(const std::filesystem::path& hdf5);

// Whether a file of this name is HDF5 by its ending, which is written with an XDMF file beside it.
bool has_xdmf_beside(const std::filesystem::path& file);

// The XML for the arrays of shape (ny, nx) in `content`, which stands or will stand in the file `hdf5` of the
// same folder.
std::string xdmf_text(const Grid& grid, std::string_view name, const Hdf5Content& content,
                      const std::filesystem::path& hdf5);

// Writes both, the HDF5 file first: a description never speaks of data that are not there. Throws as
// write_hdf5.
void write_hdf5_and_xdmf(const std::filesystem::path& hdf5, const Grid& grid, std::string_view name,
                         const Hdf5Content& content);

}  // namespace asperity
