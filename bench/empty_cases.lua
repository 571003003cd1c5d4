-- SPDX-License-Identifier: GPL-3.0-or-later
-- Overhead of one case of an ensemble: processor time over the number of empty cases. Option: cases.
--
--   time asperity run bench/empty_cases.lua --threads 2
local lab = require "asperity"
local arguments = require "asperity.arguments"
local options = arguments({ cases = 16000 }, ...)

local seeds = {}
for k = 1, options.cases do seeds[k] = k end
local rows = lab.ensemble{ over = { seed = seeds }, run = function(case) return { twice = 2.0 * case.seed } end }
print(("%d cases"):format(#rows))
