// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces and profiles to files, by the extension of the path: .npy (float64, shape (ny, nx)), .x3p
// (ISO 25178-72, double, with MD5), .h5 .hdf5 (with an .xdmf beside it for ParaView), .gwy (Gwyddion), .sdf
// (ISO 25178-71, double), .sur (Digital Surf, in steps), .txt .asc (blanks) and .csv (commas) with a header
// of size and unit. Heights of all but .sur read back bit for bit, with their holes; NPY carries no size or
// unit, so reading it needs both. A point that was not measured is NaN, in Gwyddion's files under a mask, in
// those of Digital Surf a number of its own. Lines are stored from the top or the bottom as
// the format wants it (Format::lines). Material and periodicity are not written. Files appear whole or
// not at all.
#pragma once

#include <string>

#include "engine/core/monitor.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"

namespace asperity {

// Throws Error{bad_file} for an unknown extension, naming the known ones, a missing directory, or a
// disk that refuses. The same surface gives the same bytes every time.
void write_surface(const Surface& surface, const std::string& path, Monitor& monitor = Monitor::silent());

// .csv and .txt (position and height, with a header of spacing and radius) or .npy (heights).
void write_profile(const Profile& profile, const std::string& path, Monitor& monitor = Monitor::silent());

}  // namespace asperity
