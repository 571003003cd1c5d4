// SPDX-License-Identifier: GPL-3.0-or-later
// What asperity-mpi.so offers for fields that are spread over the processes in slabs of rows: what all of
// them have is gathered, rows change hands, and FFTW's own MPI transforms run in place. Every function but
// the sizes is called by all processes together, in the same order, each from one thread. Plain C, so that it
// crosses the border of a part that is loaded late.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

// Of a real transform of ny rows of nx values, the longer way in slabs: rows here, waves there.
struct AsperitySlabShape {
  int first_row, rows;    // of this process
  int first_wave, waves;  // along x, of 0 … nx/2; for each of them all ny waves along y
  std::int64_t doubles;   // that the buffer holds
};

struct AsperitySlabs {
  // `all` takes the `bytes` of each process one after the other.
  void (*gather)(const void* own, std::uint64_t bytes, void* all);
  // To and from each process its count of doubles, in the order of the processes.
  void (*exchange)(const double* out, const int* out_counts, double* in, const int* in_counts);
  AsperitySlabShape (*shape)(int nx, int ny);
  // For this buffer, 64-byte aligned; null where FFTW has no plan. Estimated: no timing decides what it is.
  void* (*plan)(int nx, int ny, double* buffer);
  // From rows of nx values, 2(nx/2 + 1) apart, to waves, ny complex values each, or back; unnormalised.
  void (*transform)(void* plan, int back);
  void (*forget)(void* plan);
};

using AsperitySlabsTable = const AsperitySlabs*();
// After AsperityMpi::open. Null where the part was built without FFTW's MPI transforms.
__attribute__((visibility("default"))) const AsperitySlabs* asperity_slabs_1();
}
