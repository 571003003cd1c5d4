-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
--! error: error_untraced.lua:7: lab.surface.flat: unknown key `cell` (did you mean `cells`?)
--! error: --trace shows the calls that led there
--! not error: stack traceback
local lab = require "asperity"
local function make() lab.surface.flat{ cell=8, cells=8, size=1 } end
make()
