// SPDX-License-Identifier: GPL-3.0-or-later
// A loading protocol: the events of a specimen pair in order. An event is a press, a release, a fresh
// placement, a turn or a shift of the upper body; it may have the time of a log. A protocol is an immutable
// value, cheap to copy, and knows no contact: protocol_run.hpp carries it out, and SpecimenPair::check_ahead
// checks its turns and loads.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/contact/press_request.hpp"

namespace asperity {

struct Detection;

class Protocol {
 public:
  struct Release {};
  struct Place {
    std::uint64_t seed = 1;
  };
  struct Rotate {
    double angle = 0;  // rad, counter-clockwise seen from above the lower body; from where it lies
  };
  struct Shift {
    double x = 0, y = 0;  // m
  };
  using Step = std::variant<PressRequest, Release, Place, Rotate, Shift>;

  struct Event {
    Step step;
    std::optional<double> time{};  // s, as recorded; nothing waits for it
    std::string origin{};          // where it was read: "press_log.csv line 7"; no part of the value
  };

  // Throws Error{bad_value} when there is no event, or for one whose numbers no contact could take,
  // naming the event by its number from 1.
  explicit Protocol(std::vector<Event> events);

  std::span<const Event> events() const { return *events_; }
  std::size_t count() const { return events_->size(); }
  std::size_t presses() const;

  // The events of this protocol and then those of another, and this protocol several times over. Recorded
  // times are dropped, because they would run backwards. Throws Error{bad_value} for less than one time or
  // more than ten million events.
  Protocol plus(const Protocol& next) const;
  Protocol repeated(std::int64_t times) const;

  // The same events, and beside them what was found in the recording that they come from; it is no part of
  // the value and of its digest.
  Protocol detected_in(std::shared_ptr<const Detection> recording) const;
  // Null where the events are not exactly those found in a recording.
  const std::shared_ptr<const Detection>& recording() const { return recording_; }

  // A line with the count and one an event, with the time and the lines that it was read from; the middle
  // of a long one is left out.
  std::string text() const;
  // Of steps and times.
  std::string digest() const;

 private:
  std::shared_ptr<const std::vector<Event>> events_;
  std::shared_ptr<const Detection> recording_;
};

// The script key: "press", "release", "place", "rotate", "shift".
std::string_view kind(const Protocol::Step& step);
// "press 152.78 MPa for 10 min", "rotate 90 deg".
std::string text(const Protocol::Step& step);

}  // namespace asperity
