// SPDX-License-Identifier: GPL-3.0-or-later
// The extension selects the format: .npy (float64, shape (ny, nx)), .x3p (ISO 25178-72, double, MD5), .h5
// .hdf5 (plus an .xdmf for ParaView), .gwy (Gwyddion), .sdf (ISO 25178-71, double), .sur (Digital Surf), .txt
// .asc (blanks) and .csv (commas) with a header of size and unit. Heights and holes read back bit for bit;
// .sur rounds heights. NPY stores no size or unit; material and periodicity are never written. Files are
// replaced atomically.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "engine/core/monitor.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// Throws Error{bad_file} for an unknown extension, a missing directory or a failing disk.
void write_surface(const Surface& surface, const std::string& path, Monitor& monitor = Monitor::silent());

// .csv and .txt (position, height, header of spacing and radius) or .npy (heights).
void write_profile(const Profile& profile, const std::string& path, Monitor& monitor = Monitor::silent());

// For writers of a format: writes `head`, then what `append` adds for each row, in pieces.
void write_rows(const std::string& path, std::string head, std::int64_t rows,
                const std::function<void(std::int64_t row, std::string& bytes)>& append, Monitor& monitor);

}  // namespace asperity
