// SPDX-License-Identifier: GPL-3.0-or-later
// Who may ask. A request must name this server as its Host (a page of another site whose name was made to
// point here does not), must not come from a page of another origin, and, for anything but the page's own
// files, must carry a token, which is compared in a time that does not depend on where it differs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/web/http.hpp"

namespace asperity::web {

// 256 bits of the system's randomness, in 43 characters that need no escaping in an address.
std::string new_token();
// In a time that depends on the lengths alone.
bool same_text(std::string_view one, std::string_view other);

struct Person {
  std::string name, token;
};

class Access {
 public:
  // `hosts`: what Host may say, "127.0.0.1:8000"; `people`: at least one.
  Access(std::vector<std::string> hosts, std::vector<Person> people);

  // Why a request is not for this server, "" if it is: of Host and Origin alone.
  std::string misdirected(const HttpRequest& request) const;
  // Whose token it carries: an index of `people`.
  std::optional<std::size_t> person(const HttpRequest& request) const;
  const std::vector<Person>& people() const { return people_; }

 private:
  std::vector<std::string> hosts_;
  std::vector<Person> people_;
};

}  // namespace asperity::web
