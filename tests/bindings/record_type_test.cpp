// SPDX-License-Identifier: GPL-3.0-or-later
// Functions name their record types, whose fields help, completion, reference, editor types and dry run
// know.
#include "bindings/lua/registry/record_type.hpp"

#include <algorithm>
#include <set>

#include "bindings/lua/editor/completion.hpp"
#include "bindings/lua/editor/help.hpp"
#include "bindings/lua/registry/record.hpp"
#include "engine/core/error.hpp"
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::record_type_test {
namespace {

using RecordTypes = LuaTest;

struct Written {
  std::string giver, type;
};
std::vector<Written> written_types() {
  std::vector<Written> all;
  const auto functions = [&](const std::vector<Function>& of) {
    for (const Function& f : of) all.push_back({qualified_name(f), f.returns});
  };
  const auto fields = [&](const std::string& owner, const std::vector<Getter>& of) {
    for (const Getter& field : of) all.push_back({owner + "." + field.name, field.type});
  };
  for (const Module* module : modules()) functions(module->functions);
  for (const Class* type : classes()) functions(type->methods), fields(type->name, type->fields);
  for (const RecordInfo* type : record_types()) fields(type->name, type->fields);
  return all;
}

std::vector<std::string> offered(const std::string& script, const std::vector<LiveGlobal>& live = {}) {
  std::vector<std::string> names;
  for (const Candidate& c : complete(script, script.size(), live).candidates) names.push_back(c.text);
  return names;
}

TEST_F(RecordTypes, AreNamedByAllThatGivesThem) {
  // The script names the columns of these tables.
  const std::set<std::string> open = {"lab.ensemble", "notebook:rows", "notebook:each",    "table:rows",
                                      "table:each",   "study:rows",    "StudyChoice.knobs"};
  std::set<std::string> named;
  for (const auto& [giver, type] : written_types()) {
    const bool table = type.find("table") != std::string::npos && type.find("table<") == std::string::npos;
    EXPECT_EQ(table, open.contains(giver)) << giver << ": " << type;
    for (const RecordInfo* record : record_types_in(type)) named.insert(record->name);
    for (std::size_t at = 0; at < type.size(); ++at) {
      const bool begins = std::isupper(static_cast<unsigned char>(type[at])) != 0 &&
                          (at == 0 || std::isalnum(static_cast<unsigned char>(type[at - 1])) == 0);
      if (!begins || type.find('"') != std::string::npos) continue;
      const std::size_t end = std::min(type.find_first_of("[]?> ,", at), type.size());
      const std::string name = type.substr(at, end - at);
      EXPECT_TRUE(find_class(name) != nullptr || find_record_type(name) != nullptr) << giver << ": " << type;
    }
  }
  for (const RecordInfo* type : record_types()) {
    EXPECT_TRUE(named.contains(type->name)) << type->name << " is given by nothing";
    EXPECT_EQ(find_record_type(type->name), type) << type->name << " is the name of two types";
    EXPECT_EQ(find_class(type->name), nullptr) << type->name;
  }
}

TEST_F(RecordTypes, AreToldWithEachFieldByHelpReferenceTypesAndCompletion) {
  const std::string page = reference_page(), types = editor_types();
  ASSERT_GT(record_types().size(), 20u);
  for (const RecordInfo* type : record_types()) {
    EXPECT_FALSE(type->sentence.empty() || type->title.empty() || type->fields.empty()) << type->name;
    const std::string help = help_text(type->name);
    const std::size_t section = page.find("### " + type->name + "\n");
    const std::size_t declared = types.find("---@class asperity." + type->name + "\n");
    ASSERT_NE(section, std::string::npos) << type->name;
    ASSERT_NE(declared, std::string::npos) << type->name;
    const std::string table = page.substr(section, page.find("\n#", section + 1) - section);
    const std::string lines = types.substr(declared, types.find("\n\n", declared) - declared);
    const std::vector<std::string> names = offered("r.", {{"r", type->name}});
    EXPECT_EQ(names.size(), type->fields.size()) << type->name;
    for (const Getter& field : type->fields) {
      const std::string of = type->name + "." + field.name;
      EXPECT_FALSE(field.sentence.empty()) << of;
      EXPECT_NE(help.find("  " + field.name + " "), std::string::npos) << of;
      EXPECT_NE(help.find(field.sentence), std::string::npos) << of;
      EXPECT_NE(help_text(of).find(field.sentence), std::string::npos) << of;
      EXPECT_NE(table.find("| `" + field.name + "` | "), std::string::npos) << of;
      EXPECT_NE(lines.find("---@field " + field.name + " "), std::string::npos) << of;
      EXPECT_NE(std::find(names.begin(), names.end(), field.name), names.end()) << of;
    }
  }
}

TEST_F(RecordTypes, HelpOnWhatGivesThemListsTheirFields) {
  EXPECT_NE(help_text("surface:roughness").find("  Sq         Rq by its areal name (number, m)"),
            std::string::npos)
      << help_text("surface:roughness");
  EXPECT_NE(help_text("tiltStage:raise").find("TiltTrial: "), std::string::npos);
  EXPECT_NE(help_text("State.cost").find("seconds"), std::string::npos);
  EXPECT_NE(help_text("law:on").find("needs interlocking"), std::string::npos);
  EXPECT_NE(help_text("probe_spread").find("Tilt.probe_spread, of tiltStage:raise: "), std::string::npos);
}

TEST_F(RecordTypes, CompletionFollowsCallsAndFields) {
  using Names = std::vector<std::string>;
  const std::string s = "local lab = require \"asperity\"\nlocal s = lab.surface.flat{ cells=4, size=1 }\n";
  EXPECT_EQ(offered(s + "s:roughness().Sd"), Names{"Sdq"});
  EXPECT_EQ(offered(s + "s:profile{ row=0 }:roughness().Sd"), Names{});
  EXPECT_EQ(offered(s + "local r = s:spectrum{} print(r.rms_h"), Names{"rms_height"});
  const std::string stage = "local stage = lab.tilt_stage{}\n";
  EXPECT_EQ(offered(stage + "for _, t in ipairs(stage:raise{}.trials) do t.hel"), Names{"held"});
  EXPECT_EQ(offered(stage + "stage:raise{}.probes[1].area"), Names{"area_per_load"});
  const std::string traces = "local traces = lab.stylus{}:scan(s)\n";
  EXPECT_EQ(offered(traces + "traces.tip_effect.mean"), Names{"mean_lift"});
  EXPECT_EQ(offered(traces + "traces.li"), Names{"lines"});
  EXPECT_EQ(offered(traces + "traces[1]:roughn"), Names{"roughness"});
  const std::string press = "local st = lab.contact{}:press{}\n";
  EXPECT_EQ(offered(press + "st.cost.by_effect.creep.sec"), Names{"seconds"});
  EXPECT_EQ(offered(press + "for name, of in pairs(st.cost.by_effect) do of.tra"), Names{"transforms"});
  EXPECT_EQ(offered("for event, st in lab.protocol{}:on(c) do event.dw"), Names{"dwell"});
  const Completion mu = complete("lab.friction{}:on(st).mu", 24, {});
  ASSERT_EQ(mu.candidates.size(), 1u);
  EXPECT_EQ(mu.candidates[0].detail, "number?");
  EXPECT_EQ(mu.candidates[0].help, "force over the applied load; nil without load");
}

TEST_F(RecordTypes, ReadEachFieldOfARecordAsDescribed) {
  ASSERT_EQ(
      run(example_preamble() +
          "values = { State=st, AlgebraicError=st.error.algebraic, Shear=q, "
          "Plan=c:explain(), contact=c, Ledger=lab.ledger(), Protocol=protocol, SpreadState=under, "
          "Calibration=lab.calibrate{ model=function(q) return q.mu end, data=t, y='mu', "
          "parameters={ mu=0.3 } }, "
          "Budget=lab.budget{ ask=function(x) return x.k end, replicate={ k={ 1, 2, 3, 4, 5 } }, "
          "half_width=1 }, "
          "Sensitivity=lab.sensitivity{ ask=function(x) return x.k end, inputs={ k={ value=1, u=0.1 } } } }"),
      "");
  std::size_t read = 0;
  for (const Class* type : classes())
    for (const Getter& field : type->fields)
      if (!record_types_in(field.type).empty()) {
        EXPECT_EQ(run("local value = values." + type->name + "." + field.name), "") << type->name;
        ++read;
      }
  EXPECT_GE(read, 10u);
  EXPECT_TRUE(holds("values.State.cost.by_effect.elasticity.seconds >= 0"));
  // No function returns the events of a loop.
  ASSERT_EQ(run("for event in values.Protocol:on(values.contact) do last = event end"), "");
  lua_getglobal(L, "last");
  const std::shared_ptr<Record> event = record_at(L, -1);
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->type, find_record_type("ProtocolEvent"));
  ASSERT_EQ(event->entries.size(), event->type->fields.size());
  for (std::size_t k = 0; k < event->entries.size(); ++k)
    EXPECT_EQ(event->entries[k].field, event->type->fields[k].name);
}

TEST_F(RecordTypes, ARecordOfAnotherTypeThanWasDeclaredIsAnError) {
  const Record cost = cost_type()(Cost{1, 2, 3});
  EXPECT_NO_THROW(check_declared("f", "Cost", cost));
  EXPECT_NO_THROW(check_declared("f", "Cost?", cost));
  EXPECT_NO_THROW(check_declared("f", "Cost?", Value()));
  EXPECT_NO_THROW(check_declared("f", "Cost[]", List({cost})));
  EXPECT_NO_THROW(check_declared("f", "table<string, Cost>", cost_by_effect({{"creep", Cost{}}})));
  EXPECT_THROW(check_declared("f", "table", cost), Error);
  EXPECT_THROW(check_declared("f", "Roughness", cost), Error);
  EXPECT_THROW(check_declared("f", "table[]", List({cost})), Error);
  EXPECT_THROW(check_declared("f", "Cost", Record{"cost", {}}), Error);
  EXPECT_THROW(check_declared("f", "table<string, Roughness>", cost_by_effect({{"creep", Cost{}}})), Error);
  List lines({Value(1.0)});
  lines.named.emplace_back("tip", List({cost}));
  EXPECT_NO_THROW(check_declared("f", "number[] with tip: Cost[]", lines));
  EXPECT_THROW(check_declared("f", "number[] with tip: Tilt[] and x: Cost", lines), Error);
}

TEST_F(RecordTypes, ADryRunFindsMisspeltFields) {
  open_dry();
  ASSERT_EQ(
      run("s = lab.surface.weierstrass_mandelbrot{ cells=16384, D=2.5, n_max=4000 }\n"
          "al = lab.material 'Al-2011'\n"
          "c = lab.contact{ lower=s:with{ material=al }, upper=lab.rigid, effects={ elasticity='box' } }\n"
          "st = c:press{ pressure='1 MPa' }\nlaw = lab.friction{ tau0='500 MPa', alpha=0.2 }\n"
          "stage = lab.tilt_stage{ contact=c, friction=law, mass='4 g' }"),
      "");
  EXPECT_EQ(run("print(s:roughness().Raa)")
                .rfind("script.lua:1: a roughness result has no field `Raa` (did you mean `Ra`?)", 0),
            0u);
  EXPECT_NE(run("print(law:on(st).my)").find("a friction result has no field `my` (did you mean `mu`?)"),
            std::string::npos);
  EXPECT_NE(run("print(st.certificate.tensoin)").find("(did you mean `tension`?)"), std::string::npos);
  EXPECT_NE(run("for event in lab.protocol{ { release=true } }:on(c) do print(event.knd) end")
                .find("(did you mean `kind`?)"),
            std::string::npos);
  EXPECT_NE(run("print(lab.stylus{}:scan(s).tip_effect.mean_lfit)").find("(did you mean `mean_lift`?)"),
            std::string::npos);
  // Accepted: fields of effects, any list index, optional numbers.
  EXPECT_EQ(run("local r = law:on(st) local x = r.mu + r.strengthening * r.interlocking_force\n"
                "local t = stage:raise{} x = t.trials[7].held / #t.probes\n"
                "x = st.cost.by_effect.estimate.seconds + s:spectrum().C[50]\n"
                "for name, v in pairs(t) do x = v end\n"
                "x = type(r) == 'userdata' and tostring(r) .. string.format('%s', r)\n"
                "lab.surface.flat(r) lab.notebook 'b':write{ r=r.mu }"),
            "");
}

}  // namespace
}  // namespace asperity::lua::record_type_test
