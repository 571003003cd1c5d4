-- SPDX-License-Identifier: GPL-3.0-or-later
-- A list that a dry run knows one element of is no mistake of the script.
--! command: check
--! output: checked to line 7
local lab = require "asperity"
local traces = lab.surface.flat{ cells=4096, size=1 }:profiles()
print(traces[1]:roughness().Ra, traces[2]:roughness().Ra)
