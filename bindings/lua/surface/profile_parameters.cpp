// SPDX-License-Identifier: GPL-3.0-or-later
// p:profile_parameters{...}: ISO 21920-2 parameters of a trace, filtered and sectioned by ISO 21920-3.
// p:primary_parameters{...}: without an L-filter.
#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/options.hpp"
#include "bindings/lua/registry/record_type.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/levelling.hpp"
#include "engine/metrology/parameters/profile_parameters.hpp"

namespace asperity::lua {

namespace {

struct ProfileParameterKeys {
  std::optional<int> F;
  std::optional<double> S, section;
  std::optional<std::string> setting;
  int sections = 5;
  double threshold = 0.1;
};

const Block<ProfileParameterKeys> profile_parameters_block{
    {quantity("section", &ProfileParameterKeys::section, dimension::length, above(0),
              "length of a section and nesting index Nic of the L-filter; this or `class`"),
     text("class", &ProfileParameterKeys::setting,
          "setting class of ISO 21920-3, \"Sc1\" to \"Sc5\": it gives `section` and `S`"),
     integer("sections", &ProfileParameterKeys::sections, between(1, 1000), "how many"),
     integer("F", &ProfileParameterKeys::F, between(0, max_levelling_degree),
             "F-operation: degree of the polynomial taken away first; without it none"),
     quantity("S", &ProfileParameterKeys::S, dimension::length, above(0),
              "nesting index Nis of the S-filter: shorter waves are attenuated; without it none"),
     number("threshold", &ProfileParameterKeys::threshold, between(0, 1),
            "of Rp and Rv: lower hills and dales are no elements of Rsm and Rc")}};

struct PrimaryParameterKeys {
  std::optional<int> F;
  std::optional<double> S;
  int sections = 1;
  double threshold = 0.1;
};

const Block<PrimaryParameterKeys> primary_parameters_block{
    {integer("F", &PrimaryParameterKeys::F, between(0, max_levelling_degree),
             "F-operation: degree of the polynomial taken away first; without it none"),
     quantity("S", &PrimaryParameterKeys::S, dimension::length, above(0),
              "nesting index Nis of the S-filter: shorter waves are attenuated, half of it is cut off at "
              "either end; without it none"),
     integer("sections", &PrimaryParameterKeys::sections, between(1, 1000),
             "equal parts of the evaluation length; one unless given"),
     number("threshold", &PrimaryParameterKeys::threshold, between(0, 1),
            "of Pp and Pv: lower hills and dales are no elements of Psm and Pc")}};

struct MeasuredProfile {
  ProfileParameters values;
  PreparedProfile prepared;
  double section;
};

// "Rz" becomes "Pz", also in sentences.
std::string named_of(char kind, std::string text) {
  for (std::size_t k = 0; k + 1 < text.size(); ++k) {
    const bool begins = k == 0 || text[k - 1] == ' ' || text[k - 1] == '_';
    if (begins && text[k] == 'R' && std::islower(static_cast<unsigned char>(text[k + 1])) != 0)
      text[k] = kind;
  }
  return text;
}

// With the profile's letter.
std::vector<RecordField<MeasuredProfile>> fields_of(char kind) {
  using M = MeasuredProfile;
  const auto sectioned = [](SectionedValue ProfileParameters::*member) {
    return [member](const M& m) { return (m.values.*member).value; };
  };
  const auto u = [](SectionedValue ProfileParameters::*member) {
    return [member](const M& m) { return (m.values.*member).u; };
  };
  const auto of = [](auto ProfileParameters::*member) {
    return [member](const M& m) { return m.values.*member; };
  };
  const auto core = [](double CoreOfCurve::*member) {
    return [member](const M& m) { return m.values.core.*member; };
  };
  using P = ProfileParameters;
  using C = CoreOfCurve;
  const Dimension length = dimension::length;
  std::vector<RecordField<M>> fields{
      {"Ra", sectioned(&P::Ra), length, "mean magnitude about the mean line, over the evaluation length"},
      {"Rq", sectioned(&P::Rq), length, "root mean square about the mean line, over the evaluation length"},
      {"Rsk", of(&P::Rsk), "skewness of the heights"},
      {"Rku", of(&P::Rku), "kurtosis of the heights"},
      {"Rp", sectioned(&P::Rp), length, "greatest height above the mean line, mean over the sections"},
      {"Rv", sectioned(&P::Rv), length, "greatest depth below it, mean over the sections"},
      {"Rz", sectioned(&P::Rz), length, "Rp + Rv"},
      {"Rt", of(&P::Rt), length, "highest less lowest point of the evaluation length"},
      {"Rpt", of(&P::Rpt), length, "greatest of the sections' heights"},
      {"Rvt", of(&P::Rvt), length, "greatest of the sections' depths"},
      {"Rzx", of(&P::Rzx), length, "greatest height within a section moved sample by sample"},
      {"Rdq", of(&P::Rdq), "root mean square slope by the rule of seven samples, three dropped at each end"},
      {"Rdq_edges", of(&P::Rdq_edges), "root mean square slope by forward differences"},
      {"Rda", of(&P::Rda), "mean magnitude of the slope, by forward differences"},
      {"Rdr", of(&P::Rdr), "developed length over length, less 1, by forward differences"},
      {"Rsm", of(&P::Rsm), length,
       "mean width of the elements by crossings of the mean line; nil where none is whole"},
      {"Rc", of(&P::Rc), length, "mean height of the elements; nil where none is whole"},
      {"elements", of(&P::elements), "how many, of the passes from the left and from the right"},
      {"Rk", core(&C::Sk), length,
       "core height: the fall of the least-squares line of the material ratio curve over its flattest 40 %"},
      {"Rpk", core(&C::Spk), length, "reduced peak height"},
      {"Rvk", core(&C::Svk), length, "reduced dale depth"},
      {"Rmrk1", core(&C::Smr1), "material ratio at the upper end of the core, 0 to 1"},
      {"Rmrk2", core(&C::Smr2), "material ratio at the lower end of the core, 0 to 1"},
      {"Rpkx", core(&C::Spkx), length, "from the core to the highest point"},
      {"Rvkx", core(&C::Svkx), length, "from the core to the lowest point"},
      {"Rdc", of(&P::Rdc), length, "height between the material ratios 2.5 % and 50 %"},
      {"u_Ra", u(&P::Ra), length,
       "standard uncertainty of Ra from its scatter over the sections; nil of one section"},
      {"u_Rq", u(&P::Rq), length, "the same of Rq"},
      {"u_Rz", u(&P::Rz), length, "the same of Rz; with five sections 95 % lie within 2.78 of it"},
      {"sections", [](const M& m) { return m.prepared.sections; }, "that entered"},
      {"section", &M::section, length,
       kind == 'R' ? "length of each, and nesting index of the L-filter" : "length of each"},
      {"measured", of(&P::measured), "samples that were measured"},
      {"profile", "Profile", [](const M& m) { return Value(object(m.prepared.profile)); },
       kind == 'R' ? "the roughness profile" : "the primary profile, as it was evaluated"}};
  for (RecordField<M>& field : fields) {
    field.info.name = named_of(kind, field.info.name);
    field.info.sentence = named_of(kind, field.info.sentence);
  }
  return fields;
}

const RecordType<MeasuredProfile> profile_parameters_type{
    "ProfileParameters", "profile parameters",
    "The parameters of ISO 21920-2 of a trace after F-operation, S- and L-filter, half a section cut off at "
    "either end.",
    fields_of('R')};

const RecordType<MeasuredProfile> primary_parameters_type{
    "PrimaryParameters", "primary parameters",
    "The P parameters of ISO 21920-2 of a trace after F-operation and S-filter, with its long waves.",
    fields_of('P')};

void warn_of_coarse_samples(Call& call, const Profile& trace, const std::optional<double>& S) {
  if (S && trace.spacing() > *S / 5 * (1 + 1e-9))
    call.warn("samples are " + metres(trace.spacing()) +
              " apart, more than a fifth of the nesting index S, " + metres(*S));
}

Values profile_parameters_of(Call& call) {
  const ProfileParameterKeys keys = call.options(profile_parameters_block);
  if (keys.section.has_value() == keys.setting.has_value())
    refuse(keys.section ? "both `section` and `class` are given" : "neither `section` nor `class` is given",
           "give the length of a section, as in `section=\"0.8 mm\"`, or a class, `class=\"Sc3\"`" +
               std::string(keys.section ? "" : "; `primary_parameters` takes no long waves away"));
  ProfilePreparation preparation;
  if (keys.setting) {
    const auto named = setting_class(*keys.setting);
    if (!named)
      refuse_name("there is no setting class " + quoted(*keys.setting),
                  "ISO 21920-3 has Sc1, Sc2, Sc3, Sc4 and Sc5, of sections 0.08, 0.25, 0.8, 2.5 and 8 mm");
    preparation = *named;
  } else {
    preparation.section = *keys.section;
  }
  preparation.F = keys.F;
  if (keys.S) preparation.S = keys.S;
  preparation.sections = keys.sections;
  const Profile& trace = call.self<Profile>();
  PreparedProfile prepared = prepared_profile(trace, preparation);
  if (prepared.sections < keys.sections)
    call.warn("the trace holds " + std::to_string(prepared.sections) +
              " sections once its ends are cut, not " + std::to_string(keys.sections));
  warn_of_coarse_samples(call, trace, preparation.S);
  ProfileParameters values =
      profile_parameters(prepared.profile, {.sections = prepared.sections, .threshold = keys.threshold});
  return {profile_parameters_type({std::move(values), std::move(prepared), preparation.section})};
}

Values primary_parameters_of(Call& call) {
  const PrimaryParameterKeys keys = call.options(primary_parameters_block);
  const Profile& trace = call.self<Profile>();
  Profile profile = primary_profile(trace, keys.F, keys.S);
  warn_of_coarse_samples(call, trace, keys.S);
  ProfileParameters values =
      profile_parameters(profile, {.sections = keys.sections, .threshold = keys.threshold});
  const double section = profile.length() / keys.sections;
  return {primary_parameters_type({std::move(values), {std::move(profile), keys.sections}, section})};
}

}  // namespace

std::vector<Function> profile_parameter_methods() {
  return {
      {.name = "profile_parameters",
       .body = profile_parameters_of,
       .sentence = "The parameters of ISO 21920-2: the trace is filtered, half a section cut off at either "
                   "end, and the rest evaluated in sections. Neither section nor class is guessed.",
       .options = &profile_parameters_block,
       .returns = "ProfileParameters",
       .example = "print(p:profile_parameters{ section=\"0.1 mm\", F=1 }.Rz)"},
      {.name = "primary_parameters",
       .body = primary_parameters_of,
       .sentence = "The P parameters of ISO 21920-2 (Pa, Pq, Pz, Pt, …): of the trace as it was measured, "
                   "over its whole length, without an L-filter. A tilt left in dominates them: `F=1`.",
       .options = optional(primary_parameters_block),
       .returns = "PrimaryParameters",
       .example = "print(p:primary_parameters{ F=1 }.Pq)"},
      {.name = "bearing",
       .body = method([](const Profile& p) { return MaterialRatioCurve(p.measured_heights()); }),
       .sentence = "The material ratio curve (Abbott-Firestone) of the measured heights, exact and not "
                   "binned: Rmr(c) is its ratio(c), Rmc(p) its height(p).",
       .returns = "MaterialRatioCurve",
       .example = "print(p:bearing():ratio(0))"}};
}

std::vector<const RecordInfo*> profile_parameter_results() {
  return {&profile_parameters_type, &primary_parameters_type};
}

}  // namespace asperity::lua
