// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/protocol_chart.hpp"

#include <algorithm>

#include "engine/core/require.hpp"
#include "engine/recording/event_detection.hpp"

namespace asperity {

namespace {

using SpanKind = RecordedSpan::Kind;

struct Played {
  PressBy by = PressBy::pressure;
  std::string time_label = "time";
  bool in_seconds = true;
  std::vector<RecordedSpan> spans;
};

std::string minutes(double seconds) {
  return seconds >= 120 ? format_short(seconds / 60, 3) + " min"
                        : format_quantity(seconds, dimension::time, 3);
}

// A protocol without a recording.
class Clock {
 public:
  explicit Clock(const Protocol& protocol) : events_(protocol.events()) {
    std::optional<PressBy> by;
    timed_ = dwelt_ = true;
    double dwells = 0;
    for (const Protocol::Event& event : events_) {
      timed_ = timed_ && event.time.has_value();
      const auto* press = std::get_if<PressRequest>(&event.step);
      if (press == nullptr) continue;
      const bool plain = press->by == PressBy::load || press->by == PressBy::pressure;
      if (!plain || (by && *by != press->by))
        refuse("a chart has one axis of loads, and this protocol presses by " + std::string(name(press->by)) +
                   (by && *by != press->by ? " and by " + std::string(name(*by)) : ""),
               "give all presses by `pressure`, or all by `load`");
      by = press->by;
      dwelt_ = dwelt_ && press->dwell.has_value();
      dwells += press->dwell.value_or(0);
    }
    played_.by = by.value_or(PressBy::pressure);
    dwelt_ = dwelt_ && dwells > 0;
    if (!timed_) played_.time_label = dwelt_ ? "time under load, as the dwells add up" : "event";
    played_.in_seconds = timed_ || dwelt_;
    pause_ = timed_ ? 0 : dwelt_ ? 0.04 * dwells : 0.2;
    now_ = timed_ ? *events_.front().time : played_.in_seconds ? 0 : 1;
  }

  Played play() {
    for (std::size_t k = 0; k < events_.size(); ++k) {
      const Protocol::Event& event = events_[k];
      if (timed_) now_ = std::max(now_, *event.time);
      if (!played_.in_seconds) now_ = static_cast<double>(k) + 1;
      if (const auto* press = std::get_if<PressRequest>(&event.step)) {
        span(press->value >= load_ ? SpanKind::rise : SpanKind::fall, last_, now_, press->value);
        double stays = press->dwell.value_or(0);
        if (!played_.in_seconds) stays = 0.8;
        if (timed_ && k + 1 < events_.size())
          stays = std::min(stays, std::max(0.0, *events_[k + 1].time - now_));
        span(SpanKind::hold, now_, now_ + stays, press->value);
        if (press->dwell) played_.spans.back().dwell_error = *press->dwell;
        load_ = press->value;
        now_ += stays;
        last_ = now_;
      } else if (std::holds_alternative<Protocol::Release>(event.step)) {
        if (load_ > 0) span(SpanKind::release, now_, now_, 0);
        load_ = 0;
        last_ = now_;
      } else {
        if (load_ > 0) span(SpanKind::release, last_, now_, 0);
        load_ = 0;
        span(SpanKind::turn, now_, now_, 0);
        if (const auto* turn = std::get_if<Protocol::Rotate>(&event.step))
          played_.spans.back().angle = turn->angle;
        last_ = now_;
      }
      if (!timed_ && played_.in_seconds) now_ += pause_;
    }
    return std::move(played_);
  }

 private:
  void span(SpanKind kind, double begin, double end, double load) {
    RecordedSpan span{kind, std::min(begin, end), end};
    span.load = load;
    played_.spans.push_back(span);
  }

