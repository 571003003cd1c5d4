// SPDX-License-Identifier: GPL-3.0-or-later
// The two shapes of an answer of /api, and the members of a request's body.
#pragma once

#include <string>

#include "bindings/web/http.hpp"
#include "engine/core/files/json.hpp"

namespace asperity::web {

HttpResponse json_answer(const Json& json, int status = 200);
HttpResponse problem_answer(int status, const std::string& message, const std::string& hint = {});

// The body as an object. Throw Error{bad_value} naming the key and what it should be.
Json body_of(const HttpRequest& request);
std::string text_member(const Json& body, const std::string& key, std::size_t longest);
std::int64_t whole_member(const Json& body, const std::string& key, std::int64_t otherwise);
bool flag_member(const Json& body, const std::string& key);

}  // namespace asperity::web
