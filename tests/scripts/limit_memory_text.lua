-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --limit-memory 64M
--! exit: 1
--! error: not enough memory
--! error: the memory limit is 64 MiB
--! file: rows.csv: 1
local lab = require "asperity"
lab.notebook "rows":write{ a=1 }
local text = string.rep("x", 100 << 20)
