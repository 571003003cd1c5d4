// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/fourier_plan.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>

#include "engine/core/error.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

namespace {
using Complex = std::complex<double>;

struct DestroyPlan {
  void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
};
using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, DestroyPlan>;
}  // namespace

std::unique_lock<std::mutex> lock_fourier_planner() {
  static std::mutex mutex;
  return std::unique_lock(mutex);
}

// The planner of FFTW is not thread-safe; executing a finished plan is. A plan is never thrown away
// while the process lives.
fftw_plan fourier_plan(int n, FourierPlan kind) {
  static std::map<std::pair<int, FourierPlan>, Plan> plans;
  const auto lock = lock_fourier_planner();
  Plan& plan = plans[{n, kind}];
  if (plan) return plan.get();
  Array<Complex> in(static_cast<std::size_t>(n)), out(static_cast<std::size_t>(n));
  auto* const real_in = reinterpret_cast<double*>(in.data());
  auto* const real_out = reinterpret_cast<double*>(out.data());
  constexpr unsigned kept = FFTW_ESTIMATE | FFTW_PRESERVE_INPUT;
  switch (kind) {
    case FourierPlan::real_forward:
      plan.reset(fftw_plan_dft_r2c_1d(n, real_in, fftw(out.data()), kept));
      break;
    case FourierPlan::real_inverse:
      plan.reset(fftw_plan_dft_c2r_1d(n, fftw(in.data()), real_out, FFTW_ESTIMATE | FFTW_DESTROY_INPUT));
      break;
    case FourierPlan::complex_forward:
      plan.reset(fftw_plan_dft_1d(n, fftw(in.data()), fftw(out.data()), FFTW_FORWARD, kept));
      break;
    case FourierPlan::complex_inverse:
      plan.reset(fftw_plan_dft_1d(n, fftw(in.data()), fftw(out.data()), FFTW_BACKWARD, kept));
      break;
  }
  if (!plan) throw Error(ErrorCode::internal, "no Fourier transform of length " + std::to_string(n));
  return plan.get();
}

}  // namespace asperity
