// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/web/confined/event_channel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/quantity.hpp"

namespace asperity::web {

namespace {

constexpr int most_views = 200, first_views = 20;

const char* stop_name(StopReason reason) {
  return reason == StopReason::interrupt      ? "interrupt"
         : reason == StopReason::time_limit   ? "time"
         : reason == StopReason::memory_limit ? "memory"
                                              : "";
}

template <class T>
std::shared_ptr<const T> as(const lua::Value& value) {
  const auto* object = std::get_if<lua::Object>(&value.data);
  if (object == nullptr || object->pointer == nullptr || object->type != &lua::class_of<T>()) return nullptr;
  return std::static_pointer_cast<const T>(object->pointer);
}

static_assert(std::endian::native == std::endian::little, "views are little-endian, as this machine must be");

void add_field(View& view, const std::string& name, const std::string& unit, const Field& field,
               const Grid& grid) {
  ReducedField small = reduced(field);
  view.fields.push_back(Json::object({{"name", name},
                                      {"unit", unit},
                                      {"nx", small.nx},
                                      {"ny", small.ny},
                                      {"size_x", grid.size_x},
                                      {"size_y", grid.size_y},
                                      {"from_nx", grid.nx},
                                      {"from_ny", grid.ny},
                                      {"reduction", reduction_text(small, grid.nx, grid.ny)}}));
  view.values.push_back(std::move(small.values));
}

}  // namespace

ReducedField reduced(const Field& field, int most) {
  const auto block_of = [&](int nodes) { return std::max(1, (nodes + most - 1) / most); };
  ReducedField small;
  small.block_x = block_of(field.nx());
  small.block_y = block_of(field.ny());
  small.nx = (field.nx() + small.block_x - 1) / small.block_x;
  small.ny = (field.ny() + small.block_y - 1) / small.block_y;
  if (small.block_x == 1 && small.block_y == 1) {
    small.values.resize(field.size());
    std::ranges::transform(field.values(), small.values.begin(),
                           [](double value) { return static_cast<float>(value); });
    return small;
  }
  std::vector<double> sums(static_cast<std::size_t>(small.nx));
  std::vector<int> missing(sums.size());
  for (int j = 0; j < small.ny; ++j) {
    std::ranges::fill(sums, 0.0);
    std::ranges::fill(missing, 0);
    const int first = j * small.block_y, end = std::min(first + small.block_y, field.ny());
    for (int row = first; row < end; ++row) {
      const auto values = field.row(row);
      for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t block = i / static_cast<std::size_t>(small.block_x);
        if (std::isnan(values[i]))
          ++missing[block];
        else
          sums[block] += values[i];
      }
    }
    for (int i = 0; i < small.nx; ++i) {
      const int wide = std::min(small.block_x, field.nx() - i * small.block_x);
      const int there = wide * (end - first) - missing[static_cast<std::size_t>(i)];
      small.values.push_back(there > 0 ? static_cast<float>(sums[static_cast<std::size_t>(i)] / there)
                                       : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return small;
}

std::string reduction_text(const ReducedField& field, int from_nx, int from_ny) {
  if (field.block_x == 1 && field.block_y == 1) return "none";
  const bool even = from_nx % field.block_x == 0 && from_ny % field.block_y == 0;
  return "mean of " + std::to_string(field.block_x) + " x " + std::to_string(field.block_y) + " nodes" +
         (even ? "" : ", fewer at the far edges");
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - k);
    unsigned word = 0;
    for (std::size_t b = 0; b < 3; ++b)
      word = word << 8 | (b < count ? static_cast<unsigned char>(bytes[k + b]) : 0U);
    for (std::size_t d = 0; d < 4; ++d) text += d <= count ? digits[word >> (18 - 6 * d) & 63] : '=';
  }
  return text;
}

View view_of(const Surface& surface, const std::string& title) {
  View view{title};
  add_field(view, "height", "m", surface.measured_heights(), surface.grid());
  if (!surface.complete())
    view.fields[0].set("not_measured",
                       static_cast<std::int64_t>(surface.grid().nodes() - surface.measured()));
  return view;
}

View view_of(const State& state, const std::string& title) {
  View view{title};
  for (const auto& [name, unit] :
       {std::pair{"pressure", "Pa"}, {"gap", "m"}, {"contact", ""}, {"plastic", "m"}}) {
    try {
      add_field(view, name, unit, *state.field(name), state.grid());
    } catch (const Error& error) {
      // The contact lacks this effect.
      if (error.code() != ErrorCode::bad_state) throw;
    }
  }
  return view;
}

Json to_json(const View& view) {
  Json::List fields = view.fields;
  for (std::size_t k = 0; k < fields.size(); ++k)
    fields[k].set("data", base64({reinterpret_cast<const char*>(view.values[k].data()),
                                  view.values[k].size() * sizeof(float)}));
  return Json::object({{"title", view.title}, {"fields", std::move(fields)}});
}

Json error_event(const std::string& text) {
  constexpr std::string_view mark = "\nstack traceback:\n";
  Json parts = Json::object({{"type", "error"}});
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

View Seen::view() const { return surface ? view_of(*surface, title()) : view_of(*state, title()); }

std::vector<Seen> seen_in(const std::string& call, const lua::Values& results) {
  std::vector<Seen> all;
  for (const lua::Value& value : results) {
    if (auto surface = as<Surface>(value))
      all.push_back({std::move(surface), nullptr, call});
    else if (auto state = as<asperity::State>(value))
      all.push_back({nullptr, std::move(state), call});
  }
  return all;
}

std::optional<Json> told_of(std::string_view event, const Json& fields) {
  if (event == "row") {
    Json units = fields["units"];
    Json told = Json::object({{"type", "row"},
                              {"notebook", fields["notebook"]},
                              {"row", fields["row"]},
                              {"units", units.is_null() ? Json::object() : std::move(units)}});
    if (Json columns = fields["columns"]; !columns.is_null()) told.set("columns", std::move(columns));
    return told;
  }
  if (event == "study end")
    return Json::object({{"type", "study"},
                         {"name", fields["name"]},
                         {"rows", fields["found"]["rows"]},
                         {"seconds", fields["unhashed"]["seconds"]}});
  if (event == "chart") {
    const Json study = fields["study"], notebook = fields["notebook"];
    if (!study.is_null()) return Json::object({{"type", "chart"}, {"study", study}});
    if (notebook.is_null()) return {};
    return Json::object({{"type", "chart"}, {"notebook", notebook}, {"chart", fields["unhashed"]}});
  }
  if (event != "expect") return {};
  const Json label = fields["label"], sentence = fields["sentence"];
  const std::string text = (label.is_null() ? "" : label.string() + ": ") + sentence.string();
  return Json::object({{"type", "expectation"}, {"text", text}, {"held", fields["passed"]}});
}

void EventChannel::send(const Json& event) {
  const std::lock_guard lock(mutex_);
  sink_(event.text() + "\n");
}

void EventChannel::progress(std::string_view task, double done, double seconds_left) {
  Json event = Json::object({{"type", "progress"}, {"task", task}, {"fraction", std::clamp(done, 0.0, 1.0)}});
  if (seconds_left >= 0) event.set("eta_s", seconds_left);
  send(event);
}

void EventChannel::recorded(std::string_view event, const Json& fields) {
  if (const std::optional<Json> told = told_of(event, fields)) send(*told);
}

void EventChannel::found(const std::string& call, const lua::Values& results) {
  for (Seen& seen : seen_in(call, results)) see(std::move(seen));
}

void EventChannel::see(Seen seen) {
  if (views_.empty()) return;
  const bool has_time = spent_ * 10 < Clock::now() - begun_;
  if (views_in_all_ < first_views || (views_in_all_ < most_views - 1 && has_time)) {
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
    send(Json::object({{"type", "view"}, {"name", name}, {"title", seen.title()}}));
  } catch (const std::exception&) {
    views_.clear();  // a full disk ends no run
  }
  spent_ += Clock::now() - begun;
}

void EventChannel::made_knobs(const Json& knobs) {
  send(Json::object({{"type", "knobs"}, {"knobs", knobs}}));
}

void EventChannel::mistake(const std::string& message) { send(error_event(message)); }

void EventChannel::ended(int status, StopReason stopped, const std::string& why) {
  if (last_.surface || last_.state) {
    --left_out_;
    keep_view(last_);
    last_ = {};
  }
  if (left_out_ > 0) send(Json::object({{"type", "views_left_out"}, {"count", left_out_}}));
  const bool asked = stopped == StopReason::interrupt || why.starts_with("os.exit(");
  if (!why.empty() && status != 0 && !asked) send(error_event(why));
  send(Json::object({{"type", "ended"},
                     {"exit", status},
                     {"stopped", stop_name(stopped)},
                     {"why", why.substr(0, why.find('\n'))}}));
}

}  // namespace asperity::web
