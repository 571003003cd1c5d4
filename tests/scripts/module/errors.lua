-- SPDX-License-Identifier: GPL-3.0-or-later
-- The module in an interpreter of the C build of Lua: the same texts, and recovery through pcall and
-- coroutines, where an error leaves by a long jump.
local lab = require "asperity"
assert(require "asperity" == lab and type(lab) == "table")
local function message_of(call) return select(2, pcall(call)) end
local function expect(call, text)
  local message = message_of(call)
  assert(tostring(message):find(text, 1, true), tostring(message) .. "\n  does not hold: " .. text)
end

expect(function() lab.surface.flat{ cell=8, cells=8, size=1 } end,
  "errors.lua:12: lab.surface.flat: unknown key `cell` (did you mean `cells`?)")
expect(function() lab.surface.flat{ cells=8, size="1 kg" } end, "a mass where a length is wanted")
expect(function() lab.surfac() end, "lab has no field `surfac` (did you mean `surface`?)")
expect(function() lab.surface.read "nothere.x3p" end, 'there is no file "nothere.x3p"')
local s = lab.surface.sine{ cells=64, size="1 mm", amplitude="1 um", material=lab.material "steel" }
expect(function() return s.cell end, "a surface has no field `cell` (did you mean `cells`?)")
expect(function() s:height(64, 0) end, "there is no node (64, 0)")
expect(function() s.cells = 3 end, "a surface cannot be changed")
expect(function() return s:roughness().Raa end, "a roughness result has no field `Raa`")
expect(function() lab.surface.from_function{ cells=4, size=1, height=function() error "no height" end } end, "no height")
expect(function() lab.surface.from_function{ cells=4, size=1, height=function() error{} end } end, "an empty table")
expect(function() lab.surface.from_function{ cells=4, size=1, height=function() coroutine.yield() end } end, "yield")
expect(coroutine.wrap(function() lab.material "stel" end), "did you mean `steel`?")

-- Many errors from frames with large values: they must neither leak nor crash.
for k = 1, 300 do
  pcall(lab.surface.from_function, { cells=128, size=1, height=function(_, y) if y > 0.3 then error(k) end return 0 end })
  pcall(coroutine.wrap(function() lab.contact{ lower=s, upper=s, effects={ elasticity="none" } } end))
end
local deep = select(2, pcall(function()
  local function deeper() return lab.surface.from_function{ cells=1, size=1, height=function() deeper() return 0 end } end
  deeper()
end))
assert(deep:find "stack overflow", deep)

-- In an unfinished coroutine.
local co = coroutine.create(function()
  local kept <close> = s:mirrored()
  for st in lab.contact{ lower=kept, upper=lab.rigid, effects={ elasticity="box" } }:sweep{ pressure={ 1e6, 2e6 } } do
    coroutine.yield(st.area)
  end
end)
assert(select(2, coroutine.resume(co)) > 0)
assert(coroutine.close(co))
co = nil
collectgarbage()
