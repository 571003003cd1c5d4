-- SPDX-License-Identifier: GPL-3.0-or-later
-- A loop over what only a run knows ends: a dry run goes through its body once.
--! command: check
--! output: no problem found
local lab = require "asperity"
local s = lab.surface.sine{ cells=4096, size=1, amplitude="1 um" }
local text = ("%g"):format(s:roughness().Ra)
for digit in text:gmatch "%d" do print(digit) end
for number in ("%g"):format(s:roughness().Rq):gmatch "%S+" do print(number) end
