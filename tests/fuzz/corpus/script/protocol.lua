local lab = require "asperity"
local p = lab.protocol{ { press={ pressure="1 MPa" } }, { release=true } }
print(p, #p) print(p .. p)