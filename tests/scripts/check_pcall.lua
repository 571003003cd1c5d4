-- SPDX-License-Identifier: GPL-3.0-or-later
-- Errors caught by a script are notes, because a script may test a refusal. They are raised as in a run.
--! command: check
--! error: asperity: note:
--! error: check_pcall.lua:15: lab.surface.flat: `cells`
--! error: check_pcall.lua:16: lab.surface has no field `sin`
--! error: check_pcall.lua:17: a surface cannot be changed
--! not error: check_pcall.lua:18
--! output: no problem found
local lab = require "asperity"
local function refused(f, text)
  local ok, message = pcall(f)
  if ok or not message:find(text, 1, true) then error("not refused: " .. tostring(message)) end
end
refused(function() lab.surface.flat{ cells=0, size=1 } end, "`cells`")
refused(function() lab.surface.sin{ cells=8 } end, "did you mean `sine`?")
assert(not xpcall(function() lab.surface.flat{ cells=4, size=1 }.name = "mine" end, debug.traceback))
assert(pcall(lab.surface.flat, { cells=4, size=1 }))
