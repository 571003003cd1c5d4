-- SPDX-License-Identifier: GPL-3.0-or-later
-- A limit that is not reached changes nothing.
--! flags: --limit-time 100s --limit-memory 1G
--! output: finished
local sum = 0
for k = 1, 1e6 do sum = sum + k end
print "finished"
