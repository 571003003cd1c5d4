// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/c_library_identity.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#if __has_include(<gnu/libc-version.h>)
#include <gnu/libc-version.h>
#endif

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/digest.hpp"

namespace asperity {

std::string c_library_version() {
#if defined(__GLIBC__)
  return std::string("glibc ") + gnu_get_libc_version();
#else
  return {};
#endif
}

// Two ways of rounding differ in one value of some hundreds or thousands.
const std::string& c_library_functions() {
  static const std::string digest = [] {
    constexpr std::uint64_t arguments = 2000;
    const Stream stream(1, "C library");
    Digester digester;
    for (std::uint64_t k = 0; k < arguments; ++k) {
      const double x = stream.uniform(2 * k, 0, 30), y = stream.uniform(2 * k + 1, -8, 8);
      const std::array<double, 8> values = {std::sin(x), std::cos(x),    std::tan(x),      std::exp(y),
                                            std::log(x), std::pow(x, y), std::atan2(y, x), std::asin(y / 8)};
      digester.add(std::span<const double>(values));
    }
    return digester.hex();
  }();
  return digest;
}

}  // namespace asperity
