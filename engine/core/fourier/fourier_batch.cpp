// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/fourier/fourier_batch.hpp"

#include <algorithm>

namespace asperity {

namespace {

using BatchDoubles = Lanes<double>::Vector;

// Prefetch distance: the hardware cannot predict addresses so far apart.
constexpr int batch_rows_ahead = 12;

template <int lanes>
int convolution_length(int n) {
  return LaneFourier<double, lanes>::possible(n) ? n : smooth_length(2 * n - 1);
}

// By complex factors or their conjugates; `from` may be `to`.
template <bool conjugate, class Complex>
void multiply(const Complex* from, const double* factors, std::ptrdiff_t count, Complex* to) {
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const double c = factors[2 * k], s = conjugate ? -factors[2 * k + 1] : factors[2 * k + 1];
    const Complex x = from[k];
    to[k] = {x.re * c - x.im * s, x.re * s + x.im * c};
  }
}

}  // namespace

template <int lanes>
AnyLengthFourier<lanes>::AnyLengthFourier(int n) : n_(n), smooth_(convolution_length<lanes>(n)) {
  const int length = smooth_.length();
  if (length == n) return;
  // k² modulo 2n, for the exact phase of the chirp.
  chirp_.resize(2 * static_cast<std::size_t>(n));
  for (std::int64_t k = 0; k < n; ++k) {
    const UnitTurn phase = unit_turn(k * k % (2 * std::int64_t{n}), 2 * std::int64_t{n});
    chirp_[2 * static_cast<std::size_t>(k)] = phase.cosine;
    chirp_[2 * static_cast<std::size_t>(k) + 1] = -phase.sine;
  }
  const LaneFourier<double, 1> single(length);
  std::vector<Lanes<double, 1>::Complex> kernel(static_cast<std::size_t>(length), {0, 0});
  for (int k = 0; k < n; ++k) {
    const auto at = 2 * static_cast<std::size_t>(k);
    kernel[static_cast<std::size_t>(k)] = {chirp_[at], -chirp_[at + 1]};
    if (k > 0) kernel[static_cast<std::size_t>(length - k)] = kernel[static_cast<std::size_t>(k)];
  }
  single.forward(kernel.data());
  response_.resize(2 * static_cast<std::size_t>(length));
  for (int k = 0; k < length; ++k) {
    const auto from = static_cast<std::size_t>(single.place(k));
    const auto to = 2 * static_cast<std::size_t>(smooth_.place(k));
    response_[to] = kernel[from].re / length;
    response_[to + 1] = kernel[from].im / length;
  }
}

// Inverse: conjugate of the forward transform of the conjugate.
template <int lanes>
template <bool forwards>
void AnyLengthFourier<lanes>::by_convolution(Complex* values, Complex* work) const {
  multiply<!forwards>(values, chirp_.data(), n_, work);
  std::fill(work + n_, work + smooth_.length(), Complex{});
  smooth_.forward(work);
  // The conjugate of the even kernel has the conjugate transform.
  multiply<!forwards>(work, response_.data(), smooth_.length(), work);
  smooth_.inverse(work);
  multiply<!forwards>(work, chirp_.data(), n_, values);
}

template <int lanes>
void AnyLengthFourier<lanes>::forward(Complex* values, Complex* work) const {
  if (smooth_.length() == n_)
    smooth_.forward(values);
  else
    by_convolution<true>(values, work);
}

template <int lanes>
void AnyLengthFourier<lanes>::inverse(Complex* values, Complex* work) const {
  if (smooth_.length() == n_)
    smooth_.inverse(values);
  else
    by_convolution<false>(values, work);
}

template class AnyLengthFourier<1>;
template class AnyLengthFourier<Lanes<double>::count>;

BatchFourier::Work::Work(const BatchFourier& batch)
    : values(static_cast<std::size_t>(batch.length()) * parts), more(batch.fourier_.work_length()) {}

std::size_t BatchFourier::work_values(int n) {
  const int length = convolution_length<lanes>(n);
  return static_cast<std::size_t>(length == n ? n * parts : n * parts + length);
}

