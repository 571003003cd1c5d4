// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/metrology/stylus.hpp"

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/metrology/spherical_tip.hpp"

namespace asperity::lua {

namespace {

const Block<StylusOptions>& stylus_block() {
  using O = StylusOptions;
  static const Block<O> block{
      "lab.stylus",
      {quantity("tip", &O::tip, dimension::length, at_least(0),
                "radius of the spherical tip; 0 is a needle that follows the surface"),
       Option<O>(quantity("spacing", &O::spacing, dimension::length, above(0),
                          "distance between samples; or give `speed` and `rate`"))
           .defaults_to("\"0.25 um\""),
       quantity("length", &O::length, dimension::length, above(0), "of a trace"),
       quantity("speed", &O::speed, dimension::speed, above(0), "of the tip; spacing = speed/rate"),
       quantity("rate", &O::rate, dimension::frequency, above(0), "of the samples; spacing = speed/rate")}};
  return block;
}

Values make_stylus(Call& call) { return {object(Stylus(call.options(stylus_block())))}; }

struct ScanKeys {
  int count = 5;
  std::uint64_t seed = 1;
};
const Block<ScanKeys>& scan_block() {
  static const Block<ScanKeys> block{
      "scan",
      {integer("count", &ScanKeys::count, between(1, most_traces), "number of traces"),
       integer(
           "seed", &ScanKeys::seed, at_least(0),
           "of their places and angles: the same seed goes over the same lines of a surface of that size")}};
  return block;
}

const RecordType<TipEffect>& tip_effect_type() {
  using E = TipEffect;
  static const RecordType<E> type{
      "TipEffect",
      "tip effect",
      "What a tip changed, against a needle on the same lines, over all traces.",
      {{"Ra_ratio", &E::ra_ratio, "Ra with the tip over Ra without; 1 where both are 0"},
       {"rms_slope_ratio", &E::rms_slope_ratio, "rms_slope with the tip over that without"},
       {"amplitude_ratio", &E::amplitude_ratio, "peak to valley with the tip over that without"},
       {"mean_lift", &E::mean_lift, dimension::length, "of the tip's lowest point above the surface"},
       {"greatest_lift", &E::greatest_lift, dimension::length,
        "of the tip's lowest point above the surface"}}};
  return type;
}

const RecordType<Traverse>& traverse_type() {
  using T = Traverse;
  static const RecordType<T> type{
      "Traverse",
      "line",
      "The line over which a trace goes.",
      {{"x", [](const T& t) { return t.start.x; }, dimension::length, "where it begins"},
       {"y", [](const T& t) { return t.start.y; }, dimension::length, "where it begins"},
       {"angle", &T::angle, dimension::angle, "its direction, counter-clockwise from x"}}};
  return type;
}

Values scan(Call& call) {
  const Surface& surface = call.object<Surface>(1, "surface");
  const ScanKeys keys = call.options(scan_block(), 2);
  StylusScan result = call.self<Stylus>().scan(surface, keys.count, keys.seed, call.session().monitor());
  List traces;
  for (Profile& trace : result.traces) traces.items.push_back(object(std::move(trace)));
  traces.named.emplace_back("tip_effect", tip_effect_type()(result.effect));
  traces.named.emplace_back("lines", traverse_type().list(result.lines));
  return {std::move(traces)};
}

Values dilate(Call& call) {
  return {object(
      dilated(call.object<Surface>(1, "surface"), call.self<Stylus>().tip(), call.session().monitor()))};
}
Values close_map(Call& call) {
  return {object(
      closed(call.object<Surface>(1, "surface"), call.self<Stylus>().tip(), call.session().monitor()))};
}

std::string describe_stylus(const void* self) {
  const auto& s = *static_cast<const Stylus*>(self);
  return "stylus: tip radius " + format_quantity(s.tip(), dimension::length) + ", " +
         std::to_string(s.samples()) + " samples every " + format_quantity(s.spacing(), dimension::length) +
         (s.speed() ? ", at " + format_quantity(*s.speed(), dimension::speed) : "");
}

}  // namespace

Function stylus_function() {
  return {.name = "stylus",
          .body = make_stylus,
          .sentence =
              "A stylus profiler with a spherical tip, which rests on the surface wherever it first "
              "touches (grey-scale dilation).",
          .options = &stylus_block(),
          .options_optional = true,
          .returns = "Stylus",
          .example = "local stylus = lab.stylus{ tip=\"2 um\", speed=\"50 um/s\", rate=\"200 Hz\" }"};
}

template <>
const Class& class_of<Stylus>() {
  static const Class type = [] {
    Class c;
    c.name = "Stylus";
    c.article_name = "a stylus";
    c.sentence = "A stylus profiler; an immutable value.";
    c.describe = describe_stylus;
    c.equal = have_one_digest<Stylus>;
    c.digest = text_of<&Stylus::digest>;
    c.fields = {
        getter<&Stylus::tip>("tip", "number", "radius of the tip", dimension::length),
        getter<&Stylus::spacing>("spacing", "number", "distance between samples", dimension::length),
        getter<&Stylus::length>("length", "number", "of a trace", dimension::length),
        getter<&Stylus::samples>("samples", "integer",
                                 "number of samples of a trace: the whole spacings in its length"),
        getter<&Stylus::speed>("speed", "number", "of the tip; nil where only the spacing is known",
                               dimension::speed),
        getter<&Stylus::rate>("rate", "number", "of the samples; nil where only the spacing is known",
                              dimension::frequency),
        getter<&Stylus::digest>("digest", "string", "equal styluses have equal digests"),
    };
    c.methods = {
        {.name = "scan",
         .body = scan,
         .sentence =
             "Traces at random places and angles, as the tip gives them: nothing is levelled or "
             "filtered. On a periodic surface they go on past the rim; on any other they stay inside. "
             "The list also holds tip_effect, what the tip changed against a needle on the same lines, and "
             "lines, where each trace begins and its angle. Over points that were not measured only a needle "
             "(tip=0) goes: its traces have holes there.",
         .parameters = {{"surface", "Surface", "what is measured"}},
         .options = &scan_block(),
         .options_optional = true,
         .returns = "Profile[] with tip_effect: TipEffect and lines: Traverse[]",
         .example = "local traces = stylus:scan(s, { count=5, seed=1 })",
         .heavy = true},
        {.name = "dilated",
         .body = dilate,
         .sentence = "The whole map as the tip gives it, touching at nodes.",
         .parameters = {{"surface", "Surface", "what is measured"}},
         .returns = "Surface",
         .example = "local felt = stylus:dilated(s)",
         .heavy = true},
        {.name = "closed",
         .body = close_map,
         .sentence =
             "The part of the map that the tip could touch, what it cannot enter filled (dilation, then "
             "erosion, at the nodes; the closing of ISO 16610-85).",
         .parameters = {{"surface", "Surface", "what is measured"}},
         .returns = "Surface",
         .example = "local reached = stylus:closed(s)",
         .heavy = true},
    };
    c.results = {&tip_effect_type(), &traverse_type()};
    return c;
  }();
  return type;
}

}  // namespace asperity::lua
