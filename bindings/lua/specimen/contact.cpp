// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/specimen/contact.hpp"

#include "bindings/lua/registry/call_record.hpp"
#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/run/run.hpp"
#include "bindings/lua/runtime/files.hpp"
#include "bindings/lua/specimen/state_table.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/files/atomic_file.hpp"
#include "engine/recording/press_log.hpp"

namespace asperity::lua {

namespace {

constexpr struct {
  const char* key;
  PressBy by;
  Dimension dimension;
  const char* sentence;
  NumberRange range = any();
  std::string type() const {
    return dimension == dimension::number ? "number" : asperity::describe(dimension);
  }
} press_keys[] = {
    {"pressure", PressBy::pressure, dimension::pressure, "mean pressure over the tile"},
    {"load", PressBy::load, dimension::force, "force on the whole tile"},
    {"approach", PressBy::approach, dimension::length, "from first touch"},
    {"indentation", PressBy::indentation, dimension::number,
     "approach over the peak-to-valley of the combined heights"},
    {"flatten", PressBy::flatten, dimension::number, "share of the peak-to-valley pressed away",
     between(0, 1)},
};

Values press(Call& call) {
  const PressKeys request = call.options(press_block);
  return {object(call.self<SpecimenPair>().press(request, call.session().monitor()))};
}

struct SweepKeys {
  int given = 0;
  std::vector<PressRequest> requests;
};
const Block<SweepKeys> sweep_block = [] {
  std::vector<Option<SweepKeys>> options;
  for (const auto& entry : press_keys) {
    auto option = custom<SweepKeys>(
        entry.key, entry.type() + "[]", std::string("a list: ") + entry.sentence,
        [entry](const Argument& value, const OptionInfo& info, SweepKeys& keys, Problems& problems) {
          ++keys.given;
          const std::string wanted = "a list of values, e.g. { \"1 MPa\", \"2 MPa\" }";
          if (!value.is_table()) return detail::wrong_type(value, info, wanted, problems);
          if (value.length() == 0)
            return problems.push_back(quoted(info.name) + " is an empty list; give " + wanted);
          value.elements([&](const Argument& part) {
            if (auto v = detail::read_quantity(part, info, entry.range, problems))
              keys.requests.push_back({entry.by, *v, {}});
          });
        });
    option.info.dimension = entry.dimension;
    options.push_back(std::move(option));
  }
  return Block<SweepKeys>(std::move(options), [](SweepKeys& keys, Problems& problems) {
    if (keys.given != 1)
      problems.push_back(
          "give exactly one list: `pressure`, `load`, `approach`, `indentation` or `flatten`; " +
          std::to_string(keys.given) + " are given");
  });
}();

// With adhesion, states depend on earlier turning points.
Values sweep(Call& call) {
  const SweepKeys keys = call.options(sweep_block);
  auto pair = call.shared_self<SpecimenPair>();
  return {Iterator{[pair, requests = keys.requests, k = std::size_t{0},
                    visited = std::vector<double>()](Call& step) mutable -> std::optional<Values> {
                     if (k >= requests.size()) return std::nullopt;
                     if (pair->closed())
                       refuse_state("the contact of the sweep was closed inside its loop",
                                    "close it after the loop");
                     PressRequest request = requests[k];
                     if (k == 0 && request.by_load() && request.value < 0)
                       visited.push_back(0);  // pull: zero load first
                     if (pair->plan().attracts()) request.preload = turns_before(visited, request.value);
                     const asperity::State state = pair->press(request, step.session().monitor());
                     record_press(step.session(), pair, request, state);
                     visited.push_back(request.value);
                     ++k;  // last: a press that ran out of memory is repeated
                     return Values{object(state)};
                   },
                   call.function_name(),
                   {},
                   [pair](Call& step, const auto& turn) { return table_of_states(step, pair, turn); }}};
}

void warn_of_flat(const Call& call, const char* done) {
  if (call.self<SpecimenPair>().upper_is_flat())
    call.warn(std::string(done) + " a flat upper body changes nothing: every placement is the same contact");
}

Values place(Call& call) {
  call.self<SpecimenPair>().place(call.options(place_block).seed);
  warn_of_flat(call, "placing");
  return {};
}

Values rotate(Call& call) {
  call.self<SpecimenPair>().rotate(call.quantity(1, "angle", dimension::angle));
  warn_of_flat(call, "turning");
  return {};
}

Values shift(Call& call) {
  const ShiftKeys keys = call.options(shift_block);
  call.self<SpecimenPair>().shift(keys.x, keys.y);
  return {};
}

Values log(Call& call) {
  const std::string text = bench_log_text(call.self<SpecimenPair>());
  const std::string path = writable_path(call, call.text(1, "path"));
  write_atomically(path, text);
  return {path};
}
void close_states(void* self) { static_cast<SpecimenPair*>(self)->close(); }

Values close(Call& call) {
  if (Object* self = Argument(call.L, 1).as_object(class_of<SpecimenPair>())) {
    if (self->pointer != nullptr) close_states(self->pointer.get());
    self->pointer.reset();
    self->closed = true;
  }
  return {};
}

}  // namespace

const Block<PressKeys> press_block = [] {
  std::vector<Option<PressKeys>> options;
  for (const auto& entry : press_keys) {
    auto option = custom<PressKeys>(
        entry.key, entry.type(), entry.sentence,
        [entry](const Argument& value, const OptionInfo& info, PressKeys& keys, Problems& problems) {
          ++keys.given;
          const auto v = detail::read_quantity(value, info, entry.range, problems);
          if (!v) return;
          keys.by = entry.by;
          keys.value = *v;
        });
    option.info.dimension = entry.dimension;
    option.info.range_text = entry.range.text(entry.dimension);
    option.show = [entry](const PressKeys& keys) {
      return keys.given == 1 && keys.by == entry.by ? format_exact(keys.value) : std::string();
    };
    options.push_back(std::move(option));
  }
  options.push_back(quantity("dwell", &PressRequest::dwell, dimension::time, at_least(0),
                             "duration of the load; for creep alone"));
  // Dimension of the controlled quantity, which precedes `preload` in the block.
  auto preload = custom<PressKeys>(
      "preload", "number|string|(number|string)[]",
      "of bodies that attract each other: pressed to this first, in the same quantity, and drawn back from "
      "there; or a list of values gone to in turn",
      [](const Argument& value, const OptionInfo& info, PressKeys& keys, Problems& problems) {
        OptionInfo same = info;
        for (const auto& entry : press_keys)
          if (entry.by == keys.by) same.dimension = entry.dimension;
        const auto read_one = [&](const Argument& one) {
          if (auto v = detail::read_quantity(one, same, any(), problems)) keys.preload.push_back(*v);
        };
        if (!value.is_table()) return read_one(value);
        value.elements(read_one);
      });
  preload.show = [](const PressKeys& keys) {
    std::vector<std::string> turns;
    for (const double turn : keys.preload) turns.push_back(format_exact(turn));
    return turns.size() > 1 ? "{" + joined(turns, ", ") + "}" : joined(turns, "");
  };
  options.push_back(std::move(preload));
  return Block<PressKeys>(std::move(options), [](PressKeys& keys, Problems& problems) {
    if (keys.given != 1)
      problems.push_back("give exactly one of `pressure`, `load`, `approach`, `indentation` and `flatten`; " +
                         std::to_string(keys.given) + " are given");
  });
}();

std::vector<PressRequest> requests_of(const Call& call, const Function& function) {
  const Argument table = call.argument(1);
  bool known = table.is_table() && !table.is_unknown();
  const auto look = [&](const Argument&, const Argument& value) {
    known = known && !holds_unknown(value, 1);
  };
  if (known) table.each(look);
  if (!known) return {};
  if (function.options == &press_block) return {press_block.read(table, call.function_name())};
  if (function.options == &sweep_block) return sweep_block.read(table, call.function_name()).requests;
  return {};
}

void record_press(const Session& session, const std::shared_ptr<SpecimenPair>& pair,
                  const PressRequest& request, const asperity::State& state) {
  const Object self{&class_of<SpecimenPair>(), pair, false};
  record_call(session, "contact:press", &self, press_block.resolved({request, 1}),
              {object(asperity::State(state))});
}

const Block<PlaceKeys> place_block{
    {integer("seed", &PlaceKeys::seed, at_least(0), "of the turn and the shift that are drawn").required()}};

const Block<ShiftKeys> shift_block{
    {quantity("x", &ShiftKeys::x, dimension::length, any(), "way along x, whole cells"),
     quantity("y", &ShiftKeys::y, dimension::length, any(), "way along y, whole cells")}};

Function contact_function() {
  return {.name = "contact",
          .body = [](Call& call) -> Values { return {object(SpecimenPair(read_scene(call)))}; },
          .sentence = "Puts two bodies on the bench. Only the effects that are named are computed.",
          .options = &scene_keys(),
          .returns = "Contact",
          .example = "local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity=\"box\" } }",
          .look = look_at_scene};
}

// data table
Class make_class(For<SpecimenPair>) {
  Class c{"Contact", "a contact",
          "Two specimens on the bench, the placement of the upper on the lower, and the scene: the only "
          "value that changes."};
  c.shareable = false;
  c.describe = from_value([](const SpecimenPair& pair) -> std::string {
    return "contact: " + pair.plan().title + (pair.under_load() ? ", under load" : "");
  });
  c.digest = from_value([](const SpecimenPair& pair) -> std::string {
    return pair.lower().digest() + "+" + (pair.upper_is_flat() ? std::string("flat") : pair.upper().digest());
  });
  c.closing = close_states;
  c.methods = {
      {.name = "press",
       .body = press,
       .sentence = "The state under a load, given in one of five ways.",
       .options = &press_block,
       .returns = "State",
       .example = "local st = c:press{ pressure=\"10 MPa\" }",
       .heavy = true},
      {.name = "sweep",
       .body = sweep,
       .sentence =
           "One state after another along a list of loads, up or down. Bodies that attract each other are "
           "followed on their branch: each state is drawn from the turns of the list before it. With :table{ "
           "\"pressure [MPa]\", \"area_fraction [%]\" } behind it, all states become a Table.",
       .options = &sweep_block,
       .returns = "iterator<State>",
       .example = "for st in c:sweep{ pressure={\"1 MPa\", \"10 MPa\"} } do print(st.area_fraction) end",
       .heavy = true,
       .look_at_table = look_at_columns_of_states},
      shear_method(),
      {.name = "release",
       .body = [](Call& call) -> Values { return call.self<SpecimenPair>().release(), Values(); },
       .sentence = "Takes the load off. The bodies recover elastically; plastic deformation stays.",
       .example = "c:release()"},
      {.name = "place",
       .body = place,
       .sentence =
           "Lifts the upper body and puts it down turned by a multiple of 90 degrees and, on a periodic "
           "tile, shifted by whole cells, as drawn from the seed; heights are never resampled.",
       .options = &place_block,
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
       .options = &shift_block,
       .example = "c:shift{ x=\"10 um\" }"},
      {.name = "log",
       .body = log,
       .sentence =
           "Writes all events as a press log, which lab.protocol.read reads back: turns, loads, dwells, the "
           "times of a protocol that has them. Further columns, which the reader skips, hold the results of "
           "each press: result load or pressure, approach, area_fraction, peak_pressure. If presses were "
           "requested in several ways, the log gives the resulting pressure of all. Returns the file.",
       .parameters = {{"path", "string", "under the run directory"}},
       .returns = "string",
       .example = "c:log \"done.csv\"",
       .heavy = true},
      {.name = "copy",
       .body = method([](const SpecimenPair& pair) { return pair.copy(); }),
       .sentence = "A second contact in the same state.",
       .returns = "Contact",
       .example = "local before = c:copy()"},
      {.name = "explain",
       .body = method([](const SpecimenPair& pair, Call& call) {
         return call.given(1) ? pair.plan_of(call.options(press_block)) : pair.plan();
       }),
       .sentence = "Plan of a press: the computed terms, the terms that are off, and the expected "
                   "transforms, memory and time. Given the keys of contact:press, one trial of this press "
                   "counts its transforms: exactly on up to 128 x 128 cells, within a factor of two in nine "
                   "presses of ten on more, from a trial on about 128 x 128. Without keys, they are a rough "
                   "guess for a press by pressure. Presses nothing.",
       .options = optional(press_block),
       .returns = "Plan",
       .example = "print(c:explain{ approach=\"20 nm\" })"},
      {.name = "lower",
       .body = method([](const SpecimenPair& pair) { return pair.lower(); }),
       .sentence = "The lower body's surface as it is now, with all that yielded.",
       .returns = "Surface",
       .example = "print(c:lower():roughness().Ra)"},
      {.name = "upper",
       .body = method([](const SpecimenPair& pair) { return pair.upper(); }),
       .sentence = "The upper body's surface as it is now, in its own frame, rough side up.",
       .returns = "Surface",
       .example = "c:upper():write \"worn.x3p\""},
      {.name = "close",
       .body = close,
       .sentence = "Frees the memory of the contact and all its states now instead of at Lua's next "
                   "collection. A state retains every value already read, and its load, approach, area, peak "
                   "pressure, certificate and digest; reading another value is an error.",
       .example = "c:close()"},
  };
  return c;
}

}  // namespace asperity::lua
