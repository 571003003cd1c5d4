// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of asperity-mpi.so for fields in slabs of rows over processes, with FFTW's in-place MPI
// transforms. Except `shape`, all functions are collective, in the same order, from one thread each.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

// For a real transform of ny rows of nx values: rows before, waves after.
struct AsperitySlabShape {
  int first_row, rows;    // rows of this process
  int first_wave, waves;  // waves along x, of 0 … nx/2, with all ny waves along y
  std::int64_t doubles;   // number of doubles in the buffer
};

struct AsperitySlabs {
  // `all` receives `bytes` of each process in order.
  void (*gather)(const void* own, std::uint64_t bytes, void* all);
  // Counts of doubles per process.
  void (*exchange)(const double* out, const int* out_counts, double* in, const int* in_counts);
  AsperitySlabShape (*shape)(int nx, int ny);
  // `buffer`: 64-byte aligned. Null without a plan. FFTW_ESTIMATE, so that no timing selects the plan.
  void* (*plan)(int nx, int ny, double* buffer);
  // From rows of nx values, 2(nx/2 + 1) apart, to waves, ny complex values each, or back; unnormalised.
  void (*transform)(void* plan, int back);
  void (*forget)(void* plan);
};

using AsperitySlabsTable = const AsperitySlabs*();
// Call after AsperityMpi::open. Null if built without FFTW's MPI transforms.
__attribute__((visibility("default"))) const AsperitySlabs* asperity_slabs_1();
}
