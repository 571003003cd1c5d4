// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/program_identity.hpp"

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>

#if __has_include(<gnu/libc-version.h>)
#include <gnu/libc-version.h>
#endif

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/arithmetic/register_vectors.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr const char anchor = 0;

struct Search {
  std::array<const void*, 2> addresses;
  std::string identity;
};

// Appends the build id if the object contains one of the addresses.
int look_for_build_id(dl_phdr_info* object, std::size_t, void* of) {
  Search& search = *static_cast<Search*>(of);
  const auto covers = [&](const ElfW(Phdr) & part) {
    const std::uintptr_t begin = object->dlpi_addr + part.p_vaddr;
    return part.p_type == PT_LOAD && std::ranges::any_of(search.addresses, [&](const void* address) {
             const auto here = std::bit_cast<std::uintptr_t>(address);
             return here >= begin && here < begin + part.p_memsz;
           });
  };
  const std::span parts(object->dlpi_phdr, object->dlpi_phnum);
  if (std::ranges::none_of(parts, covers)) return 0;
  for (const ElfW(Phdr) & part : parts) {
    if (part.p_type != PT_NOTE) continue;
    const auto* at = std::bit_cast<const unsigned char*>(object->dlpi_addr + part.p_vaddr);
    const unsigned char* end = at + part.p_memsz;
    const auto padded = [](std::size_t bytes) { return (bytes + 3) / 4 * 4; };
    while (at + sizeof(ElfW(Nhdr)) <= end) {
      ElfW(Nhdr) note;
      std::memcpy(&note, at, sizeof note);
      const unsigned char* content = at + sizeof note + padded(note.n_namesz);
      if (note.n_type == NT_GNU_BUILD_ID) {
        search.identity += hexadecimal({content, note.n_descsz});
        return 0;
      }
      at = content + padded(note.n_descsz);
    }
  }
  return 0;
}

}  // namespace

__attribute__((noinline)) std::string build_identity() {
#ifdef __wasm__
  const void* caller = &anchor;  // one module
#else
  const void* caller = __builtin_return_address(0);
#endif
  Search search{{caller, &anchor}, {}};
  dl_iterate_phdr(look_for_build_id, &search);
  return search.identity;
}

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

std::string c_library_version() {
#if defined(__GLIBC__)
  return std::string("glibc ") + gnu_get_libc_version();
#else
  return {};
#endif
}

// Two roundings differ in about one of a thousand values.
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
