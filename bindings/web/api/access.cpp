// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/api/access.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/error.hpp"

namespace asperity::web {

const std::string* HttpRequest::header(const std::string& name) const {
  return headers.count(name) == 1 ? &headers.find(name)->second : nullptr;
}

std::string new_token() {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::array<unsigned char, 43> random{};
  if (::getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size()))
    refuse_state("the system gives no random numbers for a token");
  std::string token;
  for (const unsigned char byte : random) token += digits[byte & 63];
  return token;
}

bool same_text(std::string_view one, std::string_view other) {
  if (one.size() != other.size()) return false;
  unsigned different = 0;
  for (std::size_t k = 0; k < one.size(); ++k)
    different |=
        static_cast<unsigned char>(one[k]) ^ static_cast<unsigned>(static_cast<unsigned char>(other[k]));
  return different == 0;
}

Access::Access(std::vector<std::string> hosts, std::vector<Person> people)
    : hosts_(std::move(hosts)), people_(std::move(people)) {}

std::string Access::misdirected(const HttpRequest& request) const {
  const std::string* host = request.header("host");
  if (host == nullptr || std::ranges::find(hosts_, *host) == hosts_.end())
    return "this server is not the one that Host names";
  if (request.headers.contains("origin")) {
    const std::string* origin = request.header("origin");
    const auto own = [&](const std::string& name) {
      return origin != nullptr && *origin == "http://" + name;
    };
    if (std::ranges::none_of(hosts_, own)) return "the request comes from a page of another origin";
  }
  // Sent by browsers even without an Origin.
  if (request.headers.contains("sec-fetch-site")) {
    const std::string* site = request.header("sec-fetch-site");
    if (site == nullptr || (*site != "same-origin" && *site != "none")) {
      const std::string* mode = request.header("sec-fetch-mode");
      if (mode == nullptr || *mode != "navigate" || request.path.starts_with("/api"))
        return "the request comes from a page of another site";
    }
  }
  return "";
}

std::optional<std::size_t> Access::person(const HttpRequest& request) const {
  constexpr std::string_view scheme = "Bearer ";
  const std::string* given = request.header("authorization");
  if (given == nullptr || !given->starts_with(scheme)) return {};
  const std::string_view token = std::string_view(*given).substr(scheme.size());
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < people_.size(); ++k)
    if (same_text(token, people_[k].token)) found = k;
  return found;
}

}  // namespace asperity::web
