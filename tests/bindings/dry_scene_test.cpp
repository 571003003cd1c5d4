// SPDX-License-Identifier: GPL-3.0-or-later
// Without making surfaces, the dry run refuses the same scenes as a run before its first solve, with the
// same messages.
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::dry_scene_test {
namespace {

class DryScene : public LuaTest {
 protected:
  // "" or the error message.
  std::string outcome(bool dry, const std::string& scene) {
    session.dry_run = dry;
    session.run.reset();
    std::filesystem::remove_all(folder / "run");
    open();
    EXPECT_EQ(run("al = lab.material 'Al-2011'\n"
                  "function rough(t)\n"
                  "  local keys = { cells=32, size='1 mm', hurst=0.8, ra='1 um', short_wave='100 um' }\n"
                  "  for key, value in pairs(t or {}) do keys[key] = value end\n"
                  "  return lab.surface.self_affine(keys)\nend\n"
                  "function contact(t) return lab.contact(t) end\n"),
              "");
    return run(scene);
  }
};

const char* const refused[] = {
    // Missing material.
    "contact{ lower=rough(), upper=lab.rigid, boundary='periodic', effects={ elasticity='half_space' } }",
    "contact{ lower=rough{ material=al }, upper=rough(), boundary='periodic', effects={ "
    "elasticity='half_space' } }",
    "contact{ lower=rough():scaled{ ra='2 um' }, upper=al, boundary='free', effects={ "
    "elasticity='half_space' } }",
    "contact{ lower=rough(), upper=lab.rigid, effects={ elasticity='box' } }",
    "contact{ lower=rough(), upper=lab.rigid, effects={ elasticity={ model='box', stiffness=1e12 }, "
    "plasticity={} } }",
    // Missing property of a material.
    "contact{ lower=rough{ material=lab.material{ young='1 GPa' } }, upper=lab.rigid, boundary='free', "
    "effects={ elasticity='half_space' } }",
    "contact{ lower=rough{ material=lab.material{ young='1 GPa', poisson=0.3 } }, upper=lab.rigid, "
    "boundary='free', effects={ elasticity='half_space', plasticity={} } }",
    "contact{ lower=rough{ material=lab.rigid }, upper=lab.rigid, boundary='free', effects={ "
    "elasticity='half_space' } }",
    // Conflicting keys.
    "contact{ lower=rough{ material=al }, upper=lab.rigid, effects={ elasticity='half_space' } }",
    "contact{ lower=rough{ material=al }, upper=lab.rigid, boundary='free', effects={ elasticity='rigid' } }",
    "contact{ lower=rough{ material=al }, upper=lab.rigid, boundary='free', effects={ "
    "elasticity='half_space', creep={} } }",
    "contact{ lower=rough{ material=al }, upper=lab.rigid, effects={ elasticity='box', adhesion={ "
    "work='1 mJ/m^2', range='1 nm' } } }",
    "contact{ lower=rough{ material=al }, upper=lab.rigid, effects={ elasticity='box', tangential={} } }",
    "contact{ lower=rough{ material=al }, upper=al, boundary='free', effects={ elasticity='half_space', "
    "interlocking={} } }",
    "contact{ lower=rough{ material=al }, upper=lab.rigid, effects={ elasticity='box' }, accuracy={ "
    "precision='single' } }",
    // Cells too coarse for the surface.
    "rough{ short_wave='40 um' }",
    "rough{ long_wave='3 mm' }",
    "lab.surface.sine{ cells=32, size='1 mm', amplitude='1 um', wavelength='50 um' }",
    "lab.surface.sphere{ cells=32, size='1 mm', radius='0.5 mm' }",
    "lab.surface.bead_blasted{ cells=32, size='1 mm', ra='1 um' }",
    "lab.surface.bead_blasted{ cells=128, size='1 mm', ra='1 um', fine={ hurst=0.8, roll_off='50 um', "
    "short_wave='2 um' } }",
    // Mismatched bodies.
    "contact{ lower=rough{ material=al }, upper=rough{ cells=64 }, effects={ elasticity='box' } }",
    "contact{ lower=rough{ material=al }, upper=rough{ size='2 mm', short_wave='200 um' }:mirrored(), "
    "effects={ "
    "elasticity='box' } }",
    "contact{ lower=rough{ material=al }, upper=lab.surface.flat{ cells=16, size='1 mm' }, effects={ "
    "elasticity='box' } }",
};

const char* const taken[] = {
    "contact{ lower=rough{ material=al }, upper=lab.rigid, boundary='periodic', effects={ "
    "elasticity='half_space' } }",
    "contact{ lower=rough():with{ material=al }, upper=lab.material 'quartz', boundary='free', effects={ "
    "elasticity='half_space', plasticity={}, creep={} } }",
    "contact{ lower=rough(), upper=rough(), effects={ elasticity={ model='box', stiffness='1 MPa/um' } } }",
    "contact{ lower=rough{ material=al }, upper=lab.rigid, effects={ elasticity='rigid', plasticity={ "
    "hardness='1 GPa' } } }",
    "contact{ lower=rough{ material=al }, upper=rough{ cells=64, material=al }:resampled{ cells=32 }, "
    "boundary='periodic', "
    "effects={ elasticity='half_space', adhesion={ work='1 mJ/m^2', range='1 um' } } }",
    "contact{ lower=rough{ material=al }, upper=lab.rigid, boundary='periodic', effects={ "
    "elasticity='half_space' }, accuracy={ estimate=true } }",
};

TEST_F(DryScene, RefusesWhatARunRefusesAndInTheSameWords) {
  for (const char* scene : refused) {
    const std::string in_run = outcome(false, scene);
    EXPECT_NE(in_run, "") << "a run takes " << scene;
    EXPECT_EQ(outcome(true, scene), in_run) << scene;
  }
}

TEST_F(DryScene, TakesWhatARunTakes) {
  for (const char* scene : taken) {
    EXPECT_EQ(outcome(false, scene), "") << scene;
    EXPECT_EQ(outcome(true, scene), "") << scene;
  }
}

TEST_F(DryScene, SaysNothingOfWhatItCannotKnow) {
  for (const char* scene :
       {"st = contact{ lower=rough{ material=al }, upper=lab.rigid, effects={ elasticity='box' } }:press{ "
        "pressure=1e6 }\n"
        "contact{ lower=rough{ material=lab.material{ young='1 GPa', poisson=0.3 } }, upper=lab.rigid, "
        "boundary='free', effects={ elasticity='half_space', plasticity={ hardness=st.peak_pressure } } }",
        "c = contact{ lower=rough{ material=al }, upper=lab.rigid, effects={ elasticity='box' } }\n"
        "contact{ lower=c:lower(), upper=lab.rigid, boundary='free', effects={ elasticity='half_space' } }"})
    EXPECT_EQ(outcome(true, scene), "") << scene;
}

}  // namespace
}  // namespace asperity::lua::dry_scene_test
