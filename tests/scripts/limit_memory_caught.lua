-- SPDX-License-Identifier: GPL-3.0-or-later
-- A limit that was exceeded ends the run with 1, even when the script catches the error.
--! flags: --limit-memory 128M
--! exit: 1
--! output: false
--! error: the memory limit of 128 MiB was reached (--limit-memory)
local lab = require "asperity"
local large = pcall(lab.surface.flat, { cells=8192, size=1 })
print(large)
