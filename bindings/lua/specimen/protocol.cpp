// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/specimen/protocol.hpp"

#include "bindings/lua/metrology/stylus.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/run/table_values.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/specimen/contact.hpp"
#include "bindings/lua/specimen/state_table.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/recording/event_detection.hpp"
#include "engine/recording/press_log.hpp"
#include "engine/recording/protocol_chart.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/specimen/specimen_pair.hpp"

namespace asperity::lua {

namespace {

struct NumberedEvent {
  const Protocol* protocol = nullptr;
  std::size_t k = 0;
  const Protocol::Event& event() const { return protocol->events()[k]; }
  const Protocol::Step& step() const { return event().step; }
};

template <PressBy by>
std::optional<double> pressed_to(const NumberedEvent& e) {
  const auto* press = std::get_if<PressRequest>(&e.step());
  return press != nullptr && press->by == by ? std::optional<double>(press->value) : std::nullopt;
}
// Empty for other kinds. An optional member stays a plain optional.
template <class Kind, auto member>
auto part_of(const NumberedEvent& e) {
  const auto* step = std::get_if<Kind>(&e.step());
  return step != nullptr ? std::optional(step->*member) : std::nullopt;
}

// Fields of other kinds are nil.
const RecordType<NumberedEvent>& event_type() {
  using E = NumberedEvent;
  using P = Protocol;
  static const RecordType<E> type{
      "ProtocolEvent",
      "protocol event",
      "One event of a contact; fields that do not apply are nil.",
      {{"index", [](const E& e) { return e.k + 1; }, "its number, from 1"},
       {"total", [](const E& e) { return e.protocol->count(); }, "number of events of the protocol"},
       {"kind", [](const E& e) { return kind(e.step()); },
        "\"press\", \"release\", \"place\", \"rotate\" or \"shift\""},
       {"text", [](const E& e) { return text(e.step()); }, "the event in words"},
       {"time", [](const E& e) { return e.event().time; }, dimension::time,
        "as recorded; nothing waits for it"},
       {"pressure", pressed_to<PressBy::pressure>, dimension::pressure, "of a press by pressure"},
       {"load", pressed_to<PressBy::load>, dimension::force, "of a press by load"},
       {"approach", pressed_to<PressBy::approach>, dimension::length, "of a press by approach"},
       {"indentation", pressed_to<PressBy::indentation>, "of a press by indentation"},
       {"flatten", pressed_to<PressBy::flatten>, "of a press by flattening"},
       {"dwell", part_of<PressRequest, &PressRequest::dwell>, dimension::time,
        "of a press: how long the load stays"},
       {"seed", part_of<P::Place, &P::Place::seed>, "of a placement"},
       {"angle", part_of<P::Rotate, &P::Rotate::angle>, dimension::angle, "of a turn, counter-clockwise"},
       {"x", part_of<P::Shift, &P::Shift::x>, dimension::length, "of a shift"},
       {"y", part_of<P::Shift, &P::Shift::y>, dimension::length, "of a shift"}}};
  return type;
}

Values events(Call& call) {
  const Protocol& protocol = call.self<Protocol>();
  List list;
  for (std::size_t k = 0; k < protocol.count(); ++k) list.items.emplace_back(event_of(protocol, k));
  return {std::move(list)};
}

Values on(Call& call) {
  call.object<SpecimenPair>(1, "contact");  // throws for another type
  auto pair =
      std::static_pointer_cast<SpecimenPair>(call.argument(1).as_object(class_of<SpecimenPair>())->pointer);
  auto run = std::make_shared<ProtocolRun>(call.self<Protocol>(), std::move(pair));
  return {Iterator{
      [run](Call& turn) -> std::optional<Values> {
        if (run->finished()) return std::nullopt;
        if (run->pair().closed())
          refuse_state("the contact of the protocol was closed inside its loop", "close it after the loop");
        const std::size_t k = run->next();
        const std::optional<asperity::State> state = run->step(turn.session().monitor());
        Values values{event_of(run->protocol(), k), state ? object(*state) : Value()};
        if (const auto* press = std::get_if<PressRequest>(&run->protocol().events()[k].step))
          record_press(turn.session(), std::shared_ptr<SpecimenPair>(run, &run->pair()), *press, *state);
        return values;
      },
      call.function_name()}};
}

struct LoadedSpan : RecordedSpan {
  Dimension unit{};
  bool loaded() const { return kind == Kind::hold || kind == Kind::peak; }
};
constexpr const char* in_its_unit = ", in Pa, or in N where loads were recorded";

const RecordType<LoadedSpan>& span_type() {
  using S = LoadedSpan;
  using Entry = RecordField<S>;
  using Kind = RecordedSpan::Kind;
  static constexpr auto unit = [](const S& s) { return s.unit; };
  static constexpr auto given = [](bool there, double value) {
    return there ? std::optional(value) : std::nullopt;
  };
  static const RecordType<S> type{
      "RecordedSpan",
      "stretch of a recording",
      "A stretch of a recording with a single event; fields that do not apply are nil.",
      {{"kind", [](const S& s) { return name(s.kind); },
        "\"rest\", \"rise\", \"hold\", \"peak\", \"fall\", \"release\" or \"turn\""},
       {"begin", &S::begin, dimension::time, "time of its first sample"},
       {"end", &S::end, dimension::time, "time of its last sample"},
       Entry(
           "load", [](const S& s) { return given(s.kind != Kind::turn, s.load); },
           std::string("above the zero: of a hold or peak, or reached by a rise or fall") + in_its_unit)
           .in(unit),
       Entry(
           "load_error", [](const S& s) { return given(s.loaded(), s.load_error); },
           std::string("standard error of the load of a hold or peak, from the noise") + in_its_unit)
           .in(unit),
       {"dwell_error", [](const S& s) { return given(s.loaded(), s.dwell_error); }, dimension::time,
        "standard error of end - begin of a hold or peak"},
       {"angle", [](const S& s) { return given(s.kind == Kind::turn, s.angle); }, dimension::angle,
        "of a turn"},
       {"first_line", &S::first_line, "of the file"},
       {"last_line", &S::last_line, "of the file"}}};
  return type;
}

Dimension unit_of(const Detection& found) {
  return found.by == PressBy::load ? dimension::force : dimension::pressure;
}

const RecordType<Detection>& recording_type() {
  using D = Detection;
  const auto load = [](const char* name, double D::*member, const char* sentence) {
    return RecordField<D>(name, member, std::string(sentence) + in_its_unit).in(unit_of);
  };
  static const RecordType<D> type{
      "Recording",
      "recording",
      "Events found in a recording of the load, and the thresholds.",
      {{"name", &D::name, "of the file"},
       {"samples", &D::samples, "number of samples"},
       {"missing", &D::missing, "rows without a load"},
       {"interval", &D::interval, dimension::time, "between samples: the median"},
       load("noise", &D::noise, "standard deviation of a reading"),
       load("highest", &D::highest, "greatest load above the zero"),
       load("zero_low", &D::zero_low, "least reading without load"),
       load("zero_high", &D::zero_high, "greatest reading without load"),
       {"shortest_hold", &D::shortest_hold, dimension::time, "a shorter one is not taken for a hold"},
       load("least_load", &D::least_load, "a shortest hold of less may go unseen"),
       load("least_step", &D::least_step,
            "a change by less between two holds, one of them as short, may go unseen"),
       {"spans",
        [](const D& found) {
          std::vector<LoadedSpan> spans;
          for (const RecordedSpan& span : found.spans) spans.push_back({span, unit_of(found)});
          return spans;
        },
        span_type(), "the stretches of the recording, one after another"}}};
  return type;
}

Value recording(const Protocol& of) {
  const Detection* found = of.recording().get();
  return found != nullptr ? Value(recording_type()(*found)) : Value();
}

struct ChartKeys {
  std::string title;
};
const Block<ChartKeys> chart_block{{text("title", &ChartKeys::title, "above the chart")}};

Values chart_protocol(Call& call) {
  const std::string file = call.text(1, "path");
  picture_format(file);
  const LineChart lines = protocol_chart(call.self<Protocol>(), call.options(chart_block, 2).title);
  const std::string path = writable_path(call, file);
  for (const std::string& warning : draw(lines, path)) call.session().monitor().warn(warning);
  if (const auto& run = call.session().run)
    run->journal().write("chart",
                         Json::object({{"protocol", call.self<Protocol>().digest()}, {"file", file}}));
  return {path};
}

struct RepeatedKeys {
  std::int64_t repeats = 1;
};
const Block<RepeatedKeys> repeated_block{
    {integer("repeats", &RepeatedKeys::repeats, at_least(1), "number of repeats of the protocol")
         .required()}};
Values repeated(Call& call) {
  return {object(call.self<Protocol>().repeated(call.options(repeated_block).repeats))};
}
Values plus(Call& call) { return {object(call.self<Protocol>().plus(call.object<Protocol>(1, "next")))}; }

struct ApplyKeys {
  std::vector<std::string> columns;
  TraceKeys trace;
};

void read_trace(const Argument& value, const OptionInfo& info, ApplyKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a table such as { stylus=stylus, count=5, seed=1 }", problems);
  value.each([&](const Argument& key, const Argument& given) {
    static const std::vector<std::string> names = {"stylus", "count", "seed", "section"};
    const std::string name(key.is_text() ? key.text() : "");
    const Object* stylus = name == "stylus" ? given.as_object(class_of<Stylus>()) : nullptr;
    const std::int64_t whole = given.is_number() ? given.integer().value_or(-1) : -1;
    if (given.is_unknown()) return;
    if (name == "section") {
      OptionInfo length = info;
      length.name = "trace.section", length.dimension = dimension::length;
      keys.trace.section = detail::read_quantity(given, length, above(0), problems);
      return;
    }
    if (stylus != nullptr)
      keys.trace.stylus = std::static_pointer_cast<Stylus>(stylus->pointer);
    else if (name == "count" && whole >= 1 && whole <= 1'000'000)
      keys.trace.count = static_cast<int>(whole);
    else if (name == "seed" && whole >= 0)
      keys.trace.seed = static_cast<std::uint64_t>(whole);
    else
      problems.push_back(quoted(info.name + "." + name) + " is " + given.describe() +
                         did_you_mean(name, names) + "; give stylus=stylus, count=5, seed=1");
  });
}

const Block<ApplyKeys>& apply_block() {
  using K = ApplyKeys;
  static const Block<K> block{
      {custom<K>(
           "columns", "string[]",
           "`event` (its number), `kind`, `press` (its number), quantities of a State, roughness of the "
           "bodies (\"lower.Ra\") or parameters of the traces (\"trace.Ra\"), with a unit or without",
           [](const Argument& value, const OptionInfo& info, K& keys, Problems& problems) {
             read_texts(value, info, keys.columns, problems);
           })
           .required(),
       custom<K>("trace", "table",
                 "traces on the lower body after each event: { stylus=, count=1, seed=1, section= }; a "
                 "section gives the parameters of ISO 21920-2, such as trace.Rz",
                 read_trace)},
      [](K& keys, Problems& problems) { StateTable::find_mistakes(keys.columns, keys.trace, problems); }};
  return block;
}

Values apply(Call& call) {
  call.object<SpecimenPair>(1, "contact");  // throws for another type
  auto pair =
      std::static_pointer_cast<SpecimenPair>(call.argument(1).as_object(class_of<SpecimenPair>())->pointer);
  const ApplyKeys keys = call.options(apply_block(), 2);
  StateTable table(keys.columns, keys.trace);
  ProtocolRun run(call.self<Protocol>(), pair);
  std::int64_t presses = 0;
  while (!run.finished()) {
    const std::size_t k = run.next();
    const std::optional<asperity::State> state = run.step(call.session().monitor());
    if (const auto* press = std::get_if<PressRequest>(&run.protocol().events()[k].step)) {
      ++presses;
      record_press(call.session(), pair, *press, *state);
    }
    table.add(call, {state ? object(*state) : Value(), event_of(run.protocol(), k), presses, pair});
  }
  return {object(std::move(table).finish())};
}

Function apply_method() {
  return {.name = "apply",
          .body = apply,
          .sentence =
              "Does all events to a contact and returns a table with a row for each event. Quantities of "
              "a State are empty except after a press.",
          .parameters = {{"contact", "Contact", "its bodies change"}},
          .options = &apply_block(),
          .returns = "Table",
          .example =
              "print(protocol:apply(c, { columns={ \"press\", \"area_fraction [%]\", \"lower.Ra [um]\" } }))",
          .heavy = true};
}

}  // namespace

Record event_of(const Protocol& protocol, std::size_t k) { return event_type()({&protocol, k}); }

// data table
Class make_class(For<Protocol>) {
  Class c{"Protocol", "a protocol",
          "The loading of a contact, event by event; an immutable value for any number of contacts. #p is "
          "the number of events."};
  c.length = from_value([](const Protocol& of) { return static_cast<std::int64_t>(of.count()); });
  c.describe = from_value([](const Protocol& protocol) -> std::string {
    return protocol.text() + (protocol.recording() ? "\n" + protocol.recording()->text() : "");
  });
  c.native_bytes = from_value([](const Protocol& of) { return of.count() * sizeof(Protocol::Event); });
  c.equal = have_one_digest<Protocol>;
  c.digest = text_of<&Protocol::digest>;
  c.fields = {getter<&Protocol::count>("count", "integer", "number of events"),
              getter<&Protocol::presses>("presses", "integer", "number of presses among them"),
              getter<recording>("recording", "Recording?",
                                "the events and thresholds of the recording; nil without a recording"),
              getter<&Protocol::digest>("digest", "string", "equal protocols have equal digests")};
  c.methods = {
      {.name = "on",
       .body = on,
       .sentence =
           "Does one event after another to a contact, one a turn of a for loop, which is given the event "
           "and the state of a press, nil after any other. A turn or a load that the contact cannot take is "
           "an error before the first event. An event that fails raises an error, and leaves the contact as "
           "it was before that event; a loop that is broken off leaves the rest undone.",
       .parameters = {{"contact", "Contact", "what it is done to"}},
       .returns = "iterator<ProtocolEvent and State?>",
       .example = "for event, st in protocol:on(c) do if st then print(event.text, st.area_fraction) end end",
       .heavy = true},
      apply_method(),
      {.name = "events",
       .body = events,
       .sentence = "All events as a list, as p:on gives them.",
       .returns = "ProtocolEvent[]",
       .example = "for _, event in ipairs(protocol:events()) do print(event.index, event.text) end"},
      {.name = "repeated",
       .body = repeated,
       .sentence = "The same events several times over, without recorded times.",
       .options = &repeated_block,
       .returns = "Protocol",
       .example = "local eight = lab.protocol{ { press={ pressure=\"152.78 MPa\" } }, { release=true }, { "
                  "rotate=\"90 deg\" } }:repeated{ repeats=8 }"},
      {.name = "plus",
       .body = plus,
       .sentence = "One protocol after another, without recorded times.",
       .parameters = {{"next", "Protocol", "the next event"}},
       .returns = "Protocol",
       .example = "local both = protocol:plus(protocol:repeated{ repeats=2 })"},
      {.name = "chart",
       .body = chart_protocol,
       .sentence = "Draws load over time with rises, holds, peaks, releases and turns marked and labelled. A "
                   "protocol detected in a recording is drawn over the recorded samples. Without recorded "
                   "times the axis is the sum of dwells, or the event. Returns the file.",
       .parameters = {{"path", "string", "an .svg, .png or .pdf under the run directory"}},
       .options = optional(chart_block),
       .returns = "string",
       .example = "protocol:chart \"protocol.svg\"",
       .heavy = true},
      {.name = "write",
       .body = [](Call& call) -> Values {
         const std::string log = press_log_text(call.self<Protocol>());
         const std::string path = writable_path(call, call.text(1, "path"));
         write_atomically(path, log);
         return {path};
       },
       .sentence = "Writes a press log, which lab.protocol.read reads back as this protocol: rows of turn, "
                   "pressure or load, and dwell. Shifts, and presses to anything else, are an error.",
       .parameters = {{"path", "string", "under the run directory"}},
       .returns = "string",
       .example = "protocol:write \"press_log.csv\"",
       .heavy = true},
  };
  c.results = {&recording_type(), &span_type(), &event_type()};
  return c;
}

Module protocol_module() {
  Module m{"lab.protocol", "Loading protocols: the events of a contact, from tables or press logs."};
  m.functions = {protocol_read_function()};
  m.call =
      Function{.name = "protocol",
               .body = [](Call& call) -> Values {
                 const auto protocol = read_protocol(call.argument(1), call.function_name());
                 return {protocol ? object(*protocol) : Value(Object{&class_of<Protocol>(), nullptr, false})};
               },
               .sentence = "A protocol from a list of events: tables with one key each.",
               .options = &protocol_keys(),
               .returns = "Protocol",
               .example =
                   "local protocol = lab.protocol{ { press={ pressure=\"152.78 MPa\", dwell=\"10 min\" } }, "
                   "{ release=true }, { place={ seed=1 } } }"};
  return m;
}

}  // namespace asperity::lua
