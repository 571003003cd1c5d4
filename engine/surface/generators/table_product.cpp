// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/table_product.hpp"

// Keeps the linker from merging these functions with Eigen's elsewhere.
#define Eigen asperity_eigen
// GCC 12 misreads undefined registers of its own AVX-512 header (GCC bug 105593).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#if defined(__x86_64__)
#include <immintrin.h>
// Eigen calls fused operations by these names.
#define _mm512_fmadd_pd(a, b, c) _mm512_add_pd(_mm512_mul_pd(a, b), c)
#define _mm256_fmadd_pd(a, b, c) _mm256_add_pd(_mm256_mul_pd(a, b), c)
#endif
#include <Eigen/Core>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <algorithm>

namespace asperity::table_product {

namespace {

// Below Eigen's choice for a first cache of 32 KiB.
constexpr int stretch = 128;

#if !defined(__EMSCRIPTEN__)
using LeftTable = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor>,
                             Eigen::Unaligned, Eigen::OuterStride<>>;
using RightTable = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>,
                              Eigen::Unaligned, Eigen::OuterStride<>>;
using Sum = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor>,
                       Eigen::Unaligned, Eigen::OuterStride<>>;

bool caches_fixed() {
  constexpr int first = 32 << 10, second = 512 << 10, third = 2 << 20;
  Eigen::setCpuCacheSizes(first, second, third);
  return true;
}
#endif

}  // namespace

#if defined(__EMSCRIPTEN__)
// Eigen has no vectors for WebAssembly, and without vectors it sums in another order. These are the sums of
// its vectors.
void add(int rows, int columns, int depth, const double* left, std::ptrdiff_t left_stride,
         const double* right, std::ptrdiff_t right_stride, double* sum, std::ptrdiff_t sum_stride) {
  constexpr int lanes = 8;
  static_assert(row_step % lanes == 0);
  for (int first = 0; first < depth; first += stretch) {
    const int end = std::min(first + stretch, depth);
    for (int column = 0; column < columns; ++column) {
      for (int row = 0; row < rows; row += lanes) {
        double here[lanes] = {};
        for (int k = first; k < end; ++k)
          for (int lane = 0; lane < lanes; ++lane)
            here[lane] += left[k * left_stride + row + lane] * right[k * right_stride + column];
        for (int lane = 0; lane < lanes; ++lane) sum[column * sum_stride + row + lane] += here[lane];
      }
    }
  }
}
#else
void add(int rows, int columns, int depth, const double* left, std::ptrdiff_t left_stride,
         const double* right, std::ptrdiff_t right_stride, double* sum, std::ptrdiff_t sum_stride) {
  [[maybe_unused]] static const bool fixed = caches_fixed();
  Sum to(sum, rows, columns, Eigen::OuterStride<>(sum_stride));
  for (int first = 0; first < depth; first += stretch) {
    const int here = std::min(stretch, depth - first);
    const LeftTable a(left + first * left_stride, rows, here, Eigen::OuterStride<>(left_stride));
    const RightTable b(right + first * right_stride, here, columns, Eigen::OuterStride<>(right_stride));
    to.noalias() += a * b;
  }
}
#endif

}  // namespace asperity::table_product
