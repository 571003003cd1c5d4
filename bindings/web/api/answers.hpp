// SPDX-License-Identifier: GPL-3.0-or-later
// JSON answers of /api, members of request bodies, files of a run, script check.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bindings/web/http/http.hpp"
#include "bindings/web/runs/page_run.hpp"
#include "engine/core/files/json.hpp"
#include "engine/run/run_knobs.hpp"

namespace asperity::web {

HttpResponse json_answer(const Json& json, int status = 200);
// A body in pieces.
HttpResponse stream_answer(std::string type, std::function<bool(std::string&)> stream);
HttpResponse problem_answer(int status, const std::string& message, const std::string& hint = {});

// All throw Error{bad_value} naming key and expected value.
Json body_of(const HttpRequest& request);
std::string text_member(const Json& body, const std::string& key, std::size_t longest);
std::int64_t whole_member(const Json& body, const std::string& key, std::int64_t otherwise);
// An object name -> "50 MPa" or "5e7", at most 100 members; may be missing.
GivenKnobs knobs_member(const Json& body, const std::string& key);
bool flag_member(const Json& body, const std::string& key);

// Events start at the query's `after` and stop after the last or some minutes; clients ask again.
HttpResponse events_answer(const std::shared_ptr<PageRun>& run, const HttpRequest& request);
HttpResponse file_answer(const PageRun& run, const std::string& name);
HttpResponse view_answer(const PageRun& run, const std::string& name);

// `asperity check` as a confined dry run: {marks: [{line, severity, message}], checked_to?, knobs?}; `knobs`
// as in a manifest, up to the point reached. `scratch`: parent of a temporary folder. After one second the
// check ends as soon as others wait.
Json check_script(const std::string& script, const std::filesystem::path& scratch,
                  const std::vector<std::string>& barriers, const std::function<bool()>& others_wait);

}  // namespace asperity::web
