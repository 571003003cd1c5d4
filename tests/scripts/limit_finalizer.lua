-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --limit-time 500ms
--! exit: 1
--! error: the time limit
setmetatable({}, { __gc=function() while true do end end })
collectgarbage()
