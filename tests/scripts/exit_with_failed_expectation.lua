-- SPDX-License-Identifier: GPL-3.0-or-later
--! exit: 1
--! error: 1 of 1 expectation
local lab = require "asperity"
local book = lab.notebook "rows"
book:write{ a=1 }
book:expect("a", { near=2, within=0.5 })
os.exit(0)
