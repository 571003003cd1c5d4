local lab = require "asperity"
local s = lab.surface.flat{ cells=32, size="1 mm" }
for _, t in ipairs(lab.stylus{ tip="2 um", spacing="20 um", length="0.5 mm" }:scan(s, { count=2, seed=1 })) do print(t) end