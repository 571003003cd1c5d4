local lab = require "asperity"
local t = setmetatable({}, { __index=function() error "no" end, __close=print })
print(pcall(lab.surface.flat, t)) print(getmetatable(lab.rigid), getmetatable("").__index)