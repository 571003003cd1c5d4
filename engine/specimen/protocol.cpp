// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/specimen/protocol.hpp"
#include "engine/core/require.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/core/digest.hpp"

namespace asperity {

namespace {

constexpr int digits = 6;
constexpr std::size_t most_events = 10'000'000;

std::string duration(double seconds) {
  const auto whole = [](double count) { return count >= 1 && count == std::round(count); };
  if (const double hours = seconds / 3600; hours >= 2 && whole(hours)) return format_short(hours) + " h";
  return whole(seconds / 60) ? format_short(seconds / 60) + " min"
                             : format_quantity(seconds, dimension::time, digits);
}

std::string load_text(const PressRequest& request) {
  if (request.by_load())
    return format_quantity(request.value,
                           request.by == PressBy::load ? dimension::force : dimension::pressure, digits);
  if (request.by == PressBy::approach)
    return "to an approach of " + format_quantity(request.value, dimension::length, digits);
  return "to `" + std::string(name(request.by)) + "` " + format_short(request.value);
}

struct Detail {
  std::string operator()(const PressRequest& s) const {
    std::string text = " " + load_text(s);
    for (std::size_t k = 0; k < s.preload.size(); ++k)
      text += (k == 0 ? " preloaded to " : " and then ") + load_text({s.by, s.preload[k]});
    return text + (s.dwell ? " for " + duration(*s.dwell) : "");
  }
  std::string operator()(const Protocol::Release&) const { return ""; }
  std::string operator()(const Protocol::Place& s) const { return " with seed " + std::to_string(s.seed); }
  std::string operator()(const Protocol::Rotate& s) const {
    return " " + format_quantity(s.angle, dimension::angle, digits);
  }
  std::string operator()(const Protocol::Shift& s) const {
    return " by " + format_quantity(s.x, dimension::length, digits) + " along x and " +
           format_quantity(s.y, dimension::length, digits) + " along y";
  }
};

struct Checker {
  void operator()(const auto&) const {}
  void operator()(const PressRequest& s) const { check_numbers(s); }
  void operator()(const Protocol::Rotate& s) const { finite(s.angle, "the angle of `rotate`"); }
  void operator()(const Protocol::Shift& s) const {
    finite(s.x, "`x` of `shift`");
    finite(s.y, "`y` of `shift`");
  }
  static void finite(double value, const char* what) {
    if (!std::isfinite(value))
      refuse(std::string(what) + " is " + format_short(value), "give a finite value");
  }
};

struct Adder {
  Digester& digester;
  void operator()(const PressRequest& s) const {
    digester.add(name(s.by)).add(s.value);
    if (s.dwell) digester.add("dwell").add(*s.dwell);
    for (const double turn : s.preload) digester.add("preload").add(turn);
  }
  void operator()(const Protocol::Release&) const {}
  void operator()(const Protocol::Place& s) const { digester.add(static_cast<std::int64_t>(s.seed)); }
  void operator()(const Protocol::Rotate& s) const { digester.add(s.angle); }
  void operator()(const Protocol::Shift& s) const { digester.add(s.x).add(s.y); }
};

}  // namespace

std::string_view kind(const Protocol::Step& step) {
  constexpr std::array<std::string_view, std::variant_size_v<Protocol::Step>> names{
      "press", "release", "place", "rotate", "shift"};
  return names[step.index()];
}

std::string text(const Protocol::Step& step) { return std::string(kind(step)) + std::visit(Detail{}, step); }

Protocol::Protocol(std::vector<Event> events) {
  if (events.empty())
    refuse("a protocol has no events", "give at least one, such as { press={ pressure=\"10 MPa\" } }");
  if (events.size() > most_events)
    refuse("a protocol has " + std::to_string(events.size()) + " events",
           "give at most " + std::to_string(most_events));
  for (std::size_t k = 0; k < events.size(); ++k) {
    try {
      std::visit(Checker{}, events[k].step);
    } catch (const Error& error) {
      throw Error(error.code(), "event " + std::to_string(k + 1) + ": " + error.sentence(), error.hint());
    }
  }
  events_ = std::make_shared<const std::vector<Event>>(std::move(events));
}

std::size_t Protocol::presses() const {
  return static_cast<std::size_t>(std::count_if(events_->begin(), events_->end(), [](const Event& event) {
    return std::holds_alternative<PressRequest>(event.step);
  }));
}

Protocol Protocol::detected_in(std::shared_ptr<const Detection> recording) const {
  Protocol result = *this;
  result.recording_ = std::move(recording);
  return result;
}

Protocol Protocol::plus(const Protocol& next) const {
  std::vector<Event> all = *events_;
  all.insert(all.end(), next.events_->begin(), next.events_->end());
  for (Event& event : all) event.time.reset();
  return Protocol(std::move(all));
}

Protocol Protocol::repeated(std::int64_t times) const {
  const auto most = static_cast<std::int64_t>(most_events / count());
  if (times < 1 || times > most)
    refuse("a protocol of " + std::to_string(count()) + " events cannot be repeated " +
               std::to_string(times) + " times",
           "give a whole number from 1 to " + std::to_string(most));
  if (times == 1) return *this;
  std::vector<Event> all;
  all.reserve(count() * static_cast<std::size_t>(times));
  for (std::int64_t k = 0; k < times; ++k) all.insert(all.end(), events_->begin(), events_->end());
  for (Event& event : all) event.time.reset();
  return Protocol(std::move(all));
}

std::string Protocol::text() const {
  constexpr std::size_t first = 20, last = 5;
  const std::size_t n = count(), width = std::to_string(n).size();
  std::string all = "protocol of " + std::to_string(n) + (n == 1 ? " event" : " events");
  for (std::size_t k = 0; k < n; ++k) {
    if (n > first + last && k == first) {
      all += "\n  ... " + std::to_string(n - first - last) + " more";
      k = n - last;
    }
    const Event& event = (*events_)[k];
    const std::string number = std::to_string(k + 1);
    all += "\n  " + std::string(width - number.size(), ' ') + number + "  " + asperity::text(event.step);
    if (event.time || !event.origin.empty())
      all += " (" + (event.time ? "at " + format_short(*event.time) + " s" : "") +
             (event.time && !event.origin.empty() ? ", " : "") + event.origin + ")";
  }
  return all;
}

std::string Protocol::digest() const {
  Digester digester;
  digester.add("protocol");
  for (const Event& event : *events_) {
    digester.add(kind(event.step));
    std::visit(Adder{digester}, event.step);
    if (event.time) digester.add("time").add(*event.time);
  }
  return digester.hex();
}

}  // namespace asperity
