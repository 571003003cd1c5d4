// SPDX-License-Identifier: GPL-3.0-or-later
// Events of a page run for the server: JSON lines through a pipe. Optionally writes views: the first surfaces
// and presses, later ones within a tenth of the run's time, and the last.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/run_observer.hpp"
#include "bindings/web/confined/views.hpp"
#include "engine/contact/state.hpp"
#include "engine/surface/surface.hpp"

namespace asperity::web {

// A surface or a press.
struct Seen {
  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const State> state;
  std::string call;
  std::int64_t line = 0;

  const char* kind() const { return surface ? "surface" : "press"; }
  std::string title() const;
  View view() const;
};
std::vector<Seen> seen_in(const std::string& call, std::int64_t line, const lua::Values& results);

// A journal event for the page; none if not shown.
std::optional<Json> told_of(std::string_view event, const Json& fields);

class EventChannel final : public cli::RunObserver {
 public:
  // `views`: created at the first view; "": no views.
  EventChannel(int descriptor, std::string views) : descriptor_(descriptor), views_(std::move(views)) {}

  void send(const std::string& type, Json fields = Json::object());

  void progress(std::string_view task, double done, double seconds_left) override;
  void recorded(std::string_view event, const Json& fields) override;
  bool looks_at_results() const override { return !views_.empty(); }
  void found(const std::string& call, std::int64_t line, const lua::Values& results) override;
  void mistake(const std::string& message) override;
  void made_knobs(const Json& knobs) override;
  void ended(int status, StopReason stopped, const std::string& why) override;

 private:
  using Clock = std::chrono::steady_clock;

  bool has_time_for_views() const;
  void see(Seen seen);
  void keep_view(const Seen& seen);

  std::mutex mutex_;
  int descriptor_;
  std::string views_;
  std::map<std::string, int> kept_;  // views
  int views_in_all_ = 0, left_out_ = 0;
  Clock::time_point begun_ = Clock::now();
  Clock::duration spent_{};  // on views
  Seen last_;                // left out so far
};

// {line?, message, traceback?}
Json error_parts(const std::string& text);

}  // namespace asperity::web
