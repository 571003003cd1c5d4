// SPDX-License-Identifier: GPL-3.0-or-later
// 128-bit digest of content (XXH3), 32 hexadecimal digits. Not a cryptographic signature.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct XXH3_state_s;

namespace asperity {

class Digester {
 public:
  Digester();

  // Items include kind and length, so that sequences are unambiguous.
  Digester& add(std::string_view text);
  Digester& add(const char* text) { return add(std::string_view(text)); }
  Digester& add(double value);
  Digester& add(std::int64_t value);
  Digester& add(int value) { return add(static_cast<std::int64_t>(value)); }
  Digester& add(std::span<const double> values);
  std::string hex() const;

 private:
  struct Free {
    void operator()(XXH3_state_s* hash) const;
  };
  Digester& add(char kind, std::uint64_t count, const void* data, std::size_t bytes);
  std::unique_ptr<XXH3_state_s, Free> hash_;
};

}  // namespace asperity
