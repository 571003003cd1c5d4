// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/loaded_part.hpp"
#include "engine/core/mpi/messages.hpp"
#include "engine/core/slabs/slab_fourier.hpp"
#include "engine/core/slabs/team.hpp"

namespace asperity {

namespace {

class MpiFourier final : public SlabFourier {
 public:
  MpiFourier(const AsperitySlabs& mpi, const AsperitySlabShape& shape, int nx, int ny) : mpi_(mpi) {
    buffer_.resize(static_cast<std::size_t>(shape.doubles));
    stride_ = 2 * (static_cast<std::ptrdiff_t>(nx) / 2 + 1);
    first_wave_ = shape.first_wave;
    waves_ = shape.waves;
    step_a_ = ny;
  }
  ~MpiFourier() override {
    const auto lock = lock_fourier_planner();
    mpi_.forget(plan_);
  }
  MpiFourier(const MpiFourier&) = delete;
  MpiFourier& operator=(const MpiFourier&) = delete;

  void plan(int nx, int ny) {
    const auto lock = lock_fourier_planner();
    plan_ = mpi_.plan(nx, ny, buffer_.data());
  }
  bool planned() const { return plan_ != nullptr; }
  void forward() override { mpi_.transform(plan_, 0); }
  void inverse() override { mpi_.transform(plan_, 1); }

 private:
  const AsperitySlabs& mpi_;
  void* plan_ = nullptr;
};

class MpiTeam final : public Team {
 public:
  MpiTeam(const AsperitySlabs& mpi, int rank, int size) : mpi_(mpi) {
    rank_ = rank;
    size_ = size;
  }
  std::unique_ptr<SlabFourier> fourier(int nx, int ny) override;
  void exchange(const double* out, const int* out_counts, double* in, const int* in_counts) override {
    mpi_.exchange(out, out_counts, in, in_counts);
  }

 private:
  void gather_bytes(const void* own, std::size_t bytes, void* all) override { mpi_.gather(own, bytes, all); }
  const AsperitySlabs& mpi_;
};

std::unique_ptr<SlabFourier> MpiTeam::fourier(int nx, int ny) {
  std::unique_ptr<MpiFourier> made;
  const AsperitySlabShape shape = mpi_.shape(nx, ny);
  work([&] {
    const Slab own = slab(nx, ny);
    if (shape.rows != own.rows() || (shape.rows > 0 && shape.first_row != own.first()))
      throw Error(ErrorCode::internal, "FFTW deals rows out in another way");
    made = std::make_unique<MpiFourier>(mpi_, shape, nx, ny);
  });
  agree();
  made->plan(nx, ny);
  work([&] {
    if (!made->planned()) throw Error(ErrorCode::internal, "FFTW has no plan for a transform of this grid");
  });
  agree();
  return made;
}

}  // namespace

std::unique_ptr<Team> team_of_mpi(const LoadedPart& part, int rank, int size) {
  const AsperitySlabs* const mpi = part_function<AsperitySlabsTable>(part, "asperity_slabs_1")();
  if (mpi == nullptr)
    refuse_state("one contact needs FFTW's MPI transforms to spread over ranks, and this program has none",
                 "install Debian's package libfftw3-mpi-dev and build again");
  return std::make_unique<MpiTeam>(*mpi, rank, size);
}

}  // namespace asperity
