// SPDX-License-Identifier: GPL-3.0-or-later
// The server's answers. The page's files and the documents under /docs/ need the right Host only; paths under
// /api need a token. An error is {error: {message, hint?}}. A person sees only their own runs. The
// first person of a classroom is the teacher and sees all runs. Only the teacher reads /api/room (runs),
// /api/people (predictions and requests for help) and /api/people/NAME (the script sent with a request).
// Students post to /api/predictions and /api/help. The teacher posts a script to /api/handed, and students
// get it there. Notes of lessons and faults of their files are for the teacher, or for the only person.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bindings/web/api/access.hpp"
#include "bindings/web/http/http.hpp"
#include "bindings/web/runs/live_sessions.hpp"
#include "bindings/web/runs/run_queue.hpp"
#include "bindings/web/runs/turns.hpp"
#include "engine/core/files/json.hpp"

namespace asperity::web {

// Read and packed once at server start: no request reads the disk.
class PageFiles {
 public:
  // `folder`: none if not built; `needs` then explains the build. `root`: address of the folder, "/".
  PageFiles(const std::optional<std::filesystem::path>& folder, std::string root, std::string needs);
  bool built() const { return !files_.empty(); }
  // Digests as in a content policy: " 'sha256-…' 'sha256-…'".
  const std::string& inline_scripts() const { return inline_scripts_; }
  HttpResponse answer(const HttpRequest& request) const;

 private:
  struct File {
    std::string content, packed, type, tag;
  };
  std::map<std::string, File> files_;  // by path: "/index.html"
  std::string root_, needs_, inline_scripts_;
};

// A sentence about building the page.
extern const char* const page_needs;

struct SharedScript {
  std::string name, script;
};

// Predictions, requests for help and shared scripts of a classroom. In memory, bounded for each person.
// Thread-safe.
class RoomBoard {
 public:
  static constexpr std::size_t longest_name = 60, most_lessons = 40, most_guesses = 12, longest_why = 2000,
                               most_handed = std::size_t{256} << 10, most_shown = std::size_t{64} << 10;

  struct Prediction {
    std::map<std::string, Json> guesses;  // by name: numbers and choices
    std::string why;
  };
  struct Notes {
    std::map<std::string, Prediction> predictions;  // by lesson
    bool help = false;                              // asked for
    std::optional<SharedScript> script;             // sent with the request
  };
  // To the room. The number grows with each script, also over server starts.
  struct Handed {
    std::int64_t number = 0;
    std::optional<SharedScript> script;
  };

  // Replaces the person's prediction for a lesson; no `guesses` (an object) and no `why` delete it. Throws
  // Error{bad_value} beyond these limits, or for a guess that is no finite number and no text.
  void predict(std::size_t person, const std::string& lesson, const Json& guesses, const std::string& why);
  void ask_for_help(std::size_t person, bool wanted, std::optional<SharedScript> script);
  // None takes the script of the room back.
  void hand(std::optional<SharedScript> script);

  Notes notes_of(std::size_t person) const;
  Handed handed() const;

 private:
  mutable std::mutex mutex_;
  Handed handed_;
  std::map<std::size_t, Notes> of_;
};

struct ApiSetup {
  RunLimits limits;
  int at_once = 2;
  bool classroom = false;
  std::vector<std::string> barriers;
  std::filesystem::path scratch;  // for checks
  std::filesystem::path lessons;  // of the teacher; empty: none
};

class Api final : public HttpHandler {
 public:
  // `documents`: their site's folder, none if not built.
  Api(ApiSetup setup, const Access& access, RunQueue& runs, LiveSessions& live, PageFiles page,
      const std::optional<std::filesystem::path>& documents);

  std::optional<HttpResponse> refuse(const HttpRequest& head) override;
  HttpResponse answer(const HttpRequest& request) override;

 private:
  std::optional<HttpResponse> refusal_of(const HttpRequest& head) const;
  HttpResponse route(const HttpRequest& request);
  bool is_teacher(std::size_t person) const { return setup_.classroom && person == 0; }
  HttpResponse about(std::size_t person) const;
  HttpResponse complete(std::size_t person, const HttpRequest& request);
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
  HttpResponse lesson(std::size_t person, const std::string& name) const;
  bool sees_notes(std::size_t person) const { return !setup_.classroom || is_teacher(person); }
  HttpResponse hand(const HttpRequest& request);
  HttpResponse handed(const HttpRequest& request) const;
  HttpResponse shown_by(const std::string& name) const;

  const ApiSetup setup_;
  const Access& access_;
  RunQueue& runs_;
  LiveSessions& live_;
  const PageFiles page_;
  const PageFiles documents_;
  RoomBoard board_;
  Turns checks_{{.places = 4, .for_quick = 2}};  // two for quick checks
  Turns completions_{{.places = 4}};             // one per person
  Turns streams_;                                // long-lived answers
};

}  // namespace asperity::web
