// SPDX-License-Identifier: GPL-3.0-or-later
// What a run left and leaves, as answers: its events as they come, its files, its views.
#pragma once

#include <memory>
#include <string>

#include "bindings/web/http.hpp"
#include "bindings/web/runs/page_run.hpp"

namespace asperity::web {

// From the query's `after` on, until the last or for some minutes: whoever asks takes it up again.
HttpResponse events_answer(const std::shared_ptr<PageRun>& run, const HttpRequest& request);
HttpResponse file_answer(const PageRun& run, const std::string& name);
HttpResponse view_answer(const PageRun& run, const std::string& name);

}  // namespace asperity::web
