local lab = require "asperity"
local b = lab.notebook "n"
b:write{ N=1, Ra=2 }
b:expect("Ra", { near=2, rel=0.1 })