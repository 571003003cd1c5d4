// SPDX-License-Identifier: GPL-3.0-or-later
// A state as an HDF5 file with an XDMF file beside it: the fields over the tile as maps of shape (ny, nx) in
// the lower body's frame, and load, approach, area, certificate and digest as attributes of the root.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/contact/state.hpp"

namespace asperity {

// The fields a state has: all of State::field_names(), without "plastic" where nothing can yield.
std::vector<std::string> fields_of(const State& state);

// Writes these fields (all of them if none is named), which are worked out if they have not been read. Throws
// Error{bad_file} for an extension other than .h5 or .hdf5 and where the disk refuses, and as State::field.
void write_state(const State& state, const std::filesystem::path& path, std::vector<std::string> fields = {});

}  // namespace asperity
