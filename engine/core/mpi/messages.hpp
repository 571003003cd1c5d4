// SPDX-License-Identifier: GPL-3.0-or-later
// Plain C interface of asperity-mpi.so, for late loading: byte messages between processes, from one thread
// each.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

struct AsperityMpi {
  // Returns 0, or nonzero with a `reason`.
  int (*open)(int* rank, int* size, char* reason, std::size_t room);
  // Copies the message and returns at once. Messages of one sender arrive in order.
  void (*send)(int to, const char* bytes, std::uint64_t length);
  // 1 with a message, for the caller to free(); 0 without.
  int (*receive)(int* from, char** bytes, std::uint64_t* length);
  // Waits for delivery of all sent messages, then leaves. Collective.
  void (*close)();
  void (*abort)(int status);
};

using AsperityMpiTable = const AsperityMpi*();
__attribute__((visibility("default"))) const AsperityMpi* asperity_mpi_1();

// Fields in slabs of rows, with FFTW's in-place MPI transforms. Except `shape`, all functions are collective.

// For a real transform of ny rows of nx values: rows before, waves after.
struct AsperitySlabShape {
  int first_row, rows;    // rows of this process
  int first_wave, waves;  // along x, of 0 … nx/2, with all ny waves along y
  std::int64_t doubles;   // number of doubles in the buffer
};

struct AsperitySlabs {
  // `all` receives `bytes` of each process in order.
  void (*gather)(const void* own, std::uint64_t bytes, void* all);
  // Counts of doubles per process.
  void (*exchange)(const double* out, const int* out_counts, double* in, const int* in_counts);
  AsperitySlabShape (*shape)(int nx, int ny);
  // `buffer`: 64-byte aligned. Null without a plan. FFTW_ESTIMATE: no timing.
  void* (*plan)(int nx, int ny, double* buffer);
  // From rows of nx values, 2(nx/2 + 1) apart, to waves, ny complex values each, or back; unnormalised.
  void (*transform)(void* plan, int back);
  void (*forget)(void* plan);
};

using AsperitySlabsTable = const AsperitySlabs*();
// Call after AsperityMpi::open. Null if built without FFTW's MPI transforms.
__attribute__((visibility("default"))) const AsperitySlabs* asperity_slabs_1();
}
