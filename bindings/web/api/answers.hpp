// SPDX-License-Identifier: GPL-3.0-or-later
// The two shapes of an /api answer, the members of a request body, and the answers for script check and
// completion.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/web/http.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

HttpResponse json_answer(const Json& json, int status = 200);
HttpResponse problem_answer(int status, const std::string& message, const std::string& hint = {});

// The body as an object. These functions throw Error{bad_value} naming the key and the expected value.
Json body_of(const HttpRequest& request);
std::string text_member(const Json& body, const std::string& key, std::size_t longest);
std::int64_t whole_member(const Json& body, const std::string& key, std::int64_t otherwise);
// An object of texts, name -> "50 MPa" or "5e7"; empty if missing. At most 100 members.
GivenKnobs knobs_member(const Json& body, const std::string& key);
bool flag_member(const Json& body, const std::string& key);

// `asperity check` for the page: a dry run in a confined process. Returns {marks: [{line, severity,
// message}], checked_to?, knobs?}; `knobs`, as in a manifest, are the knobs made up to the point reached.
// `scratch`: parent of the temporary folder.
Json check_script(const std::string& script, const std::filesystem::path& scratch,
                  const std::vector<std::string>& barriers);

// Completion for the page, with positions in UTF-16 units: {from, candidates: [{text, kind, detail, help}]}.
Json completion_of(const std::string& text, std::size_t unit);

// Convert between UTF-16 units, the browser's positions, and UTF-8 bytes. byte_of_unit returns the first byte
// of the character that contains the unit, or the end for a unit past the end.
std::size_t byte_of_unit(std::string_view text, std::size_t unit);
std::size_t unit_of_byte(std::string_view text, std::size_t byte);

}  // namespace asperity::web
