local lab = require "asperity"
for k = 1, 3 do local s <close> = setmetatable({}, { __close=function() error(k) end }) end