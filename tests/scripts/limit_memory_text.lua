-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --limit-memory 64M
--! exit: 1
--! error: not enough memory
--! error: the memory limit of 64 MiB was reached
--! file: rows.csv: 1
local lab = require "asperity"
lab.notebook "rows":write{ a=1 }
local text = string.rep("x", 100 << 20)
