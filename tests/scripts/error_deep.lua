-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
--! error: stack overflow
local function deeper() return 1 + deeper() end
deeper()
