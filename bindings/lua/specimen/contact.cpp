// SPDX-License-Identifier: GPL-3.0-or-later
// The class of contacts: two specimens to press, turn and measure.
#include "bindings/lua/specimen/contact.hpp"

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/placeholder.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/ledger.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/specimen/contact_scene.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/recording/bench_log.hpp"

namespace asperity::lua {

namespace {

Values make_contact(Call& call) { return {object(SpecimenPair(read_scene(call)))}; }

constexpr struct {
  const char* key;
  PressBy by;
  Dimension dimension;
  const char* sentence;
} press_keys[] = {
    {"pressure", PressBy::pressure, dimension::pressure, "mean pressure over the tile"},
    {"load", PressBy::load, dimension::force, "force on the whole tile"},
    {"approach", PressBy::approach, dimension::length, "from first touch"},
    {"indentation", PressBy::indentation, dimension::number,
     "approach over the peak-to-valley of the combined heights"},
    {"flatten", PressBy::flatten, dimension::number, "share of the peak-to-valley pressed away"},
};

}  // namespace

const Block<PressKeys>& press_block() {
  static const Block<PressKeys> block = [] {
    std::vector<Option<PressKeys>> options;
    for (const auto& entry : press_keys) {
      const NumberRange range = entry.by == PressBy::flatten ? between(0, 1) : any();
      auto option = custom<PressKeys>(
          entry.key, entry.dimension == dimension::number ? "number" : asperity::describe(entry.dimension),
          entry.sentence,
          [entry, range](const Argument& value, const OptionInfo& info, PressKeys& keys, Problems& problems) {
            ++keys.given;
            if (auto v = detail::read_quantity(value, info, range, problems))
              keys.request = {entry.by, *v, {}};
          });
      option.info.dimension = entry.dimension;
      option.info.range_text = range.text(entry.dimension);
      option.show = [entry](const PressKeys& keys) {
        return keys.given == 1 && keys.request.by == entry.by ? format_exact(keys.request.value)
                                                              : std::string();
      };
      options.push_back(std::move(option));
    }
    options.push_back(quantity("dwell", &PressKeys::dwell, dimension::time, at_least(0),
                               "how long the load stays; read by creep alone"));
    // The dimension of the controlled quantity, which precedes `preload` in the block.
    auto preload = custom<PressKeys>(
        "preload", "number|string|(number|string)[]",
        "of bodies that attract each other: pressed to this first, in the same quantity, and drawn back from "
        "there; or a list of values gone to in turn",
        [](const Argument& value, const OptionInfo& info, PressKeys& keys, Problems& problems) {
          OptionInfo same = info;
          for (const auto& entry : press_keys)
            if (entry.by == keys.request.by) same.dimension = entry.dimension;
          const auto read_one = [&](const Argument& one) {
            if (auto v = detail::read_quantity(one, same, any(), problems)) keys.preload.push_back(*v);
          };
          if (!value.is_table()) return read_one(value);
          for (std::int64_t k = 1; k <= value.length(); ++k) value.element(k, read_one);
        });
    preload.show = [](const PressKeys& keys) {
      std::vector<std::string> turns;
      for (const double turn : keys.preload) turns.push_back(format_exact(turn));
      return turns.size() > 1 ? "{" + joined(turns, ", ") + "}" : joined(turns, "");
    };
    options.push_back(std::move(preload));
    return Block<PressKeys>("press", std::move(options), [](PressKeys& keys, Problems& problems) {
      if (keys.given != 1)
        problems.push_back(
            "give exactly one of `pressure`, `load`, `approach`, `indentation` and `flatten`; " +
            std::to_string(keys.given) + " are given");
    });
  }();
  return block;
}

namespace {

PressRequest request_of(PressKeys keys) {
  keys.request.dwell = keys.dwell;
  keys.request.preload = std::move(keys.preload);
  return std::move(keys.request);
}

Values press(Call& call) {
  const PressRequest request = request_of(call.options(press_block()));
  return {object(call.self<SpecimenPair>().press(request, call.session().monitor()))};
}

struct SweepKeys {
  int given = 0;
  std::vector<PressRequest> requests;
};
const Block<SweepKeys>& sweep_block() {
  static const Block<SweepKeys> block = [] {
    std::vector<Option<SweepKeys>> options;
    for (const auto& entry : press_keys) {
      const NumberRange range = entry.by == PressBy::flatten ? between(0, 1) : any();
      auto option = custom<SweepKeys>(
          entry.key,
          (entry.dimension == dimension::number ? "number" : asperity::describe(entry.dimension)) + "[]",
          std::string("a list: ") + entry.sentence,
          [entry, range](const Argument& value, const OptionInfo& info, SweepKeys& keys, Problems& problems) {
            ++keys.given;
            const std::string wanted = "a list of values, e.g. { \"1 MPa\", \"2 MPa\" }";
            if (!value.is_table()) return detail::wrong_type(value, info, wanted, problems);
            if (value.length() == 0)
              return problems.push_back(quoted(info.name) + " is an empty list; give " + wanted);
            for (std::int64_t k = 1; k <= value.length(); ++k)
              value.element(k, [&](const Argument& part) {
                if (auto v = detail::read_quantity(part, info, range, problems))
                  keys.requests.push_back({entry.by, *v, {}});
              });
          });
      option.info.dimension = entry.dimension;
      options.push_back(std::move(option));
    }
    return Block<SweepKeys>("sweep", std::move(options), [](SweepKeys& keys, Problems& problems) {
      if (keys.given != 1)
        problems.push_back(
            "give exactly one list: `pressure`, `load`, `approach`, `indentation` or `flatten`; " +
            std::to_string(keys.given) + " are given");
    });
  }();
  return block;
}

// With adhesion, each state depends on the turning points of the earlier loads.
Values sweep(Call& call) {
  const SweepKeys keys = call.options(sweep_block());
  auto pair = call.shared_self<SpecimenPair>();
  return {Iterator{[pair, requests = keys.requests, k = std::size_t{0},
                    visited = std::vector<double>()](Call& step) mutable -> std::optional<Values> {
                     if (k >= requests.size()) return std::nullopt;
                     if (pair->closed())
                       throw Error(ErrorCode::bad_state,
                                   "the contact of the sweep was closed inside its loop",
                                   "close it after the loop");
                     PressRequest request = requests[k];
                     const bool by_load = request.by == PressBy::load || request.by == PressBy::pressure;
                     if (k == 0 && by_load && request.value < 0)
                       visited.push_back(0);  // a pull starts from zero load
                     if (pair->plan().attracts()) request.preload = turns_before(visited, request.value);
                     const asperity::State state = pair->press(request, step.session().monitor());
                     record_press(step.session(), pair, request, state);
                     visited.push_back(request.value);
                     ++k;  // last, because a press that runs out of memory is repeated
                     return Values{object(state)};
                   },
                   call.function_name()}};
}

}  // namespace

std::vector<PressRequest> requests_of(const Call& call, const Function& function) {
  const Argument table = call.argument(1);
  bool known = table.is_table() && !table.is_unknown();
  const auto look = [&](const Argument&, const Argument& value) {
    known = known && !holds_unknown(value, 1);
  };
  if (known) table.each(look);
  if (!known) return {};
  if (function.options == &press_block())
    return {request_of(press_block().read(table, call.function_name()))};
  if (function.options == &sweep_block()) return sweep_block().read(table, call.function_name()).requests;
  return {};
}

namespace {

Values release_load(Call& call) {
  call.self<SpecimenPair>().release();
  return {};
}

}  // namespace

void record_press(const Session& session, const std::shared_ptr<SpecimenPair>& pair,
                  const PressRequest& request, const asperity::State& state) {
  const Object self{&class_of<SpecimenPair>(), pair, false};
  record_call(session, "contact:press", &self,
              press_block().resolved({1, request, request.dwell, request.preload}),
              {object(asperity::State(state))});
}

const Block<PlaceKeys>& place_block() {
  static const Block<PlaceKeys> block{
      "place",
      {integer("seed", &PlaceKeys::seed, at_least(0), "of the turn and the shift that are drawn")
           .required()}};
  return block;
}

const Block<ShiftKeys>& shift_block() {
  static const Block<ShiftKeys> block{
      "shift",
      {quantity("x", &ShiftKeys::x, dimension::length, any(), "way along x, whole cells"),
       quantity("y", &ShiftKeys::y, dimension::length, any(), "way along y, whole cells")}};
  return block;
}

namespace {

void warn_of_flat(const Call& call, const char* done) {
  if (call.self<SpecimenPair>().upper_is_flat())
    call.session().monitor().warn(where(call.L) + call.function_name() + ": " + done +
                                  " a flat upper body changes nothing: every placement is the same contact");
}

Values place(Call& call) {
  call.self<SpecimenPair>().place(call.options(place_block()).seed);
  warn_of_flat(call, "placing");
  return {};
}

Values rotate(Call& call) {
  call.self<SpecimenPair>().rotate(call.quantity(1, "angle", dimension::angle));
  warn_of_flat(call, "turning");
  return {};
}

Values shift(Call& call) {
  const ShiftKeys keys = call.options(shift_block());
  call.self<SpecimenPair>().shift(keys.x, keys.y);
  return {};
}

Values log(Call& call) {
  const std::string text = bench_log_text(call.self<SpecimenPair>());
  const std::string path = writable_path(call, call.text(1, "path"));
  write_atomically(path, text);
  return {path};
}
Values copy(Call& call) { return {object(call.self<SpecimenPair>().copy())}; }
Values explain(Call& call) {
  const auto& pair = call.self<SpecimenPair>();
  if (!call.given(1)) return {object(Plan(pair.plan()))};
  return {object(pair.plan_of(request_of(call.options(press_block()))))};
}
Values lower(Call& call) { return {object(Surface(call.self<SpecimenPair>().lower()))}; }
Values upper(Call& call) { return {object(call.self<SpecimenPair>().upper())}; }

void close_states(void* self) { static_cast<SpecimenPair*>(self)->close(); }

Values close(Call& call) {
  if (Object* self = Argument(call.L, 1).as_object(class_of<SpecimenPair>())) {
    if (self->pointer != nullptr) close_states(self->pointer.get());
    self->pointer.reset();
    self->closed = true;
  }
  return {};
}

std::string describe_contact(const void* self) {
  const auto& pair = *static_cast<const SpecimenPair*>(self);
  return "contact: " + pair.plan().title + (pair.under_load() ? ", under load" : "");
}
std::string digest_of_contact(const void* self) {
  const auto& pair = *static_cast<const SpecimenPair*>(self);
  return pair.lower().digest() + "+" + (pair.upper_is_flat() ? std::string("flat") : pair.upper().digest());
}

}  // namespace

Function contact_function() {
  return {.name = "contact",
          .body = make_contact,
          .sentence = "Puts two bodies on the bench. Only the effects that are named are computed.",
          .options = &scene_keys(),
          .returns = "Contact",
          .example = "local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity=\"box\" } }",
          .look = look_at_scene};
}

// data table
template <>
const Class& class_of<SpecimenPair>() {
  static const Class type = [] {
    Class c;
    c.name = "Contact";
    c.article_name = "a contact";
    c.sentence =
        "Two specimens on the bench, how the upper lies on the lower, and what the scene computes: the one "
        "value that changes.";
    c.shareable = false;
    c.describe = describe_contact;
    c.digest = digest_of_contact;
    c.closing = close_states;
    c.methods = {
        {.name = "press",
         .body = press,
         .sentence = "The state under a load, given in one of five ways.",
         .options = &press_block(),
         .returns = "State",
         .example = "local st = c:press{ pressure=\"10 MPa\" }",
         .heavy = true},
        {.name = "sweep",
         .body = sweep,
         .sentence =
             "One state after another along a list of loads, up or down. Bodies that attract each other are "
             "followed on their branch: each state is drawn from the turns of the list before it.",
         .options = &sweep_block(),
         .returns = "iterator<State>",
         .example = "for st in c:sweep{ pressure={\"1 MPa\", \"10 MPa\"} } do print(st.area_fraction) end",
         .heavy = true},
        shear_method(),
        {.name = "release",
         .body = release_load,
         .sentence = "Takes the load off. The bodies recover elastically; what yielded stays.",
         .example = "c:release()"},
        {.name = "place",
         .body = place,
         .sentence =
             "Lifts the upper body and puts it down turned by a multiple of 90 degrees and, on a periodic "
             "tile, shifted by whole cells, as drawn from the seed; heights are never resampled.",
         .options = &place_block(),
         .example = "c:place{ seed=2 }"},
        {.name = "rotate",
         .body = rotate,
         .sentence = "Turns the upper body about the centre of the nodes, counter-clockwise seen from above; "
                     "turns add up. A periodic contact turns by multiples of 90 degrees only; on a free "
                     "boundary nothing presses where the turned body no longer covers the lower one.",
         .parameters = {{"angle", "an angle", "to turn by"}},
         .example = "c:rotate \"90 deg\""},
        {.name = "shift",
         .body = shift,
         .sentence = "Shifts the upper body by whole cells on a periodic tile.",
         .options = &shift_block(),
         .example = "c:shift{ x=\"10 um\" }"},
        {.name = "log",
         .body = log,
         .sentence =
             "Writes all that was done to the contact since it was made as a press log, which "
             "lab.protocol.read reads back as the same events: turns, loads, dwells, the times of a protocol "
             "that has them; and beside each press what it measured, in columns that the reader leaves out: "
             "result load or pressure, approach, area_fraction, peak_pressure. Where presses were asked for "
             "in several ways, all stand by the pressure that they brought. Returns the file.",
         .parameters = {{"path", "string", "under the run directory"}},
         .returns = "string",
         .example = "c:log \"done.csv\"",
         .heavy = true},
        {.name = "copy",
         .body = copy,
         .sentence = "A second contact in the same state.",
         .returns = "Contact",
         .example = "local before = c:copy()"},
        {.name = "explain",
         .body = explain,
         .sentence =
             "What a press will compute, what is off, and the expected transforms, memory and time. "
             "Given the press, with the keys of contact:press, that press is tried, on fewer cells "
             "where it takes over some quarter of a second, and its transforms are told by that: those that "
             "it takes, or mostly within a factor of two; without, they are a rough guess for a press by "
             "pressure. Presses nothing.",
         .options = &press_block(),
         .options_optional = true,
         .returns = "Plan",
         .example = "print(c:explain{ approach=\"20 nm\" })"},
        {.name = "lower",
         .body = lower,
         .sentence = "The lower body's surface as it is now, with all that yielded.",
         .returns = "Surface",
         .example = "print(c:lower():roughness().Ra)"},
        {.name = "upper",
         .body = upper,
         .sentence = "The upper body's surface as it is now, in its own frame, rough side up.",
         .returns = "Surface",
         .example = "c:upper():write \"worn.x3p\""},
        {.name = "close",
         .body = close,
         .sentence = "Frees the memory of the contact and of its states now instead of when Lua collects "
                     "them. What was read of a state stays, and its load, approach, area, peak pressure, "
                     "certificate and digest; reading anything else of it is an error.",
         .example = "c:close()"},
    };
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
