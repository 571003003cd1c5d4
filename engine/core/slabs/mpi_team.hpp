// SPDX-License-Identifier: GPL-3.0-or-later
// Processes started by mpirun, through asperity-mpi.so.
#pragma once

#include "engine/core/loaded_part.hpp"
#include "engine/core/slabs/team.hpp"

struct AsperitySlabs;

namespace asperity {

class MpiTeam final : public Team {
 public:
  // Requires a started MPI. Throws Error{bad_state} if `part` lacks FFTW's MPI transforms.
  MpiTeam(const LoadedPart& part, int rank, int size);

  std::unique_ptr<SlabFourier> fourier(int nx, int ny) override;
  void exchange(const double* out, const int* out_counts, double* in, const int* in_counts) override;

 private:
  void gather_bytes(const void* own, std::size_t bytes, void* all) override;
  const AsperitySlabs* mpi_;
};

}  // namespace asperity