  std::span<const Protocol::Event> events_;
  bool timed_ = true, dwelt_ = true;
  double now_ = 0, last_ = 0, load_ = 0, pause_ = 0;
  Played played_;
};

ChartSeries line_alone(std::string name) {
  ChartSeries series;
  series.name = std::move(name);
  series.points = false;
  return series;
}

// Seconds, minutes or hours; no "ks".
double time_unit(const std::vector<RecordedSpan>& spans, const Detection* found) {
  double end = 0;
  for (const RecordedSpan& span : spans) end = std::max(end, span.end);
  if (found != nullptr && !found->time.empty()) end = std::max(end, found->time.back());
  return end > 4 * 3600 ? 3600 : end > 600 ? 60 : 1;
}

Range load_range(double highest, const Detection* found) {
  const double room = highest > 0 ? highest : 1;
  double low = 0, high = highest;
  if (found != nullptr)
    for (const double value : found->load) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  return {low - 0.1 * room, high + 0.12 * room};
}

}  // namespace

LineChart protocol_chart(const Protocol& protocol, const std::string& title) {
  const Detection* found = protocol.recording().get();
  const Played played =
      found != nullptr ? Played{found->by, "time", true, found->spans} : Clock(protocol).play();
  const double clock = played.in_seconds ? time_unit(played.spans, found) : 1;
  LineChart chart;
  chart.title = title;
  chart.x.label = played.time_label;
  if (played.in_seconds) chart.x.label += clock == 3600 ? " (h)" : clock == 60 ? " (min)" : " (s)";
  chart.y.label = played.by == PressBy::load ? "load" : "pressure";
  chart.y.unit = played.by == PressBy::load ? "N" : "Pa";
  chart.width = 1100;

  ChartSeries recorded = line_alone("recorded"),
              events = line_alone(found != nullptr ? "detected" : "protocol");
  ChartSeries rise = marks_alone("rise", PointShape::triangle), peak = marks_alone("peak", PointShape::ring),
              release = marks_alone("release", PointShape::cross),
              turn = marks_alone("turn", PointShape::diamond);
  const auto add = [clock](ChartSeries& series, double time, double load) {
    series.x.push_back(time / clock);
    series.y.push_back(load);
  };
  if (found != nullptr)
    for (std::size_t k = 0; k < found->time.size(); ++k) add(recorded, found->time[k], found->load[k]);

  const Dimension unit = played.by == PressBy::load ? dimension::force : dimension::pressure;
  double load = 0, highest = 0;
  for (const RecordedSpan& span : played.spans) highest = std::max(highest, span.load);
  for (const RecordedSpan& span : played.spans) {
    const double middle = 0.5 * (span.begin + span.end);
    if (span.kind == SpanKind::turn) {
      add(turn, span.begin, 0);
      const std::string angle = span.angle != 0 ? format_quantity(span.angle, dimension::angle, 4) : "placed";
      chart.labels.push_back({span.begin / clock, 0, angle, true});
    } else if (span.kind == SpanKind::hold) {
      add(events, span.begin, span.load);
      add(events, span.end, span.load);
      const double dwell = found != nullptr ? span.end - span.begin : span.dwell_error;
      const std::string text = "hold " + format_quantity(span.load, unit, 4);
      chart.labels.push_back({middle / clock, span.load, dwell > 0 ? text + ", " + minutes(dwell) : text});
      load = span.load;
    } else if (span.kind == SpanKind::peak) {
      add(events, middle, span.load);
      add(peak, middle, span.load);
      load = span.load;
    } else {
      if (span.kind != SpanKind::rest) add(events, span.begin, load);
      if (span.kind == SpanKind::rise) add(rise, span.begin, load);
      if (span.kind == SpanKind::release) add(release, span.begin, load);
      load = span.kind == SpanKind::release || span.kind == SpanKind::rest ? 0 : span.load;
      add(events, span.end, load);
    }
  }
  constexpr std::size_t most = 24;
  if (chart.labels.size() > most) chart.labels.clear();
  chart.y.range = load_range(highest, found);
  for (ChartSeries* series : {&recorded, &events, &rise, &peak, &release, &turn})
    if (!series->x.empty()) chart.series.push_back(std::move(*series));
  return chart;
}

}  // namespace asperity
