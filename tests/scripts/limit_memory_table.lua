-- SPDX-License-Identifier: GPL-3.0-or-later
-- The line that ran, with a traceback.
--! flags: --limit-memory 64M --trace
--! exit: 1
--! error: limit_memory_table.lua:8: not enough memory
--! error: limit_memory_table.lua:8: in main chunk
local t = {}
while true do t[#t + 1] = { #t } end
