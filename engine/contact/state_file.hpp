// SPDX-License-Identifier: GPL-3.0-or-later
// A state as an HDF5 file with an XDMF file: fields as maps of shape (ny, nx) in the lower body's frame;
// load, approach, area, certificate and digest as attributes of the root.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/contact/state.hpp"

namespace asperity {

// State::field_names(), without "plastic" if nothing can yield.
std::vector<std::string> fields_of(const State& state);

// Computes and writes these fields; none named: all. Throws Error{bad_file} for an extension other than .h5
// or .hdf5 and for disk errors, and as State::field.
void write_state(const State& state, const std::filesystem::path& path, std::vector<std::string> fields = {});

}  // namespace asperity
