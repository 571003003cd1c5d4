// SPDX-License-Identifier: GPL-3.0-or-later
// lab.contact: two specimens on the bench. Its options table becomes a Scene; pressing gives states.
#include "bindings/lua/contact.hpp"

#include <algorithm>

#include "bindings/lua/catalogue.hpp"
#include "bindings/lua/grid_keys.hpp"
#include "bindings/lua/session.hpp"
#include "bindings/lua/surface.hpp"
#include "engine/contact/effects/catalogue.hpp"

namespace asperity::lua {

namespace {

// --- lab.contact{...}

struct BoxKeys {
  std::string model = "box";
  std::optional<double> stiffness;
};
const Block<BoxKeys>& box_block() {
  static const Block<BoxKeys> block{"elasticity",
                                    {text("model", &BoxKeys::model, "how the bodies give way").required(),
                                     quantity("stiffness", &BoxKeys::stiffness, dimension::stiffness,
                                              above(0), "pressure per shortening of a box element")
                                         .defaults_to("E*/peak-to-valley")}};
  return block;
}

const Block<Accuracy>& accuracy_block() {
  using O = Accuracy;
  static const Block<O> block{
      "accuracy",
      {number("tolerance", &O::tolerance, {1e-15, 1, false, true, false},
              "bound on every relative entry of the certificate"),
       choice("precision", &O::precision,
              {{"double", O::Precision::double_}, {"single", O::Precision::single}},
              "of the fields inside a solve"),
       choice("on_failure", &O::on_failure, {{"error", O::OnFailure::error}, {"best", O::OnFailure::best}},
              "what a solve that misses its tolerance does: raise an error, or return the best it got")}};
  return block;
}

struct SceneKeys {
  std::optional<Surface> lower;
  std::optional<UpperBody> upper;
  Boundary boundary = Boundary::free;
  std::optional<Elasticity> elasticity;
  Accuracy accuracy;
};

// Appends what `act` throws.
template <class Act>
void collect(Problems& problems, Act act) {
  try {
    act();
  } catch (const Error& error) {
    problems.push_back(error.what());
  }
}

void read_elasticity(const Argument& value, SceneKeys& keys, Problems& problems) {
  BoxKeys box;
  if (value.is_text()) {
    box.model = value.text();
  } else if (value.is_table()) {
    collect(problems, [&] { box = box_block().read(value, "`effects.elasticity`"); });
  } else {
    problems.push_back("`effects.elasticity` is " + value.describe() +
                       "; give \"box\" or { model=\"box\", stiffness= }");
    return;
  }
  collect(problems, [&] {
    require_elasticity_model(box.model);
    keys.elasticity = BoxOptions{box.stiffness};
  });
}

// Every key of the table is an effect by name; those this build does not compute are refused.
void read_effects(const Argument& value, const OptionInfo& info, SceneKeys& keys, Problems& problems) {
  if (!value.is_table())
    return detail::wrong_type(value, info, "a table such as { elasticity=\"box\" }", problems);
  std::vector<std::string> names;
  value.each([&](const Argument& key, const Argument&) {
    if (key.is_text())
      names.emplace_back(key.text());
    else
      problems.push_back("`effects` holds " + key.describe() + " as a key; write { elasticity=\"box\" }");
  });
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    collect(problems, [&] {
      require_effect(name);
      if (name == "elasticity")
        with_key(value, name,
                 [&](const Argument& elasticity) { read_elasticity(elasticity, keys, problems); });
    });
  }
  if (std::find(names.begin(), names.end(), "elasticity") == names.end())
    problems.push_back("`effects` names no elasticity; give elasticity=\"box\"");
}

const Block<SceneKeys>& scene_block() {
  using K = SceneKeys;
  static const Block<K> block{
      "lab.contact",
      {native<Surface>("lower", &K::lower, "Surface", "a surface", "the lower body, rough side up")
           .required(),
       custom<K>("upper", "Surface|Material",
                 "the upper body: a rough surface that is turned over to face down, a flat of a "
                 "material, or lab.rigid",
                 [](const Argument& value, const OptionInfo& info, K& keys, Problems& problems) {
                   if (const Surface* surface = value.as<Surface>())
                     keys.upper = *surface;
                   else if (const Material* material = value.as<Material>())
                     keys.upper = *material;
                   else if (const Object* object = value.as_any_object(); object != nullptr && object->closed)
                     problems.push_back("`upper` was closed");
                   else if (value.is_text())
                     problems.push_back("`upper` is the string \"" + std::string(value.text().substr(0, 40)) +
                                        "\"; a flat of a material is lab.material \"" +
                                        std::string(value.text().substr(0, 40)) + "\"");
                   else if (!value.is_unknown())
                     detail::wrong_type(value, info, "a surface, a material or lab.rigid", problems);
                 })
           .required(),
       choice("boundary", &K::boundary, {{"free", Boundary::free}, {"periodic", Boundary::periodic}},
              "whether the tile goes on beyond its rim"),
       custom<K>("effects", "{ elasticity=\"box\"|{ model=\"box\", stiffness= } }",
                 "what the scene computes, by name, e.g. { elasticity=\"box\" }; nothing else is",
                 read_effects)
           .required(),
       table_of("accuracy", &K::accuracy, accuracy_block(),
                "how close a solve must come, and what if it does not")}};
  return block;
}

Values make_contact(Call& call) {
  const SceneKeys keys = call.options(scene_block());
  Scene scene{*keys.lower, *keys.upper, keys.boundary, *keys.elasticity, keys.accuracy};
  return {object(SpecimenPair(scene))};
}

// --- pressing

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

struct PressKeys {
  int given = 0;
  PressRequest request;
  std::optional<double> dwell;
};
const Block<PressKeys>& press_block() {
  static const Block<PressKeys> block = [] {
    std::vector<Option<PressKeys>> options;
    for (const auto& entry : press_keys) {
      const NumberRange range = entry.by == PressBy::flatten ? between(0, 1) : at_least(0);
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
    return Block<PressKeys>("press", std::move(options), [](PressKeys& keys, Problems& problems) {
      if (keys.given != 1)
        problems.push_back(
            "give exactly one of `pressure`, `load`, `approach`, `indentation` and `flatten`; " +
            std::to_string(keys.given) + " are given");
    });
  }();
  return block;
}

Values press(Call& call) {
  PressKeys keys = call.options(press_block());
  keys.request.dwell = keys.dwell;
  return {object(call.self<SpecimenPair>().press(keys.request, call.session().monitor()))};
}

struct SweepKeys {
  int given = 0;
  std::vector<PressRequest> requests;
};
const Block<SweepKeys>& sweep_block() {
  static const Block<SweepKeys> block = [] {
    std::vector<Option<SweepKeys>> options;
    for (const auto& entry : press_keys) {
      const NumberRange range = entry.by == PressBy::flatten ? between(0, 1) : at_least(0);
      auto option = custom<SweepKeys>(
          entry.key,
          (entry.dimension == dimension::number ? "number" : asperity::describe(entry.dimension)) + "[]",
          std::string("a list: ") + entry.sentence,
          [entry, range](const Argument& value, const OptionInfo& info, SweepKeys& keys, Problems& problems) {
            ++keys.given;
            if (!value.is_table() || value.length() == 0)
              return detail::wrong_type(value, info, "a list of values, e.g. { \"1 MPa\", \"2 MPa\" }",
                                        problems);
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

Values sweep(Call& call) {
  const SweepKeys keys = call.options(sweep_block());
  auto pair = call.shared_self<SpecimenPair>();
  return {Iterator{
      [pair, requests = keys.requests, k = std::size_t{0}](Call& step) mutable -> std::optional<Values> {
        if (k >= requests.size()) return std::nullopt;
        return Values{object(pair->press(requests[k++], step.session().monitor()))};
      }}};
}

// --- the bench

Values release_load(Call& call) {
  call.self<SpecimenPair>().release();
  return {};
}

struct PlaceKeys {
  std::uint64_t seed = 1;
};
const Block<PlaceKeys>& place_block() {
  static const Block<PlaceKeys> block{
      "place",
      {integer("seed", &PlaceKeys::seed, at_least(0), "of the turn and the shift that are drawn")
           .required()}};
  return block;
}
Values place(Call& call) {
  call.self<SpecimenPair>().place(call.options(place_block()).seed);
  return {};
}

Values rotate(Call& call) {
  call.self<SpecimenPair>().rotate(call.quantity(1, "angle", dimension::angle));
  return {};
}

struct ShiftKeys {
  double x = 0, y = 0;
};
const Block<ShiftKeys>& shift_block() {
  static const Block<ShiftKeys> block{
      "shift",
      {quantity("x", &ShiftKeys::x, dimension::length, any(), "way along x, whole cells"),
       quantity("y", &ShiftKeys::y, dimension::length, any(), "way along y, whole cells")}};
  return block;
}
Values shift(Call& call) {
  const ShiftKeys keys = call.options(shift_block());
  call.self<SpecimenPair>().shift(keys.x, keys.y);
  return {};
}

Values copy(Call& call) { return {object(SpecimenPair(call.self<SpecimenPair>()))}; }
Values explain(Call& call) { return {call.self<SpecimenPair>().plan().text()}; }
Values lower(Call& call) { return {object(Surface(call.self<SpecimenPair>().lower()))}; }
Values upper(Call& call) { return {object(call.self<SpecimenPair>().upper())}; }

Values close(Call& call) {
  if (Object* self = Argument(call.L, 1).as_object(class_of<SpecimenPair>())) {
    self->pointer.reset();
    self->closed = true;
  }
  return {};
}

std::string describe(const void* self) {
  const auto& pair = *static_cast<const SpecimenPair*>(self);
  return "contact: " + pair.plan().title + (pair.under_load() ? ", under load" : "");
}
std::string digest(const void* self) {
  const auto& pair = *static_cast<const SpecimenPair*>(self);
  return pair.lower().digest() + "+" + (pair.upper_is_flat() ? std::string("flat") : pair.upper().digest());
}

}  // namespace

Function contact_function() {
  return {.name = "contact",
          .body = make_contact,
          .sentence = "Puts two bodies on the bench. Only the effects that are named are computed.",
          .options = &scene_block(),
          .returns = "Contact",
          .example = "local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity=\"box\" } }"};
}

const Class& contact_class() {
  static const Class type = [] {
    Class c;
    c.name = "Contact";
    c.article_name = "a contact";
    c.sentence =
        "Two specimens on the bench, how the upper lies on the lower, and what the scene computes: the one "
        "value "
        "that changes.";
    c.shareable = false;
    c.describe = describe;
    c.digest = digest;
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
         .sentence = "One state after another along a list of loads, up or down.",
         .options = &sweep_block(),
         .returns = "iterator<State>",
         .example = "for st in c:sweep{ pressure={\"1 MPa\", \"10 MPa\"} } do print(st.area_fraction) end"},
        {.name = "release", .body = release_load, .sentence = "Takes the load off."},
        {.name = "place",
         .body = place,
         .sentence = "Lifts the upper body and puts it down turned by a multiple of 90 degrees and, on a "
                     "periodic tile, shifted "
                     "by whole cells, as drawn from the seed; heights are never resampled.",
         .options = &place_block(),
         .example = "c:place{ seed=2 }"},
        {.name = "rotate",
         .body = rotate,
         .sentence = "Turns the upper body about the centre of the nodes, counter-clockwise seen from above, "
                     "by a multiple of 90 "
                     "degrees.",
         .parameters = {{"angle", "an angle", "to turn by"}},
         .example = "c:rotate \"90 deg\""},
        {.name = "shift",
         .body = shift,
         .sentence = "Shifts the upper body by whole cells on a periodic tile.",
         .options = &shift_block(),
         .example = "c:shift{ x=\"10 um\" }"},
        {.name = "copy",
         .body = copy,
         .sentence = "A second contact in the same state.",
         .returns = "Contact"},
        {.name = "explain",
         .body = explain,
         .sentence =
             "What a press will compute, what is off, and the expected transforms, memory and time, as text.",
         .returns = "string",
         .example = "print(c:explain())"},
        {.name = "lower",
         .body = lower,
         .sentence = "The lower body's surface as it is now.",
         .returns = "Surface"},
        {.name = "upper",
         .body = upper,
         .sentence = "The upper body's surface as it is now, in its own frame, rough side up.",
         .returns = "Surface"},
        {.name = "close",
         .body = close,
         .sentence = "Frees the contact's memory now instead of when Lua collects it."},
    };
    return c;
  }();
  return type;
}

template <>
const Class& class_of<SpecimenPair>() {
  return contact_class();
}

}  // namespace asperity::lua
