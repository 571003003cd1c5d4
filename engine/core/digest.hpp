// SPDX-License-Identifier: GPL-3.0-or-later
// A 128-bit digest of content (XXH3), as 32 hexadecimal digits. It tells whether two values are the
// same numbers; it is not a signature.
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

  // Each item carries its kind and length, so that no two sequences of items run together.
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
