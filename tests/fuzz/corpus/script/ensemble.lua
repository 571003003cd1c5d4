local lab = require "asperity"
for _, r in ipairs(lab.ensemble{ over={ D={2, 2.5}, seed={1} }, run=function(case) return { twice=2 * case.D } end }) do print(r.twice) end