-- SPDX-License-Identifier: GPL-3.0-or-later
-- Effects that this version does not compute: is a scene that names one refused, or computed without it?
--
-- No scene is pressed without an effect that it names: an unsupported effect is refused by name.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 22, title = "What is not computed",
  edge = "work of adhesion from 1e-30 to 1e30 J/m^2 on boxes and with plasticity, every named effect,"
    .. " boxes in single precision, any boundary",
  elsewhere = "An unknown or unsupported key is ignored: the run ends well, without the effect.",
  here = "Every unsupported effect is refused by name when the scene is made, before any press."
    .. " For a misspelt effect, the error names the nearest effect.",
}
local s = lab.surface.sphere{ cells = 16, size = 1, radius = 10, material = lab.material "Al-2011" }
local function scene(effects, boundary, accuracy)
  return function() lab.contact{ lower = s, upper = lab.rigid, boundary = boundary or "free",
    effects = effects, accuracy = accuracy } end
end
local refused, asked = 0, 0
for decade = -30, 30, 5 do
  for _, elasticity in ipairs{ "half_space", "box" } do
    for _, boundary in ipairs{ "free", "periodic" } do
      for _, model in ipairs{ "exponential", "dugdale" } do
        asked = asked + 1
        local ok, message = pcall(scene({ elasticity = elasticity,
          plasticity = elasticity == "half_space" and {} or nil,
          adhesion = { work = 10.0 ^ decade, range = 1e-9, model = model } }, boundary))
        if not ok and message:find("adhesion", 1, true) and message:find("not computed", 1,
          true) then refused = refused + 1 end
      end
    end
  end
end
local book = lab.notebook "adhesion"
book:write{ asked = asked, refused = refused, share = refused / asked }
case:evidence(book, "Scenes with adhesion: boxes and yielding half-spaces, both boundaries, both laws.",
  { { "asked", "%d", "scenes" }, { "refused", "%d" } })
case:expect(book, "share", { near = 1, within = 0 })
case:refused("adhesion of boxes", scene{ elasticity = "box", adhesion = { work = 0.05, range = 1e-9,
  model = "exponential" } }, "adhesion", "not computed")
case:refused("capillarity of boxes", scene{ elasticity = "box", capillarity = { humidity = 0.5 } },
  "capillarity", "not computed")
case:refused("rigid bodies that cannot yield", scene{ elasticity = "rigid" }, "`plasticity`")
case:refused("boxes in single precision", scene({ elasticity = "box" }, "periodic", { precision = "single" }),
  "single")
case:refused("`adhesoin`", scene{ elasticity = "half_space", adhesoin = {} }, "did you mean `adhesion`")
case:refused("a half-space without a boundary", function()
  lab.contact{ lower = s, upper = lab.rigid, effects = { elasticity = "half_space" } }
end, "`boundary`")
case:refused("a tolerance below the precision of a double", scene({ elasticity = "half_space" }, "periodic",
  { tolerance = 9e-16 }), "`tolerance`")
case:finish{ worst = "refused by name", verdict = "clear error" }
