// SPDX-License-Identifier: GPL-3.0-or-later
// JSON answers of /api, members of request bodies, and the answers for script check and completion.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/web/http/http.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

HttpResponse json_answer(const Json& json, int status = 200);
HttpResponse problem_answer(int status, const std::string& message, const std::string& hint = {});

// These functions throw Error{bad_value} naming key and expected value.
Json body_of(const HttpRequest& request);
std::string text_member(const Json& body, const std::string& key, std::size_t longest);
std::int64_t whole_member(const Json& body, const std::string& key, std::int64_t otherwise);
// An object name -> "50 MPa" or "5e7", at most 100 members; empty if missing.
GivenKnobs knobs_member(const Json& body, const std::string& key);
bool flag_member(const Json& body, const std::string& key);

// `asperity check` as a confined dry run: {marks: [{line, severity, message}], checked_to?, knobs?}; `knobs`
// as in a manifest, up to the point reached. `scratch`: parent of a temporary folder.
Json check_script(const std::string& script, const std::filesystem::path& scratch,
                  const std::vector<std::string>& barriers);

// {from, candidates: [{text, kind, detail, help}]}, with positions in UTF-16 units.
Json completion_of(const std::string& text, std::size_t unit);

// Convert UTF-16 units (browser) and UTF-8 bytes. byte_of_unit returns the first byte of the character, or
// the end.
std::size_t byte_of_unit(std::string_view text, std::size_t unit);
std::size_t unit_of_byte(std::string_view text, std::size_t byte);

}  // namespace asperity::web
