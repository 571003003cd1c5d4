// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/mpi/messages.hpp"

#ifdef ASPERITY_FFTW_MPI

#include <fftw3-mpi.h>
#include <mpi.h>

#include <vector>

namespace {

int processes() {
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

void gather(const void* own, std::uint64_t bytes, void* all) {
  MPI_Allgather(own, static_cast<int>(bytes), MPI_BYTE, all, static_cast<int>(bytes), MPI_BYTE,
                MPI_COMM_WORLD);
}

std::vector<int> offsets(const int* counts) {
  std::vector<int> result(static_cast<std::size_t>(processes()));
  for (std::size_t r = 1; r < result.size(); ++r) result[r] = result[r - 1] + counts[r - 1];
  return result;
}

void exchange(const double* out, const int* out_counts, double* in, const int* in_counts) {
  const std::vector<int> out_offsets = offsets(out_counts), in_offsets = offsets(in_counts);
  MPI_Alltoallv(out, out_counts, out_offsets.data(), MPI_DOUBLE, in, in_counts, in_offsets.data(), MPI_DOUBLE,
                MPI_COMM_WORLD);
}

void begin() {
  static bool begun = false;
  if (!begun) fftw_mpi_init();
  begun = true;
}

AsperitySlabShape shape(int nx, int ny) {
  begin();
  ptrdiff_t rows = 0, first_row = 0, waves = 0, first_wave = 0;
  const ptrdiff_t complex_values = fftw_mpi_local_size_2d_transposed(ny, nx / 2 + 1, MPI_COMM_WORLD, &rows,
                                                                     &first_row, &waves, &first_wave);
  return {static_cast<int>(first_row), static_cast<int>(rows), static_cast<int>(first_wave),
          static_cast<int>(waves), 2 * static_cast<std::int64_t>(complex_values)};
}

struct Plans {
  fftw_plan forward, back;
};

void forget(void* plan) {
  auto* const plans = static_cast<Plans*>(plan);
  if (plans == nullptr) return;
  if (plans->forward != nullptr) fftw_destroy_plan(plans->forward);
  if (plans->back != nullptr) fftw_destroy_plan(plans->back);
  delete plans;
}

void* plan(int nx, int ny, double* buffer) {
  begin();
  auto* const bins = reinterpret_cast<fftw_complex*>(buffer);
  auto* const plans = new Plans{
      fftw_mpi_plan_dft_r2c_2d(ny, nx, buffer, bins, MPI_COMM_WORLD, FFTW_ESTIMATE | FFTW_MPI_TRANSPOSED_OUT),
      fftw_mpi_plan_dft_c2r_2d(ny, nx, bins, buffer, MPI_COMM_WORLD, FFTW_ESTIMATE | FFTW_MPI_TRANSPOSED_IN)};
  if (plans->forward != nullptr && plans->back != nullptr) return plans;
  forget(plans);
  return nullptr;
}

void transform(void* plan, int back) {
  const auto* const plans = static_cast<const Plans*>(plan);
  fftw_execute(back != 0 ? plans->back : plans->forward);
}

}  // namespace

extern "C" const AsperitySlabs* asperity_slabs_1() {
  static const AsperitySlabs table{gather, exchange, shape, plan, transform, forget};
  return &table;
}

#else

extern "C" const AsperitySlabs* asperity_slabs_1() { return nullptr; }

#endif
