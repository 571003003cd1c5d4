-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --limit-memory 64M
--! exit: 1
--! error: not enough memory
local t = {}
while true do t[#t + 1] = { #t } end
