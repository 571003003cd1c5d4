// SPDX-License-Identifier: GPL-3.0-or-later
// A loading protocol: the events of a specimen pair. Immutable, cheap to copy. ProtocolRun
// (specimen_pair.hpp) carries it out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/contact/scene/press_request.hpp"

namespace asperity {

struct Detection;

class Protocol {
 public:
  struct Release {};
  struct Place {
    std::uint64_t seed = 1;
  };
  struct Rotate {
    double angle = 0;  // rad, relative, counter-clockwise from above
  };
  struct Shift {
    double x = 0, y = 0;  // m
  };
  using Step = std::variant<PressRequest, Release, Place, Rotate, Shift>;

  struct Event {
    Step step;
    std::optional<double> time{};  // s, stored only
    std::string origin{};          // not part of the value: "press_log.csv line 7"
  };

  // Throws Error{bad_value} without events and for impossible numbers, naming the event from 1.
  explicit Protocol(std::vector<Event> events);

  std::span<const Event> events() const { return *events_; }
  std::size_t count() const { return events_->size(); }
  std::size_t presses() const;

  // Both drop recorded times and throw Error{bad_value} for less than one time or over ten million events.
  Protocol plus(const Protocol& next) const;
  Protocol repeated(std::int64_t times) const;

  // `recording` is not part of value and digest.
  Protocol detected_in(std::shared_ptr<const Detection> recording) const;
  // Null unless all events are recorded.
  const std::shared_ptr<const Detection>& recording() const { return recording_; }

  // Abbreviated in the middle.
  std::string text() const;
  std::string digest() const;

 private:
  std::shared_ptr<const std::vector<Event>> events_;
  std::shared_ptr<const Detection> recording_;
};

// "press", "release", "place", "rotate", "shift".
std::string_view kind(const Protocol::Step& step);
// "press 152.78 MPa for 10 min", "rotate 90 deg".
std::string text(const Protocol::Step& step);

}  // namespace asperity
