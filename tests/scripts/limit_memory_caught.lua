-- SPDX-License-Identifier: GPL-3.0-or-later
-- Memory that could not be had is an error like another, and the run may go on with less.
--! flags: --limit-memory 128M
--! output: false	true	true
local lab = require "asperity"
local large = pcall(lab.surface.flat, { cells=8192, size=1 })
local text = not pcall(string.rep, "x", 200 << 20)
local small = pcall(lab.surface.flat, { cells=1024, size=1 })
print(large, text, small)
