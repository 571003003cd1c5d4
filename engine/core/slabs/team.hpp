// SPDX-License-Identifier: GPL-3.0-or-later
// Processes working together on fields in slabs, by the same calls in the same order. A local step runs
// inside work(); at the next sum, every process throws its error, so none waits for a failed process. A stop
// in one process stops all. Sums are added in the order of the processes. One thread.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "engine/core/error.hpp"
#include "engine/core/slabs/slab_fourier.hpp"

namespace asperity {

struct LoadedPart;

class Team {
 public:
  virtual ~Team() = default;
  static Team& alone();

  int rank() const { return rank_; }
  int size() const { return size_; }
  Slab slab(int nx, int ny) const { return {nx, ny, rank_, size_}; }

  // Nothing after a failure.
  template <class Body>
  void work(Body&& body) {
    if (failure_) return;
    try {
      body();
    } catch (const Error& error) {
      failure_ = error;
    } catch (const std::bad_alloc&) {
      failure_ = Error(ErrorCode::out_of_memory, "the memory is full");
    }
  }

  // Collective: adds the first `sums` numbers, takes the minimum of the others.
  template <std::size_t sums, std::size_t minima = 0>
  std::array<double, sums + minima> reduce(const std::array<double, sums + minima>& own) {
    constexpr std::size_t n = sums + minima;
    std::array<double, n> total{};
    reduce(std::span<const double>(own), sums, total);
    return total;
  }
  void reduce(std::span<const double> own, std::size_t sums, std::span<double> total);
  // In the order of the processes; the same count in each.
  Array<double> gather(std::span<const double> own);
  // Broadcasts the first process's text.
  std::string text_of_first(const std::string& own);
  // Every process throws a failed one's error.
  void agree() { reduce({}, 0, {}); }

  // With its buffer.
  virtual std::unique_ptr<SlabFourier> fourier(int nx, int ny) = 0;
  // Counts of doubles per process. No agreement.
  virtual void exchange(const double* out, const int* out_counts, double* in, const int* in_counts) = 0;

 protected:
  Team() = default;
  virtual void gather_bytes(const void* own, std::size_t bytes, void* all) = 0;
  int rank_ = 0, size_ = 1;

 private:
  [[noreturn]] void throw_what_happened(const double* marks, std::size_t stride);
  std::optional<Error> failure_;
};

// Processes of mpirun; requires a started MPI. Throws Error{bad_state} if `part` lacks FFTW's MPI transforms.
std::unique_ptr<Team> team_of_mpi(const LoadedPart& part, int rank, int size);

}  // namespace asperity