// Column l: signal l as real part, signal l + columns as imaginary part.
void BatchFourier::load_reals(Work& work, const double* const* in, int given, int count) const {
  const auto signal = [&](int r) { return in[std::min(r, count - 1)]; };
  const int whole = given / lanes * lanes;
  for (int p = 0; p < parts; ++p) {
    Lane* const values = part(work, p);
    const int first = p * lanes;
    for (int i = 0; i < whole; i += lanes) {
      BatchDoubles re[lanes], im[lanes];
      for (int l = 0; l < lanes; ++l) {
        std::memcpy(&re[l], signal(first + l) + i, sizeof re[l]);
        std::memcpy(&im[l], signal(first + l + columns) + i, sizeof im[l]);
      }
      register_vectors::transpose(re);
      register_vectors::transpose(im);
      for (int k = 0; k < lanes; ++k) values[i + k] = {re[k], im[k]};
    }
    for (int i = whole; i < given; ++i)
      for (int l = 0; l < lanes; ++l) {
        values[i].re[l] = signal(first + l)[i];
        values[i].im[l] = signal(first + l + columns)[i];
      }
    std::fill(values + given, values + length(), Lane{});
  }
}

void BatchFourier::store_reals(const Work& work, int count, int wanted, double scale,
                               double* const* out) const {
  const int whole = wanted / lanes * lanes;
  for (int p = 0; p < parts; ++p) {
    const Lane* const values = part(work, p);
    const int first = p * lanes;
    for (int i = 0; i < whole; i += lanes) {
      BatchDoubles re[lanes], im[lanes];
      for (int k = 0; k < lanes; ++k) {
        re[k] = values[i + k].re * scale;
        im[k] = values[i + k].im * scale;
      }
      register_vectors::transpose(re);
      register_vectors::transpose(im);
      for (int l = 0; l < lanes; ++l) {
        if (first + l < count) std::memcpy(out[first + l] + i, &re[l], sizeof re[0]);
        if (first + l + columns < count) std::memcpy(out[first + l + columns] + i, &im[l], sizeof im[0]);
      }
    }
    for (int i = whole; i < wanted; ++i)
      for (int l = 0; l < lanes; ++l) {
        if (first + l < count) out[first + l][i] = values[i].re[l] * scale;
        if (first + l + columns < count) out[first + l + columns][i] = values[i].im[l] * scale;
      }
  }
}

void BatchFourier::multiply_even(Work& work, const double* factors) const {
  for (int p = 0; p < parts; ++p) {
    Lane* const values = part(work, p);
    const auto multiply = [&](int bin, double factor) {
      Lane& value = values[place(bin)];
      value.re *= factor;
      value.im *= factor;
    };
    for (int b = 0; b < bins(); ++b) {
      multiply(b, factors[b]);
      if (b > 0 && 2 * b < length()) multiply(length() - b, factors[b]);
    }
  }
}

void BatchFourier::real_forward(Work& work, const double* const* in, int given, int count,
                                std::complex<double>* const* out) const {
  const int n = length();
  load_reals(work, in, given, count);
  forward(work);
  // Z = A + iB: A(k) = (Z(k) + conj Z(−k))/2, B(k) = (Z(k) − conj Z(−k))/2i.
  for (int p = 0; p < parts; ++p) {
    const Lane* const values = part(work, p);
    for (int first = 0; first < bins(); first += lanes) {
      BatchDoubles square[4][lanes];  // real and imaginary parts of A, then of B
      const int here = std::min(lanes, bins() - first);
      for (int c = 0; c < lanes; ++c) {
        const int k = first + std::min(c, here - 1);
        const Lane& low = values[place(k)];
        const Lane& high = values[place(k == 0 ? 0 : n - k)];
        square[0][c] = (low.re + high.re) * 0.5;
        square[1][c] = (low.im - high.im) * 0.5;
        square[2][c] = (low.im + high.im) * 0.5;
        square[3][c] = (high.re - low.re) * 0.5;
      }
      for (auto& one : square) register_vectors::transpose(one);
      for (int of = 0; of < 4; of += 2)
        for (int l = 0; l < lanes; ++l) {
          const int r = p * lanes + l + (of == 0 ? 0 : columns);
          if (r >= count) break;
          BatchDoubles pairs[2];
          register_vectors::interleave(square[of][l], square[of + 1][l], pairs[0], pairs[1]);
          std::memcpy(static_cast<void*>(out[r] + first), pairs,
                      sizeof(std::complex<double>) * static_cast<std::size_t>(here));
        }
    }
  }
}

