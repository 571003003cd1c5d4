-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a loop has dropped does not count against the limit.
--! flags: --limit-memory 32M
--! output: finished
local lab = require "asperity"
local s
for k = 1, 60 do s = lab.surface.flat{ cells=1024, size=k } end
for k = 1, 20 do s = s:mirrored() end
for k = 1, 20 do
  local x <close> = lab.surface.sine{ cells=1024, size=k, amplitude=1 }
end
print "finished"
