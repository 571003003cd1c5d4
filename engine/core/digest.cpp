// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/digest.hpp"

#define XXH_STATIC_LINKING_ONLY
#include <xxhash.h>

#include <new>

namespace asperity {

struct Digester::State {
  XXH3_state_t* hash = XXH3_createState();
  State() {
    if (hash == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(hash);
  }
  ~State() { XXH3_freeState(hash); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  void raw(char kind, std::uint64_t count, const void* data, std::size_t bytes) {
    XXH3_128bits_update(hash, &kind, 1);
    XXH3_128bits_update(hash, &count, sizeof count);
    XXH3_128bits_update(hash, data, bytes);
  }
};

Digester::Digester() : state_(std::make_unique<State>()) {}
Digester::~Digester() = default;
Digester::Digester(Digester&&) noexcept = default;
Digester& Digester::operator=(Digester&&) noexcept = default;

Digester& Digester::add(std::string_view text) {
  state_->raw('s', text.size(), text.data(), text.size());
  return *this;
}

Digester& Digester::add(double value) { return add(std::span<const double>(&value, 1)); }

Digester& Digester::add(std::int64_t value) {
  state_->raw('i', 1, &value, sizeof value);
  return *this;
}

Digester& Digester::add(std::span<const double> values) {
  state_->raw('d', values.size(), values.data(), values.size_bytes());
  return *this;
}

std::string Digester::hex() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_->hash));
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : canonical.digest) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

}  // namespace asperity
