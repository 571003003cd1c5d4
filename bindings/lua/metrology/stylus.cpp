// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/metrology/stylus.hpp"

#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/surface/surface.hpp"

namespace asperity::lua {

namespace {

const Block<StylusOptions> stylus_block{
    {quantity("tip", &StylusOptions::tip, dimension::length, at_least(0),
              "radius of the spherical tip; 0 is a needle that follows the surface"),
     quantity("spacing", &StylusOptions::spacing, dimension::length, above(0),
              "distance between samples; or give `speed` and `rate`")
         .defaults_to("\"0.25 um\""),
     quantity("length", &StylusOptions::length, dimension::length, above(0), "of a trace"),
     quantity("speed", &StylusOptions::speed, dimension::speed, above(0), "of the tip; spacing = speed/rate"),
     quantity("rate", &StylusOptions::rate, dimension::frequency, above(0),
              "of the samples; spacing = speed/rate")}};

struct ScanKeys {
  int count = 5;
  std::uint64_t seed = 1;
};
const Block<ScanKeys> scan_block{
    {integer("count", &ScanKeys::count, between(1, most_traces), "number of traces"),
     integer("seed", &ScanKeys::seed, at_least(0),
             "of the places and angles: the same seed gives the same lines on a surface of that size")}};

const RecordType<TipEffect> tip_effect_type{
    "TipEffect",
    "tip effect",
    "Changes by a tip, compared with a needle on the same lines, over all traces.",
    {{"Ra_ratio", &TipEffect::ra_ratio, "Ra with the tip over Ra without; 1 where both are 0"},
     {"rms_slope_ratio", &TipEffect::rms_slope_ratio, "rms_slope with the tip over that without"},
     {"amplitude_ratio", &TipEffect::amplitude_ratio, "peak to valley with the tip over that without"},
     {"mean_lift", &TipEffect::mean_lift, dimension::length, "of the tip's lowest point above the surface"},
     {"greatest_lift", &TipEffect::greatest_lift, dimension::length,
      "of the tip's lowest point above the surface"}}};

const RecordType<Traverse> traverse_type{
    "Traverse",
    "line",
    "The line of a trace.",
    {{"x", [](const Traverse& t) { return t.start.x; }, dimension::length, "where it begins"},
     {"y", [](const Traverse& t) { return t.start.y; }, dimension::length, "where it begins"},
     {"angle", &Traverse::angle, dimension::angle, "its direction, counter-clockwise from x"}}};

Values scan(Call& call) {
  const Surface& surface = call.object<Surface>(1, "surface");
  const ScanKeys keys = call.options(scan_block, 2);
  StylusScan result = call.self<Stylus>().scan(surface, keys.count, keys.seed, call.session().monitor());
  List traces;
  for (Profile& trace : result.traces) traces.items.push_back(object(std::move(trace)));
  traces.named.emplace_back("tip_effect", tip_effect_type(result.effect));
  traces.named.emplace_back("lines", traverse_type.list(result.lines));
  return {std::move(traces)};
}

}  // namespace

Function stylus_function() {
  return {.name = "stylus",
          .body = [](Call& call) -> Values { return {object(Stylus(call.options(stylus_block)))}; },
          .sentence =
              "A stylus profiler with a spherical tip, which rests on the surface wherever it first touches "
              "(grey-scale dilation).",
          .options = optional(stylus_block),
          .returns = "Stylus",
          .example = "local stylus = lab.stylus{ tip=\"2 um\", speed=\"50 um/s\", rate=\"200 Hz\" }"};
}

Class make_class(For<Stylus>) {
  Class c{"Stylus", "a stylus", "A stylus profiler; an immutable value."};
  c.describe = from_value([](const Stylus& s) -> std::string {
    return "stylus: tip radius " + format_quantity(s.tip(), dimension::length) + ", " +
           std::to_string(s.samples()) + " samples every " + format_quantity(s.spacing(), dimension::length) +
           (s.speed() ? ", at " + format_quantity(*s.speed(), dimension::speed) : "");
  });
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
       .sentence = "Traces at random places and angles, as the tip gives them: nothing is levelled or "
                   "filtered. On a periodic surface they go on past the rim; on any other they stay "
                   "inside. The list also holds tip_effect, the changes by the tip compared with a needle "
                   "on the same lines, and lines, the start and angle of each trace. Only a needle (tip=0) "
                   "crosses unmeasured points; its traces have holes there.",
       .parameters = {{"surface", "Surface", "measured quantity"}},
       .options = optional(scan_block),
       .returns = "Profile[] with tip_effect: TipEffect and lines: Traverse[]",
       .example = "local traces = stylus:scan(s, { count=5, seed=1 })",
       .heavy = true},
      {.name = "dilated",
       .body = method([](const Stylus& s, Call& call) {
         return dilated(call.object<Surface>(1, "surface"), s.tip(), call.session().monitor());
       }),
       .sentence = "The whole map as the tip gives it, touching at nodes.",
       .parameters = {{"surface", "Surface", "measured quantity"}},
       .returns = "Surface",
       .example = "local felt = stylus:dilated(s)",
       .heavy = true},
      {.name = "closed",
       .body = method([](const Stylus& s, Call& call) {
         return closed(call.object<Surface>(1, "surface"), s.tip(), call.session().monitor());
       }),
       .sentence = "The part of the map within reach of the tip, with all narrower hollows filled "
                   "(dilation, then erosion, at the nodes; the closing of ISO 16610-85).",
       .parameters = {{"surface", "Surface", "measured quantity"}},
       .returns = "Surface",
       .example = "local reached = stylus:closed(s)",
       .heavy = true},
  };
  c.results = {&tip_effect_type, &traverse_type};
  return c;
}

}  // namespace asperity::lua
