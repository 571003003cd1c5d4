lab = require "asperity"
function f() y = 1 end f()