-- SPDX-License-Identifier: GPL-3.0-or-later
-- Formerly silent mistakes: each is a warning at its line.
--! error: silent_mistakes.lua:17: lab.friction: `tau_max` of 100 MPa is below `tau0` of 500 MPa
--! error: silent_mistakes.lua:23: cropped: `size` is not a whole number of cells, so the part is 9.375 um x 9.375 um
--! error: silent_mistakes.lua:30: `run` changes `n`, and each case has its own copy; return the value and use the rows
--! error: silent_mistakes.lua:30: `run` changes `list`, and each case has its own copy
--! error: the curve is farther from the points than their mean is (R² = -2.83
--! error: silent_mistakes.lua:46: protocol:on does nothing without a loop
--! not error: lua:19
--! not error: lua:24
--! not error: `total`
--! not error: `cached`
--! not error: `given`
local lab = require "asperity"

-- A cap below the capped strength.
lab.friction{ tau0="500 MPa", alpha=0.2,
  tau_max="100 MPa" }
lab.friction{ tau0="500 MPa", alpha=0.2, tau_max="500 MPa" } lab.friction{ tau0="500 MPa", alpha=0, yield_pressure="1 MPa" }

-- Parts of a surface.
local s = lab.surface.sine{ cells=32, size="100 um", amplitude="1 um" }
s:cropped{ size="10 um" }
s:cropped{ size="12.5 um" } s:cropped{ size={ "3.125 um", "100 um" } } s:cropped{ cells=3 }

-- Ensembles.
local n, list, cached, given, total = 0, {}, nil, { 1, 2, 3 }, 7
local function count() return total end
local rows = lab.ensemble{ over={ seed={ 1, 2, 3 } },
  run=function(case)
    n = n + 1
    list[#list + 1] = case.seed
    cached = cached or { case.seed }
    local all = total + given[case.seed] + cached[1]
    return { all=all, count=count() }
  end }
assert(#rows == 3 and n == 0 and #list == 0)

-- A fit worse than the mean of the points.
local t = lab.table.from{ { x=1, y=2.1 }, { x=2, y=3.9 }, { x=3, y=6.2 }, { x=4, y=7.9 } }
local fit = t:fit{ x="x", y="y", model=function(q, row) return q.a / row.x end, start={ a=1 } }
assert(fit.r_squared < 0 and #fit.warnings == 1)
assert(#t:fit{ x="x", y="y", model="linear" }.warnings == 0)

-- An iterator without a loop.
lab.protocol{ { release=true } }:on(lab.contact{ lower=s, upper=lab.material "Al-2011", effects={ elasticity={ model="box", stiffness="1 GPa/um" } } })

-- Materials by name.
assert(lab.materials.steel == lab.material "steel" and #lab.materials > 0)
for k, material in ipairs(lab.materials) do assert(lab.materials[material.name] == material and lab.materials[k]) end
local ok, message = pcall(function() return lab.materials.stel end)
assert(not ok and message:find "silent_mistakes.lua:%d+: .*did you mean `steel`%?", message)
