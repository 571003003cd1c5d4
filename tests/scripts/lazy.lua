-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a script does not read of a state is not computed, and the ledger tells when it is. After c:close() what was
-- read stays, and reading anything else is an error that says so.
local lab = require "asperity"
local unit = lab.material{ young=1, poisson=0.3, hardness=0.05 }
local function rough(seed)
  return lab.surface.self_affine{ cells=128, size=1, hurst=0.8, rms_slope=0.1, short_wave=1 / 16, seed=seed,
    material=unit }
end
local function bench()
  return lab.contact{ lower=rough(1), upper=rough(2), boundary="periodic",
    effects={ elasticity="half_space", plasticity={} } }
end
local function calls()
  local lines = {}
  for _, line in ipairs(lab.ledger().calls) do lines[line.call] = line end
  return lines
end

-- Results of the solve itself cost no transform to read.
local c = bench()
local st = c:press{ pressure=0.01 }
local before = lab.ledger().transforms
assert(st.cost.transforms > 0 and before >= st.cost.transforms)
local _ = st.area_fraction + st.approach + st.peak_pressure + st.nodes_in_contact + st.residual + st.mean_gap + st.energy
  + st.spots + st.plastic_volume
assert(lab.ledger().transforms == before)

-- A stiffness takes a linear solve: when it is first read, and not again.
assert(calls()["State.stiffness"] == nil)
local stiffness = st.stiffness
local after = lab.ledger().transforms
assert(after > before and calls()["State.stiffness"].times == 1)
assert(st.stiffness == stiffness and lab.ledger().transforms == after)
-- The error bounds do the same.
local bound = st.error.algebraic.approach
local bounded = lab.ledger().transforms
assert(bounded > after and st.error.algebraic.approach == bound and lab.ledger().transforms == bounded)
-- The press's own cost excludes them.
assert(st.cost.transforms <= before)

-- After `close` the contact is gone. A state retains the values already read and the results of the solve itself.
local readers = {
  mean_gap=function(s) return s.mean_gap end, energy=function(s) return s.energy end,
  stiffness=function(s) return s.stiffness end, spots=function(s) return s.spots end,
  spots8=function(s) return s.spots8 end, area=function(s) return s.corrected_area_fraction end,
  largest=function(s) return s:spot_areas()[1] end, volume=function(s) return s.plastic_volume end,
  bound=function(s) return s.error.algebraic.approach end,
  pressure=function(s) return s:field "pressure":value(5, 7) end, gap=function(s) return s:field "gap".max end,
  contact=function(s) return s:field "contact".mean end, plastic=function(s) return s:field "plastic".max end,
  displacement=function(s) return s:field "displacement".min end,
  density=function(s) return s:distribution("gap").mean end,
}
local computed = {
  lower=function(s) return s:deformed "lower".digest end, upper=function(s) return s:deformed "upper".digest end,
  mu=function(s) return lab.friction{ tau0=0.01, alpha=0.2 }:on(s).mu end,
}
local known = {
  load=function(s) return s.load end, approach=function(s) return s.approach end,
  fraction=function(s) return s.area_fraction end, peak=function(s) return s.peak_pressure end,
  digest=function(s) return s.digest end, residual=function(s) return s.residual end,
  solver=function(s) return s.solver end,
  yielded=function(s) return s.plastic_fraction end,
}
local function unread(read, s, name)
  local ok, message = pcall(read, s)
  assert(not ok, name .. " was read of a state whose contact was closed")
  assert(message:find("was not read before the contact was closed", 1, true), name .. ": " .. message)
end
local open = bench()
local kept = open:press{ pressure=0.01 }
for _, list in ipairs{ readers, computed } do
  for name, read in lab.sorted(list) do
    local closing = bench()
    local orphan = closing:press{ pressure=0.01 }
    closing:close()
    local ok, message = pcall(function() return closing:press{ pressure=0.02 } end)
    assert(not ok and message:find("a contact was used after it was closed", 1, true), message)
    unread(read, orphan, name)
    for fact, known_read in lab.sorted(known) do assert(known_read(orphan) == known_read(kept), fact) end
    assert(tostring(orphan):find("since closed", 1, true))
  end
end
for name, read in lab.sorted(readers) do
  local closing = bench()
  local orphan = closing:press{ pressure=0.01 }
  local value = read(orphan)
  closing:close()
  assert(read(orphan) == value and value == read(kept), name)
end
-- A copy is closed by itself, and <close> closes as close() does.
local original = bench()
local first = original:press{ pressure=0.01 }
original:copy():close()
assert(first.energy == kept.energy)
local after_block
do
  local closing <close> = bench()
  after_block = closing:press{ pressure=0.01 }
end
unread(readers.energy, after_block, "energy")
