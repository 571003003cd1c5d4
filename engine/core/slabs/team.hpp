// SPDX-License-Identifier: GPL-3.0-or-later
// The processes that share one piece of work on fields in slabs, all of which make the same calls in the same
// order; or one process alone. No process may wait for one that has failed, so what each does by itself
// stands inside work(): what it throws there is kept, the others go on, and at the next sum all of them throw
// the same error. A stop asked for in one process stops all. Sums are added in the order of the processes:
// the same bits for the same number of them. Called from one thread.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "engine/core/error.hpp"
#include "engine/core/slabs/slab.hpp"
#include "engine/core/slabs/slab_fourier.hpp"

namespace asperity {

class Team {
 public:
  virtual ~Team() = default;
  // This process by itself.
  static Team& alone();

  int rank() const { return rank_; }
  int size() const { return size_; }
  Slab slab(int nx, int ny) const { return {nx, ny, rank_, size_}; }

  // What this process does by itself; nothing once it has failed.
  template <class Body>
  void work(Body&& body) {
    if (failure_) return;
    try {
      body();
    } catch (const Error& error) {
      failure_ = error;
    } catch (const std::bad_alloc&) {
      failure_ = Error(ErrorCode::out_of_memory, "there is no more memory");
    }
  }

  // All together: what each offers, `sums` numbers that are added and then minima of which the least counts.
  // If one process failed, every process throws its error.
  template <std::size_t sums, std::size_t minima = 0>
  std::array<double, sums + minima> reduce(const std::array<double, sums + minima>& own) {
    constexpr std::size_t n = sums + minima;
    std::array<double, n> total{};
    reduce(std::span<const double>(own), sums, total);
    return total;
  }
  void reduce(std::span<const double> own, std::size_t sums, std::span<double> total);
  // The numbers of each process one after the other; the same count in all.
  Array<double> gather(std::span<const double> own);
  // The bytes that the first process gives, in all of them.
  std::string text_of_first(const std::string& own);
  // If work() failed in one process, every process throws its error.
  void agree() { reduce({}, 0, {}); }

  // The transform of this grid, whose buffer is made.
  virtual std::unique_ptr<SlabFourier> fourier(int nx, int ny) = 0;
  // To and from each process its count of doubles. No agreement.
  virtual void exchange(const double* out, const int* out_counts, double* in, const int* in_counts) = 0;

 protected:
  Team() = default;
  virtual void gather_bytes(const void* own, std::size_t bytes, void* all) = 0;
  int rank_ = 0, size_ = 1;

 private:
  [[noreturn]] void throw_what_happened(const double* marks, std::size_t stride);
  std::optional<Error> failure_;
};

}  // namespace asperity
