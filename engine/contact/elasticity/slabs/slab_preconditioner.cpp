// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/slabs/slab_preconditioner.hpp"

#include <algorithm>

namespace asperity {

namespace {

void extend(const double* below, const double* here, const double* above, const std::uint8_t* mask, int nx,
            double* to) {
  const auto at = [&](int i, int left, int right) {
    const double mean = 0.25 * ((below[i] + above[i]) + (here[left] + here[right]));
    to[i] = mask[i] != 0 ? here[i] : mean;
  };
  at(0, nx - 1, nx > 1 ? 1 : 0);
  for (int i = 1; i < nx - 1; ++i) at(i, i - 1, i + 1);
  if (nx > 1) at(nx - 1, nx - 2, 0);
}

// Transpose of `extend`.
struct RowOf {
  const double* value;
  const std::uint8_t* mask;
  double off(int i) const { return mask[i] != 0 ? 0.0 : value[i]; }
};
void gather_back(RowOf below, RowOf here, RowOf above, int nx, double* to) {
  const auto at = [&](int i, int left, int right) {
    const double quarter = 0.25 * ((below.off(i) + above.off(i)) + (here.off(left) + here.off(right)));
    to[i] = (here.mask[i] != 0 ? here.value[i] : 0.0) + quarter;
  };
  at(0, nx - 1, nx > 1 ? 1 : 0);
  for (int i = 1; i < nx - 1; ++i) at(i, i - 1, i + 1);
  if (nx > 1) at(nx - 1, nx - 2, 0);
}

}  // namespace

SlabPreconditioner::SlabPreconditioner(SlabLevel& level)
    : level_(level), rim_(rim_rows(level.team, level.shape.slab, sweeps)) {
  level.team.work([&] {
    const Slab& slab = level.shape.slab;
    const std::size_t rows = static_cast<std::size_t>(slab.rows() + 2 * sweeps);
    field_.resize(rows * slab.width());
    mask_.resize(rows * slab.width());
    before_.resize(slab.width() * sweeps);
    fresh_.resize(slab.width());
  });
  level.team.agree();
}

void SlabPreconditioner::set_free(std::span<const std::uint8_t> free) {
  std::copy(free.begin(), free.end(), mask_.begin() + static_cast<std::ptrdiff_t>(offset()));
  const std::size_t width = level_.shape.slab.width();
  const std::size_t after = offset() + level_.nodes();
  rim_.run(
      [&](int j, double* to) {
        std::copy_n(free.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(j) * width), width,
                    to);
      },
      [&](std::size_t k, const double* row) {
        const std::size_t at = k < sweeps ? k * width : after + (k - sweeps) * width;
        std::transform(row, row + width, mask_.begin() + static_cast<std::ptrdiff_t>(at),
                       [](double mark) { return static_cast<std::uint8_t>(mark); });
      });
}

void SlabPreconditioner::exchange_rim() {
  const std::size_t width = level_.shape.slab.width();
  const std::size_t after = offset() + level_.nodes();
  rim_.run([&](int j, double* to) { std::copy_n(own() + static_cast<std::size_t>(j) * width, width, to); },
           [&](std::size_t k, const double* row) {
             std::copy_n(row, width, field_.data() + (k < sweeps ? k * width : after + (k - sweeps) * width));
           });
}

// Sweep s processes row j = t − s at step t: the row above has passed sweep s − 1, and `before_` has the row
// below before sweep s.
void SlabPreconditioner::sweep(bool adjoint) {
  const Slab& slab = level_.shape.slab;
  const int rows = slab.rows() + 2 * sweeps, nx = slab.nx;
  if (slab.rows() == 0) return;
  const auto row = [&](int j) { return field_.data() + static_cast<std::size_t>(j) * slab.width(); };
  const auto mask = [&](int j) { return mask_.data() + static_cast<std::size_t>(j) * slab.width(); };
  const auto before = [&](int s) { return before_.data() + static_cast<std::size_t>(s - 1) * slab.width(); };
  for (int t = 1; t < rows + sweeps; ++t) {
    for (int s = 1; s <= sweeps; ++s) {
      const int j = t - s;
      // Later sweeps do not read this row.
      if (j < s || j >= rows - s) {
        if (j == s - 1) std::copy_n(row(j), nx, before(s));
        continue;
      }
      if (adjoint)
        gather_back({before(s), mask(j - 1)}, {row(j), mask(j)}, {row(j + 1), mask(j + 1)}, nx,
                    fresh_.data());
      else
        extend(before(s), row(j), row(j + 1), mask(j), nx, fresh_.data());
      std::copy_n(row(j), nx, before(s));
      std::copy_n(fresh_.data(), nx, row(j));
    }
  }
}

}  // namespace asperity
