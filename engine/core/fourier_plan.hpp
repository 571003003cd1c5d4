// SPDX-License-Identifier: GPL-3.0-or-later
// FFTW's one-dimensional plans, made once per length and kept. Estimated, so that no timing decides
// which algorithm, hence which bits. Thread-safe. Included only by sources of this folder.
#pragma once

#include <fftw3.h>

#include <complex>
#include <mutex>

namespace asperity {

enum class FourierPlan { real_forward, real_inverse, complex_forward, complex_inverse };

// From one 64-byte aligned buffer into another; only real_inverse spoils its input. Unnormalised.
// Throws Error{internal} if FFTW has no plan.
fftw_plan fourier_plan(int n, FourierPlan kind);

// The same memory as FFTW names it.
inline fftw_complex* fftw(std::complex<double>* pointer) { return reinterpret_cast<fftw_complex*>(pointer); }

// Held while plans of other kinds are made or destroyed: FFTW's planner is not thread-safe.
std::unique_lock<std::mutex> lock_fourier_planner();

}  // namespace asperity
