// SPDX-License-Identifier: GPL-3.0-or-later
// Access to the server. A request must name this server as Host, against DNS rebinding, and must not come
// from a page of another origin. All requests except for the page's own files must carry a token. The
// comparison time of a token does not depend on the position of the first difference.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/web/http.hpp"

namespace asperity::web {

// 256 random bits of the system in 43 characters that an address does not escape.
std::string new_token();
// The time depends on the lengths only.
bool same_text(std::string_view one, std::string_view other);

struct Person {
  std::string name, token;
};

class Access {
 public:
  // `hosts`: accepted Host values, such as "127.0.0.1:8000". `people`: at least one.
  Access(std::vector<std::string> hosts, std::vector<Person> people);

  // Why Host or Origin show a request for another server; "" if both are right.
  std::string misdirected(const HttpRequest& request) const;
  // The index in `people` of the request's token.
  std::optional<std::size_t> person(const HttpRequest& request) const;
  const std::vector<Person>& people() const { return people_; }

 private:
  std::vector<std::string> hosts_;
  std::vector<Person> people_;
};

}  // namespace asperity::web
