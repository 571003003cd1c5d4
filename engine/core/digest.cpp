// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/digest.hpp"

#define XXH_STATIC_LINKING_ONLY
#include <xxhash.h>

#include <new>

#include "engine/core/text.hpp"

namespace asperity {

void Digester::Free::operator()(XXH3_state_s* hash) const { XXH3_freeState(hash); }

Digester::Digester() : hash_(XXH3_createState()) {
  if (hash_ == nullptr) throw std::bad_alloc();
  XXH3_128bits_reset(hash_.get());
}

Digester& Digester::add(char kind, std::uint64_t count, const void* data, std::size_t bytes) {
  XXH3_128bits_update(hash_.get(), &kind, 1);
  XXH3_128bits_update(hash_.get(), &count, sizeof count);
  XXH3_128bits_update(hash_.get(), data, bytes);
  return *this;
}

Digester& Digester::add(std::string_view text) { return add('s', text.size(), text.data(), text.size()); }
Digester& Digester::add(double value) { return add(std::span<const double>(&value, 1)); }
Digester& Digester::add(std::int64_t value) { return add('i', 1, &value, sizeof value); }
Digester& Digester::add(std::span<const double> values) {
  return add('d', values.size(), values.data(), values.size_bytes());
}

std::string Digester::hex() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(hash_.get()));
  return hexadecimal(canonical.digest);
}

}  // namespace asperity
