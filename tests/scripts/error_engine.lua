-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --trace
--! exit: 1
--! error: error_engine.lua:8: lab.surface.flat: unknown key `cell` (did you mean `cells`?)
--! error: stack traceback:
--! error: 'make'
local lab = require "asperity"
local function make() lab.surface.flat{ cell=8, cells=8, size=1 } end
local function outer() make() end
outer()
