-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --trace
--! exit: 1
--! error: error_in_coroutine.lua:10: attempt to index a nil value (local 'missing')
--! error: error_in_coroutine.lua:11: in main chunk
--! not error: error_in_coroutine.lua:11: /
--! not error: sandbox
local steps = coroutine.wrap(function()
  local missing
  coroutine.yield(missing.field) end)
steps()