void BatchFourier::real_inverse(Work& work, const std::complex<double>* const* in, int count, int wanted,
                                double scale, double* const* out) const {
  const int n = length();
  for (int p = 0; p < parts; ++p) {
    Lane* const values = part(work, p);
    for (int first = 0; first < bins(); first += lanes) {
      BatchDoubles square[4][lanes];
      const int here = std::min(lanes, bins() - first);
      for (int of = 0; of < 4; of += 2)
        for (int l = 0; l < lanes; ++l) {
          const int r = p * lanes + l + (of == 0 ? 0 : columns);
          BatchDoubles pairs[2] = {};
          std::memcpy(pairs, in[std::min(r, count - 1)] + first,
                      sizeof(std::complex<double>) * static_cast<std::size_t>(here));
          register_vectors::separate(pairs[0], pairs[1], square[of][l], square[of + 1][l]);
        }
      for (auto& one : square) register_vectors::transpose(one);
      for (int c = 0; c < here; ++c) {
        const int k = first + c;
        const BatchDoubles &a = square[0][c], &b = square[1][c], &x = square[2][c], &y = square[3][c];
        if (k == 0 || 2 * k == n) {
          values[place(k)] = {a, x};
        } else {
          values[place(k)] = {a - y, b + x};
          values[place(n - k)] = {a + y, x - b};
        }
      }
    }
  }
  inverse(work);
  store_reals(work, count, wanted, scale, out);
}

void BatchFourier::load(Work& work, const std::complex<double>* from, std::ptrdiff_t stride, int given,
                        int count, bool bins) const {
  const auto at = [&](int b) { return bins ? place(b) : b; };
  for (int b = 0; b < given; ++b, from += stride) {
    const std::complex<double>* const ahead =
        from + (b + batch_rows_ahead < given ? batch_rows_ahead * stride : 0);
    __builtin_prefetch(ahead, 1);
    __builtin_prefetch(ahead + columns / 2, 1);
    for (int p = 0; p < parts; ++p) {
      const int here = std::clamp(count - p * lanes, 0, lanes);
      BatchDoubles pairs[2] = {};
      if (here == lanes)
        std::memcpy(pairs, static_cast<const void*>(from + p * lanes), sizeof pairs);
      else
        std::memcpy(pairs, static_cast<const void*>(from + p * lanes),
                    sizeof(std::complex<double>) * static_cast<std::size_t>(here));
      Lane& to = part(work, p)[at(b)];
      register_vectors::separate(pairs[0], pairs[1], to.re, to.im);
    }
  }
  for (int p = 0; p < parts; ++p)
    for (int b = given; b < length(); ++b) part(work, p)[at(b)] = Lane{};
}

void BatchFourier::store(const Work& work, std::complex<double>* to, std::ptrdiff_t stride, int wanted,
                         int count, bool bins) const {
  for (int b = 0; b < wanted; ++b, to += stride) {
    std::complex<double>* const ahead = to + (b + batch_rows_ahead < wanted ? batch_rows_ahead * stride : 0);
    __builtin_prefetch(ahead, 1);
    __builtin_prefetch(ahead + columns / 2, 1);
    for (int p = 0; p < parts; ++p) {
      const int here = std::clamp(count - p * lanes, 0, lanes);
      BatchDoubles pairs[2];
      const Lane& from = part(work, p)[bins ? place(b) : b];
      register_vectors::interleave(from.re, from.im, pairs[0], pairs[1]);
      if (here == lanes)
        std::memcpy(static_cast<void*>(to + p * lanes), pairs, sizeof pairs);
      else
        std::memcpy(static_cast<void*>(to + p * lanes), pairs,
                    sizeof(std::complex<double>) * static_cast<std::size_t>(here));
    }
  }
}

}  // namespace asperity
