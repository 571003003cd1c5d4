-- SPDX-License-Identifier: GPL-3.0-or-later
-- Assertions on errors. anywhere(call, ...): `call()` fails with a message that holds each of the given texts. at_its_line:
-- the message also begins with a line of the function `call`. Scripts load them by
-- `dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua")`.
local function anywhere(call, ...)
  local ok, message = pcall(call)
  assert(not ok, "this was accepted at line " .. debug.getinfo(call, "S").linedefined)
  message = tostring(message)
  for _, part in ipairs{ ... } do assert(message:find(part, 1, true), message .. "\n  does not hold: " .. part) end
  return message
end
local function at_its_line(call, ...)
  local here = debug.getinfo(call, "S")
  local message = anywhere(call, here.source:match "[^/@]*$" .. ":", ...)
  local line = tonumber(message:match "%.lua:(%d+): ")
  assert(line and line >= here.linedefined and line <= here.lastlinedefined, "no line " .. here.linedefined .. " in: " .. message)
end
-- The words first, and then the function with its arguments.
local function with(words, call, ...)
  local arguments = table.pack(...)
  return anywhere(function() return call(table.unpack(arguments, 1, arguments.n)) end, words)
end
return { anywhere=anywhere, at_its_line=at_its_line, with=with }
