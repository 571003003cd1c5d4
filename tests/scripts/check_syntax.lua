-- SPDX-License-Identifier: GPL-3.0-or-later
--! command: check
--! exit: 1
--! error: check_syntax.lua:5:
local x = = 3
