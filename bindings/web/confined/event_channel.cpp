// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/event_channel.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "bindings/cli/terminal_monitor.hpp"
#include "bindings/lua/registry/placeholder.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/files/disk.hpp"
#include "engine/core/quantity.hpp"

namespace asperity::web {

namespace {

constexpr int most_views = 200, first_views = 20;

const char* stop_name(StopReason reason) {
  switch (reason) {
    case StopReason::interrupt:
      return "interrupt";
    case StopReason::time_limit:
      return "time";
    case StopReason::memory_limit:
      return "memory";
    case StopReason::none:
      break;
  }
  return "";
}

Json field_or_null(const Json& fields, std::string_view name) {
  const Json* found = fields.find(name);
  return found == nullptr ? Json() : *found;
}

template <class T>
std::shared_ptr<const T> as(const lua::Value& value) {
  const auto* object = std::get_if<lua::Object>(&value.data);
  if (object == nullptr || object->pointer == nullptr || object->type != &lua::class_of<T>()) return nullptr;
  return std::static_pointer_cast<const T>(object->pointer);
}

}  // namespace

Json error_parts(const std::string& text) {
  constexpr std::string_view mark = "\nstack traceback:\n";
  Json parts = Json::object();
  const std::size_t trace = text.find(mark);
  std::string message = text.substr(0, trace);
  if (const std::string line = lua::line_of(message); !line.empty() && line != "?" && line.size() < 9) {
    parts.set("line", std::stoi(line));
    // The page shows the line itself.
    const std::string where = ":" + line + ": ";
    if (const std::size_t at = message.find(where); at != std::string::npos)
      message.erase(0, at + where.size());
  }
  parts.set("message", message);
  if (trace != std::string::npos) parts.set("traceback", text.substr(trace + mark.size()));
  return parts;
}

std::string Seen::title() const {
  return surface ? call : call + " at " + format_quantity(state->pressure(), dimension::pressure);
}

View Seen::view() const {
  return surface ? view_of(*surface, title(), line) : view_of(*state, title(), line);
}

std::vector<Seen> seen_in(const std::string& call, std::int64_t line, const lua::Values& results) {
  std::vector<Seen> all;
  for (const lua::Value& value : results) {
    if (auto surface = as<Surface>(value))
      all.push_back({std::move(surface), nullptr, call, line});
    else if (auto state = as<asperity::State>(value))
      all.push_back({nullptr, std::move(state), call, line});
  }
  return all;
}

std::optional<Json> told_of(std::string_view event, const Json& fields) {
  if (event == "row") {
    Json units = field_or_null(fields, "units");
    Json told = Json::object({{"type", "row"},
                              {"notebook", field_or_null(fields, "notebook")},
                              {"row", field_or_null(fields, "row")},
                              {"units", units.is_null() ? Json::object() : std::move(units)}});
    if (Json columns = field_or_null(fields, "columns"); !columns.is_null())
      told.set("columns", std::move(columns));
    return told;
  }
  if (event != "expect") return {};
  const Json label = field_or_null(fields, "label"), sentence = field_or_null(fields, "sentence");
  const std::string text = (label.is_null() ? "" : label.string() + ": ") + sentence.string();
  return Json::object({{"type", "expectation"}, {"text", text}, {"held", field_or_null(fields, "passed")}});
}

void EventChannel::send(const std::string& type, Json fields) {
  Json event = Json::object({{"type", type}});
  for (const auto& [name, value] : fields.members()) event.set(name, value);
  const std::lock_guard lock(mutex_);
  write_all(descriptor_, event.text() + "\n");
}

void EventChannel::progress(std::string_view task, double done, double seconds_left) {
  Json fields = Json::object({{"task", task}, {"fraction", std::clamp(done, 0.0, 1.0)}});
  if (seconds_left >= 0) {
    fields.set("eta_s", seconds_left);
    fields.set("text", "about " + cli::duration_text(seconds_left) + " left");
  }
  send("progress", std::move(fields));
}

void EventChannel::recorded(std::string_view event, const Json& fields) {
  if (const std::optional<Json> told = told_of(event, fields)) send(told->find("type")->string(), *told);
}

void EventChannel::found(const std::string& call, std::int64_t line, const lua::Values& results) {
  for (Seen& seen : seen_in(call, line, results)) see(std::move(seen));
}

bool EventChannel::has_time_for_views() const {
  return views_in_all_ < first_views ||
         (views_in_all_ < most_views - 1 && spent_ * 10 < Clock::now() - begun_);
}

void EventChannel::see(Seen seen) {
  if (views_.empty()) return;
  if (has_time_for_views()) {
    keep_view(seen);
    last_ = {};
  } else {
    ++left_out_;
    last_ = std::move(seen);
  }
}

void EventChannel::keep_view(const Seen& seen) {
  const Clock::time_point begun = Clock::now();
  const std::string kind = seen.kind();
  const std::string name = kind + "-" + std::to_string(++kept_[kind]);
  ++views_in_all_;
  try {
    const Json view = to_json(seen.view());
    std::filesystem::create_directories(views_);
    write_atomically(std::filesystem::path(views_) / (name + ".json"), view.text());
    send("view", Json::object({{"name", name}, {"title", seen.title()}}));
  } catch (const std::exception&) {
    views_.clear();  // a full disk must not end the run
  }
  spent_ += Clock::now() - begun;
}

void EventChannel::made_knobs(const Json& knobs) { send("knobs", Json::object({{"knobs", knobs}})); }

void EventChannel::mistake(const std::string& message) { send("error", error_parts(message)); }

void EventChannel::ended(int status, StopReason stopped, const std::string& why) {
  if (last_.surface || last_.state) {
    --left_out_;
    keep_view(last_);
    last_ = {};
  }
  if (left_out_ > 0) send("views_left_out", Json::object({{"count", left_out_}}));
  const bool asked = stopped == StopReason::interrupt || why.starts_with("os.exit(");
  if (!why.empty() && status != 0 && !asked) send("error", error_parts(why));
  send("ended",
       Json::object(
           {{"exit", status}, {"stopped", stop_name(stopped)}, {"why", why.substr(0, why.find('\n'))}}));
}

}  // namespace asperity::web
