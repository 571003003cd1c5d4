// SPDX-License-Identifier: GPL-3.0-or-later
// A rough surface in slabs: each process holds some rows. Heights equal those of one process, to rounding.
// Immutable; copies share the heights. Collective.
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
  std::shared_ptr<const Array<double>> heights;  // m, rows of this process
  std::optional<Material> material;
  // Over all slabs.
  double mean = 0, rms = 0;     // m
  double peak = 0, valley = 0;  // m
  std::string digest;           // of heights and distribution
};

// Writes nx heights to `to`; called in the order of rows.
using SlabRow = std::function<void(int j, double* to)>;

// All processes throw Error{bad_value} for a non-finite height, or an error of `row`.
SlabSurface slab_surface(Team& team, const Grid& grid, const SlabRow& row, Monitor& monitor);

// Inverse transform in slabs; 16 bytes a node over all processes.
SlabSurface slab_self_affine(Team& team, const SelfAffineOptions& options, Monitor& monitor);
SlabSurface slab_sine(Team& team, const SineOptions& options, Monitor& monitor);
SlabSurface slab_flat(Team& team, const Grid& grid, Monitor& monitor);

struct SlabFileOptions {
  std::optional<double> size_x, size_y;  // m; required
  std::optional<double> unit;            // m per number; default 1
};
// NPY file of shape (ny, nx). Throws Error{bad_file} as read_surface() and for Fortran order;
// Error{bad_value} without `size` and for NaN.
SlabSurface slab_read(Team& team, const std::string& path, const SlabFileOptions& options, Monitor& monitor);

// NPY file of shape (ny, nx), float64, through the first process, a few rows at a time. The first process's
// `path` counts.
void write_slabs(Team& team, const Slab& slab, const SlabRow& row, const std::string& path, Monitor& monitor);

}  // namespace asperity
