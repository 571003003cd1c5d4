// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/specimen/protocol.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/require.hpp"
#include "engine/recording/event_detection.hpp"
#include "engine/recording/press_log.hpp"
#include "engine/recording/press_recording.hpp"

namespace asperity::lua {

namespace {

enum class ReadAs { as_it_looks, rows, detect };

struct ReadProtocolKeys : TableForm {
  ReadAs events = ReadAs::as_it_looks;
  std::optional<Quantity> noise, zero;
  std::optional<double> zero_drift, same_load, shortest_hold, evidence, least_overshoot, least_turn,
      turn_step;
  std::optional<DetectionOptions::Overshoot> overshoot;
  std::optional<double> area;
  EqualTimes equal_times = EqualTimes::refuse;

  bool detects() const {
    return noise || zero || zero_drift || same_load || shortest_hold || evidence || least_overshoot ||
           least_turn || turn_step || overshoot;
  }
};

// A load or a pressure, like the recording.
Option<ReadProtocolKeys> reading(StaticText name, std::optional<Quantity> ReadProtocolKeys::*member,
                                 bool signed_value, StaticText sentence) {
  return custom<ReadProtocolKeys>(
             name, "a load|a pressure", sentence,
             [member, signed_value](const Argument& value, const OptionInfo& info, ReadProtocolKeys& keys,
                                    Problems& problems) {
               const auto quantity = detail::read_any_quantity(
                   value, info.name, "a load such as \"2 N\" or a pressure", problems);
               if (!quantity) return;
               const Dimension d = quantity->dimension;
               if (d != dimension::number && d != dimension::force && d != dimension::pressure)
                 problems.push_back(quoted(info.name) + " is " + asperity::describe(d) +
                                    "; give a load such as \"2 N\" or a pressure such as \"0.1 MPa\"");
               else if (!std::isfinite(quantity->value) || (!signed_value && quantity->value < 0))
                 problems.push_back(quoted(info.name) + " is " + format_short(quantity->value) +
                                    "; give zero or more");
               else
                 keys.*member = quantity;
             })
      .shown_by([member](const ReadProtocolKeys& keys) {
        return keys.*member ? format_exact((keys.*member)->value) : std::string();
      });
}

const Block<ReadProtocolKeys> read_protocol_block = [] {
  std::vector<Option<ReadProtocolKeys>> keys{
      choice("events", &ReadProtocolKeys::events, {{"rows", ReadAs::rows}, {"detect", ReadAs::detect}},
             "\"rows\": each row is an event; \"detect\": they are found in a recording sampled all the time")
          .defaults_to("as the table looks: a hundred rows or more with times, and no dwell, place or "
                       "turn, are a recording"),
      quantity("area", &ReadProtocolKeys::area, dimension::area, above(0),
               "nominal area of the specimen that was pressed: its loads become mean pressures, as a tile "
               "of it carries them"),
      reading("noise", &ReadProtocolKeys::noise, false, "standard deviation of a reading")
          .defaults_to("measured"),
      reading("zero", &ReadProtocolKeys::zero, true, "reading of the sensor without load, throughout")
          .defaults_to("found in the rests, and followed"),
      number("zero_drift", &ReadProtocolKeys::zero_drift, inside(0, 0.5),
             "how far from the rest before a rest may lie, as a share of the highest load")
          .defaults_to("0.01"),
      number("same_load", &ReadProtocolKeys::same_load, inside(0, 0.5),
             "greatest drift of a hold, and distance from the hold before to be part of it, as a share of "
             "its load")
          .defaults_to("0.02"),
      quantity("shortest_hold", &ReadProtocolKeys::shortest_hold, dimension::time, above(0),
               "a shorter level stretch is no hold")
          .defaults_to("four usual steps of time"),
      number("evidence", &ReadProtocolKeys::evidence, above(0),
             "squares of the noise that a bend must save to be seen; fewer see more, and ghosts")
          .defaults_to("10 + 4 ln samples"),
      choice("overshoot", &ReadProtocolKeys::overshoot,
             {{"press", DetectionOptions::Overshoot::press}, {"ignore", DetectionOptions::Overshoot::ignore}},
             "a load above the holds on both sides: a separate press, because flattening depends on the "
             "highest load, or nothing")
          .defaults_to("\"press\""),
      number("least_overshoot", &ReadProtocolKeys::least_overshoot, inside(0, 1),
             "a smaller overshoot is ignored, as a share of the neighbouring load; also one within six "
             "times the noise")
          .defaults_to("0.01"),
      quantity("least_turn", &ReadProtocolKeys::least_turn, dimension::angle, above(0),
               "a turn by less is none")
          .defaults_to("\"0.5 deg\""),
      quantity("turn_step", &ReadProtocolKeys::turn_step, dimension::angle, above(0),
               "turns are whole multiples of this, and are rounded to them")
          .defaults_to("none: turns are as they were read"),
      choice("equal_times", &ReadProtocolKeys::equal_times,
             {{"error", EqualTimes::refuse}, {"spread", EqualTimes::spread}},
             "samples with equal times, as from a fast logger with a slow clock: an error, or spread "
             "evenly until the next time")};
  keys.insert(keys.end(), table_form_keys().begin(), table_form_keys().end());
  return Block<ReadProtocolKeys>(std::move(keys), [](ReadProtocolKeys& given, Problems& problems) {
    if (given.events == ReadAs::rows && given.detects())
      problems.push_back("with events=\"rows\" nothing is detected, so only `events` may be given");
  });
}();

DetectionOptions detection_options(const ReadProtocolKeys& keys, const PressRecording& recording) {
  DetectionOptions options;
  const Dimension wanted = recording.by == PressBy::load ? dimension::force : dimension::pressure;
  const auto value = [&](const char* key, const std::optional<Quantity>& given) -> std::optional<double> {
    if (!given) return {};
    if (given->dimension != wanted && given->dimension != dimension::number)
      refuse(quoted(key) + " is " + asperity::describe(given->dimension) + ", and \"" + recording.name +
                 "\" records " + asperity::describe(wanted),
             "give it in the unit of the recording");
    return given->value;
  };
  options.noise = value("noise", keys.noise);
  options.zero = value("zero", keys.zero);
  options.zero_drift = keys.zero_drift.value_or(options.zero_drift);
  options.same_load = keys.same_load.value_or(options.same_load);
  options.shortest_hold = keys.shortest_hold;
  options.evidence = keys.evidence;
  options.overshoot = keys.overshoot.value_or(options.overshoot);
  options.least_overshoot = keys.least_overshoot.value_or(options.least_overshoot);
  options.least_turn = keys.least_turn.value_or(options.least_turn);
  options.turn_step = keys.turn_step;
  return options;
}

// Loads on the whole specimen become mean pressures.
Protocol over_area(const Protocol& protocol, const std::optional<double>& area) {
  if (!area) return protocol;
  std::vector<Protocol::Event> events(protocol.events().begin(), protocol.events().end());
  for (Protocol::Event& event : events)
    if (auto* press = std::get_if<PressRequest>(&event.step);
        press != nullptr && press->by == PressBy::load) {
      press->by = PressBy::pressure;
      press->value /= *area;
    }
  return Protocol(std::move(events));
}

Values read_protocol(Call& call) {
  const std::string path = readable_path(call, call.text(1, "path"));
  const ReadProtocolKeys keys = call.options(read_protocol_block, 2);
  Monitor& monitor = call.session().monitor();
  const SourceFile file(path, monitor);
  note_input(call, path);
  const bool looks =
      keys.events == ReadAs::as_it_looks && !keys.detects() && looks_like_recording(file, keys);
  if (keys.events == ReadAs::rows || (keys.events == ReadAs::as_it_looks && !keys.detects() && !looks))
    return {object(over_area(read_press_log(file, monitor, keys), keys.area))};
  PressRecording recording = read_press_recording(file, monitor, keys, keys.equal_times);
  if (keys.area && recording.by == PressBy::load) {
    recording.by = PressBy::pressure;
    for (double& load : recording.load) load /= *keys.area;
  }
  if (looks)
    monitor.inform(file_name(path) +
                   " looks like a recording, so its events are detected; events=\"rows\" takes each of its "
                   "rows for one");
  return {object(detect_events(recording, detection_options(keys, recording), monitor))};
}

}  // namespace

Function protocol_read_function() {
  return {.name = "read",
          .body = read_protocol,
          .sentence =
              "A protocol from a press log. Its columns are named with units, such as time [s], pressure "
              "[MPa] or load [N], and read as lab.table.read reads any table, times that are dates too, "
              "from the first on; force, Kraft, Druck, Zeit and the like are understood; other columns are "
              "left out with a warning, those titled \"result ...\" without. With a row an event there may "
              "be rotation [deg], dwell [min], and place for a seed: a row turns the upper body by its "
              "rotation from the present angle, then presses for its dwell; no pressure takes the load "
              "off, and so does a turn under load. In a recording, load or pressure and the stage's angle "
              "[deg] sampled all the time, rises, holds, peaks, releases and turns are detected; print(p) "
              "lists them with the lines they came from and the thresholds, and uncertainty by noise is a "
              "warning or an error. Press times are those of the beginning of the hold.",
          .parameters = {{"path", "string", "the file"}},
          .options = optional(read_protocol_block),
          .returns = "Protocol",
          .example = "local protocol = lab.protocol.read \"press_log.csv\"",
          .heavy = true};
}

}  // namespace asperity::lua
