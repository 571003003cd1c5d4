// SPDX-License-Identifier: GPL-3.0-or-later
// The server's answers. The page's files need the right Host only; paths under /api need a token. An error is
// {error: {message, hint?}}. A person sees only their own runs; the first person of a classroom, its teacher,
// sees all: /api/room lists runs, /api/people predictions (POST /api/predictions) and requests for help (POST
// /api/help).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bindings/web/api/access.hpp"
#include "bindings/web/api/page_files.hpp"
#include "bindings/web/api/room_board.hpp"
#include "bindings/web/http/http.hpp"
#include "bindings/web/runs/live_sessions.hpp"
#include "bindings/web/runs/run_queue.hpp"
#include "bindings/web/runs/shares.hpp"

namespace asperity::web {

struct ApiSetup {
  RunLimits limits;
  int at_once = 2;
  bool classroom = false;
  std::vector<std::string> barriers;
  std::filesystem::path scratch;  // for checks
};

class Api final : public HttpHandler {
 public:
  Api(ApiSetup setup, const Access& access, RunQueue& runs, LiveSessions& live, PageFiles page);

  std::optional<HttpResponse> refuse(const HttpRequest& head) override;
  HttpResponse answer(const HttpRequest& request) override;

 private:
  HttpResponse route(const HttpRequest& request);
  bool is_teacher(std::size_t person) const { return setup_.classroom && person == 0; }
  HttpResponse about(std::size_t person) const;
  HttpResponse complete(const HttpRequest& request) const;
  HttpResponse check(std::size_t person, const HttpRequest& request);
  HttpResponse begin_run(std::size_t person, const HttpRequest& request);
  HttpResponse begin_live(std::size_t person, const HttpRequest& request);
  HttpResponse of_live(std::size_t person, const HttpRequest& request, const std::string& id);
  HttpResponse runs_of(std::size_t person) const;
  HttpResponse room() const;
  HttpResponse people() const;
  HttpResponse predict(std::size_t person, const HttpRequest& request);
  HttpResponse help(std::size_t person, const HttpRequest& request);
  HttpResponse of_run(std::size_t person, const HttpRequest& request, const std::shared_ptr<PageRun>& run,
                      const std::string& rest);
  HttpResponse lessons() const;
  HttpResponse lesson(const std::string& name) const;

  const ApiSetup setup_;
  const Access& access_;
  RunQueue& runs_;
  LiveSessions& live_;
  const PageFiles page_;
  RoomBoard board_;
  Shares checks_{1, 4, 2};  // two for quick checks
  Shares streams_;          // long-lived answers
};

}  // namespace asperity::web
