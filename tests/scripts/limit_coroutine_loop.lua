-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --limit-time 500ms
--! exit: 1
--! error: the time limit
local function forever() while true do end end
while true do pcall(coroutine.wrap(forever)) end
