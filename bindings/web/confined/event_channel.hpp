// SPDX-License-Identifier: GPL-3.0-or-later
// Events of a page run for the server: JSON lines, through a pipe or to the page itself. Optional views: the
// first surfaces and presses, later ones within a tenth of the run's time, and the last.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/terminal_monitor.hpp"
#include "engine/contact/state.hpp"
#include "engine/core/files/json.hpp"
#include "engine/core/grid.hpp"
#include "engine/surface/surface.hpp"

namespace asperity::web {

// Surface and contact fields for the page's 3-D view, in single precision. A node is the mean over a block of
// nodes (contact: the contact fraction), at most 256 nodes a side. Never part of a result.
inline constexpr int most_view_nodes = 256;  // a side

struct ReducedField {
  int nx = 0, ny = 0;
  int block_x = 1, block_y = 1;  // nodes; fewer at far edges
  std::vector<float> values;     // row by row, j first
};

// Blocks of ceil(n / most) nodes a side. One pass.
ReducedField reduced(const Field& field, int most = most_view_nodes);
// "none", "mean of 4 x 4 nodes", "mean of 3 x 3 nodes, fewer at the far edges".
std::string reduction_text(const ReducedField& field, int from_nx, int from_ny);

std::string base64(std::string_view bytes);

struct View {
  std::string title;
  Json::List fields{};                       // without `data`
  std::vector<std::vector<float>> values{};  // for each field
};
View view_of(const Surface& surface, const std::string& title);
// Pressure, gap, contact, and plastic flow if on.
View view_of(const State& state, const std::string& title);
// With `data` in base64.
Json to_json(const View& view);

// A surface or a press.
struct Seen {
  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const State> state;
  std::string call;

  const char* kind() const { return surface ? "surface" : "press"; }
  std::string title() const;
  View view() const;
};
std::vector<Seen> seen_in(const std::string& call, const lua::Values& results);

// A journal event for the page, if shown.
std::optional<Json> told_of(std::string_view event, const Json& fields);

class EventChannel final : public cli::RunObserver {
 public:
  // `sink`: takes each line. `views`: folder, created at the first; "": none.
  EventChannel(std::function<void(const std::string&)> sink, std::string views)
      : sink_(std::move(sink)), views_(std::move(views)) {}

  void send(const Json& event);

  void progress(std::string_view task, double done, double seconds_left) override;
  void recorded(std::string_view event, const Json& fields) override;
  bool looks_at_results() const override { return !views_.empty(); }
  void found(const std::string& call, const lua::Values& results) override;
  void mistake(const std::string& message) override;
  void made_knobs(const Json& knobs) override;
  void ended(int status, StopReason stopped, const std::string& why) override;

 private:
  using Clock = std::chrono::steady_clock;

  void see(Seen seen);
  void keep_view(const Seen& seen);

  std::mutex mutex_;
  std::function<void(const std::string&)> sink_;
  std::string views_;
  std::map<std::string, int> kept_;  // views
  int views_in_all_ = 0, left_out_ = 0;
  Clock::time_point begun_ = Clock::now();
  Clock::duration spent_{};  // on views
  Seen last_;                // left out so far
};

// {type: "error", line?, message, traceback?}
Json error_event(const std::string& text);

}  // namespace asperity::web
