// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/specimen/protocol.hpp"

#include <cmath>

#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/specimen/protocol_events.hpp"
#include "bindings/lua/specimen/protocol_reading.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/core/text.hpp"
#include "engine/recording/event_detection.hpp"
#include "engine/recording/press_log.hpp"
#include "engine/recording/protocol_chart.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/specimen/protocol_run.hpp"

namespace asperity::lua {

namespace {

Values make_protocol(Call& call) {
  const auto protocol = read_protocol(call.argument(1), call.function_name());
  return {protocol ? object(*protocol) : Value(Object{&class_of<Protocol>(), nullptr, false})};
}

// --- events

std::optional<double> pressed_to(const Protocol::Step& step, PressBy by) {
  const auto* press = std::get_if<PressRequest>(&step);
  return press != nullptr && press->by == by ? std::optional<double>(press->value) : std::nullopt;
}

// Every event has every field, so that a script may ask for any; those that do not apply are nil.
Record event_record(const Protocol& protocol, std::size_t k) {
  const Protocol::Event& event = protocol.events()[k];
  const Protocol::Step& step = event.step;
  const auto* press = std::get_if<PressRequest>(&step);
  const auto* place = std::get_if<Protocol::Place>(&step);
  const auto* rotate = std::get_if<Protocol::Rotate>(&step);
  const auto* shift = std::get_if<Protocol::Shift>(&step);
  Record record;
  record.name = "protocol event";
  record.add("index", static_cast<std::int64_t>(k) + 1)
      .add("total", static_cast<std::int64_t>(protocol.count()))
      .add("kind", std::string(kind(step)))
      .add("text", text(step))
      .add("time", event.time, dimension::time)
      .add("pressure", pressed_to(step, PressBy::pressure), dimension::pressure)
      .add("load", pressed_to(step, PressBy::load), dimension::force)
      .add("approach", pressed_to(step, PressBy::approach), dimension::length)
      .add("indentation", pressed_to(step, PressBy::indentation))
      .add("flatten", pressed_to(step, PressBy::flatten))
      .add("dwell", press != nullptr ? Value(press->dwell) : Value(), dimension::time)
      .add("seed", place != nullptr ? Value(static_cast<std::int64_t>(place->seed)) : Value())
      .add("angle", rotate != nullptr ? Value(rotate->angle) : Value(), dimension::angle)
      .add("x", shift != nullptr ? Value(shift->x) : Value(), dimension::length)
      .add("y", shift != nullptr ? Value(shift->y) : Value(), dimension::length);
  return record;
}

Values events(Call& call) {
  const Protocol& protocol = call.self<Protocol>();
  List list;
  for (std::size_t k = 0; k < protocol.count(); ++k) list.items.emplace_back(event_record(protocol, k));
  return {std::move(list)};
}

Values on(Call& call) {
  call.object<SpecimenPair>(1, "contact");  // or an error that says what it is instead
  auto pair =
      std::static_pointer_cast<SpecimenPair>(call.argument(1).as_object(class_of<SpecimenPair>())->pointer);
  auto run = std::make_shared<ProtocolRun>(call.self<Protocol>(), std::move(pair));
  return {Iterator{
      [run](Call& turn) -> std::optional<Values> {
        if (run->finished()) return std::nullopt;
        if (run->pair().closed())
          throw Error(ErrorCode::bad_state, "the contact of the protocol was closed inside its loop",
                      "close it after the loop");
        const std::size_t k = run->next();
        const std::optional<asperity::State> state = run->step(turn.session().monitor());
        Values values{event_record(run->protocol(), k), state ? object(*state) : Value()};
        if (const auto* press = std::get_if<PressRequest>(&run->protocol().events()[k].step))
          record_press(turn.session(), std::shared_ptr<SpecimenPair>(run, &run->pair()), *press, *state);
        return values;
      },
      call.function_name()}};
}

// --- the recording

Record span_record(const RecordedSpan& span, Dimension unit) {
  using Kind = RecordedSpan::Kind;
  const bool loaded = span.kind == Kind::hold || span.kind == Kind::peak;
  const auto if_loaded = [loaded](double value) { return loaded ? Value(value) : Value(); };
  Record record;
  record.name = "stretch of a recording";
  record.add("kind", std::string(name(span.kind)))
      .add("begin", span.begin, dimension::time)
      .add("end", span.end, dimension::time)
      .add("load", span.kind == Kind::turn ? Value() : Value(span.load), unit)
      .add("load_error", if_loaded(span.load_error), unit)
      .add("dwell_error", if_loaded(span.dwell_error), dimension::time)
      .add("angle", span.kind == Kind::turn ? Value(span.angle) : Value(), dimension::angle)
      .add("first_line", static_cast<std::int64_t>(span.first_line))
      .add("last_line", static_cast<std::int64_t>(span.last_line));
  return record;
}

Values recording(Call& call) {
  const Detection* found = call.self<Protocol>().recording().get();
  if (found == nullptr) return {Value()};
  const Dimension unit = found->by == PressBy::load ? dimension::force : dimension::pressure;
  List spans;
  for (const RecordedSpan& span : found->spans) spans.items.emplace_back(span_record(span, unit));
  Record record;
  record.name = "recording";
  record.add("name", found->name)
      .add("samples", static_cast<std::int64_t>(found->samples))
      .add("missing", static_cast<std::int64_t>(found->missing))
      .add("interval", found->interval, dimension::time)
      .add("noise", found->noise, unit)
      .add("highest", found->highest, unit)
      .add("zero_low", found->zero_low, unit)
      .add("zero_high", found->zero_high, unit)
      .add("shortest_hold", found->shortest_hold, dimension::time)
      .add("least_load", found->least_load, unit)
      .add("least_step", found->least_step, unit)
      .add("spans", std::move(spans));
  return {std::move(record)};
}

struct ChartKeys {
  std::string title;
};
const Block<ChartKeys>& chart_block() {
  static const Block<ChartKeys> block{"chart", {text("title", &ChartKeys::title, "above the chart")}};
  return block;
}

Values chart_protocol(Call& call) {
  const std::string file = call.text(1, "path");
  picture_format(file);
  const LineChart lines = protocol_chart(call.self<Protocol>(), call.options(chart_block(), 2).title);
  const std::string path = writable_path(call, file);
  for (const std::string& warning : draw(lines, path)) call.session().monitor().warn(warning);
  if (const auto& run = call.session().run)
    run->journal().write("chart",
                         Json::object({{"protocol", call.self<Protocol>().digest()}, {"file", file}}));
  return {path};
}

// --- others from it

struct RepeatedKeys {
  std::int64_t times = 1;
};
const Block<RepeatedKeys>& repeated_block() {
  static const Block<RepeatedKeys> block{
      "repeated", {integer("times", &RepeatedKeys::times, at_least(1), "how often it is done").required()}};
  return block;
}
Values repeated(Call& call) {
  return {object(call.self<Protocol>().repeated(call.options(repeated_block()).times))};
}
Values plus(Call& call) { return {object(call.self<Protocol>().plus(call.object<Protocol>(1, "next")))}; }

Values write_protocol(Call& call) {
  const std::string log = press_log_text(call.self<Protocol>());
  const std::string path = writable_path(call, call.text(1, "path"));
  write_atomically(path, log);
  return {path};
}

std::string describe_protocol(const void* self) {
  const auto& protocol = *static_cast<const Protocol*>(self);
  return protocol.text() + (protocol.recording() ? "\n" + protocol.recording()->text() : "");
}
std::string digest_of_protocol(const void* self) { return static_cast<const Protocol*>(self)->digest(); }
bool equal_protocols(const void* a, const void* b) { return digest_of_protocol(a) == digest_of_protocol(b); }
std::int64_t length(const void* self) {
  return static_cast<std::int64_t>(static_cast<const Protocol*>(self)->count());
}
std::size_t bytes_of_protocol(const void* self) {
  return static_cast<const Protocol*>(self)->count() * sizeof(Protocol::Event);
}

}  // namespace

template <>
const Class& class_of<Protocol>() {
  static const Class type = [] {
    Class c;
    c.name = "Protocol";
    c.article_name = "a protocol";
    c.sentence =
        "What is done to a contact, event by event; an immutable value that any number of contacts may go "
        "through. #p is the number of its events.";
    c.length = length;
    c.describe = describe_protocol;
    c.native_bytes = bytes_of_protocol;
    c.equal = equal_protocols;
    c.digest = digest_of_protocol;
    c.fields = {
        {"count",
         "integer",
         "number of events",
         {},
         [](Call& call) -> Values { return {length(&call.self<Protocol>())}; }},
        {"presses",
         "integer",
         "number of presses among them",
         {},
         [](Call& call) -> Values { return {static_cast<std::int64_t>(call.self<Protocol>().presses())}; }},
        {"recording",
         "table?",
         "what was found in the recording that it was detected in, and by which thresholds: name, samples, "
         "missing, interval, noise, highest, zero_low, zero_high, shortest_hold, least_load and least_step "
         "(smaller ones may go unseen), and spans, the stretches of the recording with kind (rest, rise, "
         "hold, "
         "peak, fall, release, turn), begin, end, load, load_error, dwell_error, angle, first_line, "
         "last_line; "
         "nil if there is none",
         {},
         recording},
        {"digest", "string", "equal protocols have equal digests", {}, [](Call& call) -> Values {
           return {digest_of_protocol(&call.self<Protocol>())};
         }}};
    c.methods = {
        {.name = "on",
         .body = on,
         .sentence =
             "Does one event after another to a contact, one a turn of a for loop: an event (index, total, "
             "kind, text, and pressure, load, approach, indentation, flatten, dwell, seed, angle, x, y, time "
             "where they apply, else nil) and the state of a press, nil after any other. An event that fails "
             "raises an error, and leaves the contact as it was before that event; a loop that is broken off "
             "leaves the rest undone.",
         .parameters = {{"contact", "Contact", "what it is done to"}},
         .returns = "iterator<table and State?>",
         .example =
             "for event, st in protocol:on(c) do if st then print(event.text, st.area_fraction) end end",
         .heavy = true},
        {.name = "events",
         .body = events,
         .sentence = "All events as a list, as p:on gives them.",
         .returns = "table[]",
         .example = "for _, event in ipairs(protocol:events()) do print(event.index, event.text) end"},
        {.name = "repeated",
         .body = repeated,
         .sentence = "The same events several times over, without recorded times.",
         .options = &repeated_block(),
         .returns = "Protocol",
         .example = "local eight = lab.protocol{ { press={ pressure=\"152.78 MPa\" } }, { release=true }, "
                    "{ rotate=\"90 deg\" } }:repeated{ times=8 }"},
        {.name = "plus",
         .body = plus,
         .sentence = "One protocol after another, without recorded times.",
         .parameters = {{"next", "Protocol", "what is done after this one"}},
         .returns = "Protocol",
         .example = "local both = protocol:plus(protocol:repeated{ times=2 })"},
        {.name = "chart",
         .body = chart_protocol,
         .sentence =
             "Draws load over time with rises, holds, peaks, releases and turns marked and labelled, over "
             "what was recorded if it was detected in a recording; without recorded times over the time "
             "its dwells add up to, or event by event. Returns the file.",
         .parameters = {{"path", "string", "an .svg or .png under the run directory"}},
         .options = &chart_block(),
         .options_optional = true,
         .returns = "string",
         .example = "protocol:chart \"protocol.svg\"",
         .heavy = true},
        {.name = "write",
         .body = write_protocol,
         .sentence = "Writes a press log, which lab.protocol.read reads back as this protocol: rows of turn, "
                     "pressure "
                     "or load, and dwell. Shifts, and presses to anything else, are an error.",
         .parameters = {{"path", "string", "under the run directory"}},
         .returns = "string",
         .example = "protocol:write \"press_log.csv\"",
         .heavy = true},
    };
    return c;
  }();
  return type;
}

const Module& protocol_module() {
  static const Module module = [] {
    Module m;
    m.path = "lab.protocol";
    m.sentence = "Loading protocols: what is done to a contact, event by event, from tables or press logs.";
    m.functions = {protocol_read_function()};
    m.call = Function{
        .name = "protocol",
        .body = make_protocol,
        .sentence = "A protocol from a list of events: tables with one key each.",
        .options = &protocol_keys(),
        .returns = "Protocol",
        .example =
            "local protocol = lab.protocol{ { press={ pressure=\"152.78 MPa\", dwell=\"10 min\" } }, "
            "{ release=true }, { place={ seed=1 } } }"};
    return m;
  }();
  return module;
}

}  // namespace asperity::lua
