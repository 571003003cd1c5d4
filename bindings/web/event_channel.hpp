// SPDX-License-Identifier: GPL-3.0-or-later
// What a run of the page tells the server: one line of JSON an event, through a pipe. Beside rows,
// expectations and progress it makes the views, where they were asked for.
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "bindings/cli/run_observer.hpp"

namespace asperity::web {

class EventChannel final : public cli::RunObserver {
 public:
  // `views`: a folder for them, which is made at the first; "" for none.
  EventChannel(int descriptor, std::string views) : descriptor_(descriptor), views_(std::move(views)) {}

  void send(const std::string& type, Json fields = Json::object());

  void progress(std::string_view task, double done, double seconds_left) override;
  void recorded(std::string_view event, const Json& fields) override;
  bool looks_at_results() const override { return !views_.empty(); }
  void found(const std::string& call, std::int64_t line, const lua::Values& results) override;
  void ended(int status, StopReason stopped, const std::string& why) override;

 private:
  void keep_view(const std::string& kind, const Json& view);

  std::mutex mutex_;
  int descriptor_;
  std::string views_;
  std::map<std::string, int> kept_;  // views of each kind
  int views_in_all_ = 0;
};

// An error message of a script in its parts: {line?, message, traceback?}.
Json error_parts(const std::string& text);

}  // namespace asperity::web
