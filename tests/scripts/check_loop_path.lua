-- SPDX-License-Identifier: GPL-3.0-or-later
--! command: check
--! output: no problem found; checked to line 6: the script's path depends on a result
local lab = require "asperity"
local s = lab.surface.sine{ cells=4096, size=1, amplitude="1 um" }
for k = 1, s:roughness().Ra do lab.nonsense() end
