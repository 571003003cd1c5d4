// SPDX-License-Identifier: GPL-3.0-or-later
// The two shapes of an answer of /api, and the members of a request's body.
#pragma once

#include <string>

#include "bindings/web/http.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

HttpResponse json_answer(const Json& json, int status = 200);
HttpResponse problem_answer(int status, const std::string& message, const std::string& hint = {});

// The body as an object. Throw Error{bad_value} naming the key and what it should be.
Json body_of(const HttpRequest& request);
std::string text_member(const Json& body, const std::string& key, std::size_t longest);
std::int64_t whole_member(const Json& body, const std::string& key, std::int64_t otherwise);
// An object of texts, name -> "50 MPa" or "5e7"; none where it is not there. At most a hundred.
GivenKnobs knobs_member(const Json& body, const std::string& key);
bool flag_member(const Json& body, const std::string& key);

}  // namespace asperity::web
