// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/vector_width.hpp"

#include "engine/core/arithmetic/register_vectors.hpp"

namespace asperity {

int vector_bytes() { return register_bytes; }

std::string_view vector_level() {
#if defined(__AVX512BW__) && defined(__AVX512CD__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
  return "x86-64-v4";
#elif defined(__AVX2__) && defined(__FMA__) && defined(__BMI2__) && defined(__F16C__)
  return "x86-64-v3";
#elif defined(__x86_64__)
  return "x86-64";
#else
  return "";
#endif
}

}  // namespace asperity
