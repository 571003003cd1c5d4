// SPDX-License-Identifier: GPL-3.0-or-later
// 128-bit digest of content (XXH3), 32 hexadecimal digits. Not a cryptographic signature.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace asperity {

class Digester {
 public:
  Digester();
  ~Digester();
  Digester(Digester&&) noexcept;
  Digester& operator=(Digester&&) noexcept;

  // Items include kind and length, so that sequences are unambiguous.
  Digester& add(std::string_view text);
  Digester& add(const char* text) { return add(std::string_view(text)); }
  Digester& add(double value);
  Digester& add(std::int64_t value);
  Digester& add(int value) { return add(static_cast<std::int64_t>(value)); }
  Digester& add(std::span<const double> values);
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace asperity
