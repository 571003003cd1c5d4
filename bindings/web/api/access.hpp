// SPDX-License-Identifier: GPL-3.0-or-later
// Access control. A request must name this server as Host (against DNS rebinding) and must not come from
// another origin. All requests except for the page's own files need a token, which is compared in constant
// time.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/web/http/http.hpp"

namespace asperity::web {

// 258 random bits in 43 characters without URL escapes.
std::string new_token();
// Time depends on the lengths only.
bool same_text(std::string_view one, std::string_view other);

struct Person {
  std::string name, token;
};

class Access {
 public:
  // `hosts`: accepted Host values, "127.0.0.1:8000". `people`: at least one.
  Access(std::vector<std::string> hosts, std::vector<Person> people);

  // Why Host or Origin are wrong; "" if right.
  std::string misdirected(const HttpRequest& request) const;
  // Index in `people`.
  std::optional<std::size_t> person(const HttpRequest& request) const;
  const std::vector<Person>& people() const { return people_; }

 private:
  std::vector<std::string> hosts_;
  std::vector<Person> people_;
};

}  // namespace asperity::web
