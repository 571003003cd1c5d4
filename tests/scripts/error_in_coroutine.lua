-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
--! error: attempt to index a nil value (local 'missing')
--! error: error_in_coroutine.lua:8: in main chunk
local steps = coroutine.wrap(function()
  local missing
  coroutine.yield(missing.field) end)
steps()
