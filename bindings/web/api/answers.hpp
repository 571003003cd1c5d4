// SPDX-License-Identifier: GPL-3.0-or-later
// The two shapes of an answer of /api, the members of a request's body, and the answers that have a source of
// their own: of a script's check and completion.
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

// The body as an object. Throw Error{bad_value} naming the key and what it should be.
Json body_of(const HttpRequest& request);
std::string text_member(const Json& body, const std::string& key, std::size_t longest);
std::int64_t whole_member(const Json& body, const std::string& key, std::int64_t otherwise);
// An object of texts, name -> "50 MPa" or "5e7"; none where it is not there. At most a hundred.
GivenKnobs knobs_member(const Json& body, const std::string& key);
bool flag_member(const Json& body, const std::string& key);

// `asperity check` for the page (script_check.cpp): a dry run in a confined process, and what it found as
// marks in the text: {marks: [{line, severity, message}], checked_to?, knobs?}; `knobs`, as in a manifest,
// are those that the script made as far as it could be followed. `scratch`: a folder in which one for this is
// made.
Json check_script(const std::string& script, const std::filesystem::path& scratch,
                  const std::vector<std::string>& barriers);

// Completion for the page (script_completion.cpp), whose places in the text are counted as a browser counts:
// {from, candidates: [{text, kind, detail, help}]}.
Json completion_of(const std::string& text, std::size_t unit);

// Places in a text as a browser counts them, in units of UTF-16, and as this program does, in bytes of UTF-8
// (script_completion.cpp): the byte at which that unit begins, or the one its character begins at; the end
// for what lies beyond it.
std::size_t byte_of_unit(std::string_view text, std::size_t unit);
// How many units stand before that byte.
std::size_t unit_of_byte(std::string_view text, std::size_t byte);

}  // namespace asperity::web
