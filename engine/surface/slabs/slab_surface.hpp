// SPDX-License-Identifier: GPL-3.0-or-later
// A rough surface in slabs: each of several processes holds some rows of its heights and none holds them all.
// The same generators and the same heights, to rounding, as the surfaces that one process holds. An immutable
// value; copies share the heights. Making one is work of all processes together.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"
#include "engine/core/slabs/team.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/generators/sine.hpp"
#include "engine/surface/material.hpp"

namespace asperity {

struct SlabSurface {
  Grid grid;
  Slab slab;
  std::shared_ptr<const Array<double>> heights;  // m, the rows of this process
  std::optional<Material> material;
  // Of all of it.
  double mean = 0, rms = 0;     // m
  double peak = 0, valley = 0;  // m
  std::string digest;           // of the heights and how they are dealt out
};

// Puts a row of heights, nx values, into `to`. Called for the rows of this process in their order.
using SlabRow = std::function<void(int j, double* to)>;

// Throws in all processes Error{bad_value} where one of them meets a height that is not finite, and what
// `row` throws in one of them.
SlabSurface slab_surface(Team& team, const Grid& grid, const SlabRow& row, Monitor& monitor);

// The heights of self_affine_surface, by an inverse transform in slabs. Holds 16 bytes a node over all
// processes.
SlabSurface slab_self_affine(Team& team, const SelfAffineOptions& options, Monitor& monitor);
SlabSurface slab_sine(Team& team, const SineOptions& options, Monitor& monitor);
SlabSurface slab_flat(Team& team, const Grid& grid, Monitor& monitor);

struct SlabFileOptions {
  std::optional<double> size_x, size_y;  // m; required
  std::optional<double> unit;            // m per number; 1 unless given
};
// A NPY file of shape (ny, nx), of which each process reads its rows. Throws Error{bad_file}, as read_surface
// does for such a file, and for columns that run first; {bad_value} without `size` and for a NaN, a point
// that was not measured.
SlabSurface slab_read(Team& team, const std::string& path, const SlabFileOptions& options, Monitor& monitor);

// A field in slabs as a NPY file of shape (ny, nx), float64, written by the first process, to whom the others
// send their rows a few at a time. All together; `path` counts in the first alone.
void write_slabs(Team& team, const Slab& slab, const SlabRow& row, const std::string& path, Monitor& monitor);

}  // namespace asperity
