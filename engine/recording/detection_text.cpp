// SPDX-License-Identifier: GPL-3.0-or-later
// What detect_events found, in words.
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"
#include "engine/recording/event_detection.hpp"

namespace asperity {

std::string_view name(RecordedSpan::Kind kind) {
  switch (kind) {
    case RecordedSpan::Kind::rest:
      return "rest";
    case RecordedSpan::Kind::rise:
      return "rise";
    case RecordedSpan::Kind::hold:
      return "hold";
    case RecordedSpan::Kind::peak:
      return "peak";
    case RecordedSpan::Kind::fall:
      return "fall";
    case RecordedSpan::Kind::release:
      return "release";
    case RecordedSpan::Kind::turn:
      break;
  }
  return "turn";
}

std::string Detection::text() const {
  const Dimension unit = by == PressBy::load ? dimension::force : dimension::pressure;
  const auto quantity = [unit](double value) { return format_quantity(value, unit, 4); };
  std::string all = "recording " + name + ": " + std::to_string(samples) + " samples, every " +
                    format_quantity(interval, dimension::time, 4) + " or so";
  if (missing > 0) all += ", " + std::to_string(missing) + " more without a load";
  if (absent > 0) all += ", some " + std::to_string(absent) + " more absent";
  all += "\n  noise          " + quantity(noise) + " a sample";
  if (highest > 0) all += ", " + format_short(100 * noise / highest, 2) + " % of the highest load";
  all += "\n  without load   " +
         (!rested ? std::string("never")
                  : quantity(zero_low) + (zero_low < zero_high ? " to " + quantity(zero_high) : "") +
                        " is read, and taken off");
  all += "\n  seen           holds of " + format_quantity(shortest_hold, dimension::time, 4) +
         " and more above " + quantity(least_load);
  all += "\n  one hold       are loads next to each other within " + quantity(least_step) + " or so";
  all += "\n  cut            where it saves " + format_short(evidence, 3) + " squares of the noise";
  std::size_t holds = 0, peaks = 0, releases = 0, turns = 0;
  for (const RecordedSpan& span : spans) {
    holds += span.kind == RecordedSpan::Kind::hold ? 1 : 0;
    peaks += span.kind == RecordedSpan::Kind::peak ? 1 : 0;
    releases += span.kind == RecordedSpan::Kind::release ? 1 : 0;
    turns += span.kind == RecordedSpan::Kind::turn ? 1 : 0;
  }
  const auto count = [](std::size_t n, const char* what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
  };
  return all + "\n  found          " + count(holds, "hold") + ", " + count(peaks, "peak") + ", " +
         count(releases, "release") + ", " + count(turns, "turn");
}

}  // namespace asperity
