// SPDX-License-Identifier: GPL-3.0-or-later
// The processes that mpirun started as a team, by the functions of asperity-mpi.so.
#pragma once

#include "engine/core/loaded_part.hpp"
#include "engine/core/slabs/team.hpp"

struct AsperitySlabs;

namespace asperity {

class MpiTeam final : public Team {
 public:
  // After MPI has been started. Throws Error{bad_state} where `part` was built without FFTW's MPI transforms.
  MpiTeam(const LoadedPart& part, int rank, int size);

  std::unique_ptr<SlabFourier> fourier(int nx, int ny) override;
  void exchange(const double* out, const int* out_counts, double* in, const int* in_counts) override;

 private:
  void gather_bytes(const void* own, std::size_t bytes, void* all) override;
  const AsperitySlabs* mpi_;
};

}  // namespace asperity
