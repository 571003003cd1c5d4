-- SPDX-License-Identifier: GPL-3.0-or-later
-- Rigid bodies and boxes that yield: the load must rest on load/hardness of the tile, to the last node.
--
-- A rigid element carries nothing until it touches, and then its full hardness. The load is a step function
-- of depth: no depth gives a load between two steps. The least loaded node carries the remainder. Nearly
-- rigid elastic elements are as bad: their pressure passes from 0 to the hardness between two neighbouring
-- doubles.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 24, title = "Bodies that only yield", edge = "stiffness from 1e-6 of hardness/height to"
    .. " infinite, hardness and heights over 30 decades; loads from 1e-12 of the hardness to its last"
    .. " double; equal heights; repeated events",
  elsewhere = "Newton's method or bisection searches for a depth with the right load. A step function has"
    .. " no such depth, and the search cycles for ever or ends on a step with another load.",
  here = "Bisection finds the two neighbouring depths that bracket the load, and the pressures at both are"
    .. " mixed. The load is right to rounding for any stiffness.",
}
local cells = 32
local nodes = cells * cells
local function rough(height) return lab.surface.self_affine{ cells = cells, size = 1, hurst = 0.8, rms_height = height, short_wave = 0.1,
  seed = 3 } end
local book = lab.notebook "staircase"
for _, height in ipairs{ 1e-15, 1, 1e15 } do
  for _, hardness in ipairs{ 1e-15, 1, 1e15 } do
    for _, stiffness in ipairs{ 1e-6, 1, 1e15, math.huge } do
      local elasticity = stiffness == math.huge and "rigid"
        or { model = "box", stiffness = stiffness * hardness / height }
      local c = lab.contact{ lower = rough(height), upper = lab.rigid, effects = { elasticity = elasticity,
        plasticity = { hardness = hardness } } }
      local off, residual, wrong = 0, 0, 0
      for _, share in ipairs{ 1e-12, 1e-6, 0.5 / nodes, 1 / nodes, 0.01, 0.3, 1 - 1e-9, 1 - 2 ^ -53 } do
        local st = c:copy():press{ pressure = share * hardness }
        local sum = st:field "pressure".mean
        off = math.max(off, math.abs(sum / (share * hardness) - 1))
        residual = math.max(residual, st.residual)
        if stiffness == math.huge and st.nodes_in_contact ~= math.ceil(share * nodes * (1 - 1e-12)) then wrong = wrong + 1 end
      end
      book:write{ height = height, hardness = hardness, stiffness = tostring(stiffness), load = off,
        certificate = residual, wrong = wrong }
    end
  end
end
case:evidence(book, "Eight loads each on 32 x 32 nodes: largest error of the load and largest certificate."
  .. " Wrong counts are loads on rigid bodies that do not rest on load/hardness of the nodes, rounded up.",
  { { "height", "%.0e", "rms height, m" }, { "hardness", "%.0e", "hardness, Pa" },
  { "stiffness", "%s", "stiffness, hardness/height" }, { "load", "%.0e", "error of the load" }, { "certificate", "%.0e" },
  { "wrong", "%d", "wrong counts" } })
case:expect(book, "load", { at_most = 2e-14 }) -- measured 2e-15
case:expect(book, "certificate", { at_most = 1e-9 }) -- measured 1.2e-10, rounding of a million heights
case:expect(book, "wrong", { at_most = 0 })

-- A hundred repeats of an event add no plastic volume.
local again = lab.notebook "again"
for _, model in ipairs{ "rigid", "box" } do
  for _, hardening in ipairs{ math.huge, 10 } do
    local c = lab.contact{ lower = rough(1), upper = lab.rigid, effects = {
      elasticity = model == "box" and { model = "box", stiffness = 2 } or "rigid",
      plasticity = { hardness = 1, hardening = hardening } } }
    local first = c:press{ pressure = 0.1 }.plastic_volume
    local more, contacts = 0, 0
    for _ = 1, 100 do
      c:release()
      local st = c:press{ pressure = 0.1 }
      more, contacts = more + st.plastic_volume, st.nodes_in_contact
    end
    again:write{ model = model, hardening = tostring(hardening), first = first, more = more, contacts = contacts }
  end
end
case:evidence(again, "Plastic volume of one event and of a hundred repeats.", { { "model", "%s" },
  { "hardening", "%s", "hardening, Pa/m" }, { "first", "%.6f", "first event, m^3" },
  { "more", "%.0e", "a hundred repeats, m^3" }, { "contacts", "%d", "nodes" } })
case:expect(again, "more", { at_most = 0 })

local flat = lab.surface.flat{ cells = 4, size = 1 }
local st = lab.contact{ lower = flat, upper = lab.rigid, effects = { elasticity = "rigid",
  plasticity = { hardness = 1 } } }:press{ pressure = 0.25 }
local equal = lab.notebook "equal"
equal:write{ contacts = st.nodes_in_contact, peak = st.peak_pressure }
case:expect(equal, "contacts", { at_least = 16 })
case:expect(equal, "peak", { near = 0.25, within = 1e-16 })
local function pressed(options) return function()
  lab.contact{ lower = rough(1), upper = lab.rigid, effects = { elasticity = "rigid",
    plasticity = { hardness = 1 } } }:press(options)
end end
case:refused("a pressure equal to the hardness", pressed{ pressure = 1 }, "cannot be carried", "`hardness`")
case:refused("a pressure of 1e-281 of the hardness", pressed{ pressure = 1e-281 }, "too small to mean anything")
case:refused("an approach of 1e200 m", pressed{ approach = 1e200 }, "range of a double")
case:refused("rigid bodies without plasticity", function()
  lab.contact{ lower = rough(1), upper = lab.rigid, effects = { elasticity = "rigid" } }
end, "does not name `plasticity`")
case:finish{ worst = "1e-15 of the load", verdict = "right answer" }
