-- SPDX-License-Identifier: GPL-3.0-or-later
-- Lua's own functions over placeholders.
--! command: check
--! output: no problem found
--! not output: checked to line
local lab = require "asperity"
local s = lab.surface.sine{ cells=4096, size=1, amplitude="1 um" }
local v = s:roughness().Ra
local t = { v, 2, v }
local all = {
  v + 1, 1 - v, v * v, v / 2, v // 1, v % 2, v ^ 2, -v, v .. "x", "x" .. v, v & 1, v | 1, v ~ 1, ~v, v << 1, v >> 1, #s:heights(),
  v == 1, v ~= v, not v, math.sqrt(v), math.max(v, 1), math.floor(v), math.abs(v), math.log(v), math.tan(v), math.huge * v,
  string.format("%g", v), ("%d"):format(v), tostring(v), tonumber(v), table.concat(t, " "), table.unpack(t),
  select("#", v, v), select(2, 1, v), assert(v, "none"), rawequal(v, v), rawlen(t), next(t),
}
table.insert(t, v)
table.insert(t, 1, v)
table.remove(t)
t[v] = v
local copy = table.move(t, 1, #t, 1, {})
for k, x in ipairs(t) do local y = x * k end
for k, x in pairs(t) do local y = x end
for k, x in lab.sorted{ b=v, a=1 } do local y = x end
local total = 0
for i, row in ipairs(s:heights()) do for j, z in ipairs(row) do total = total + z end end
local co = coroutine.wrap(function(x) local y = coroutine.yield(x * 2) return y + v end)
co(v) co(v)
assert(pcall(function() return v + 1 end))
local kept <const> = v
local a, b = (function(...) return ... end)(v, v)
assert(v == 3 and #s:heights() == 4096, "what is asserted of a result is known in a run alone")
print(a + b, #all)
