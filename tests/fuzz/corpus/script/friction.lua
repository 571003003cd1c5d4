local lab = require "asperity"
local law = lab.friction{ tau0="1 MPa", alpha=0.2 }
print(law) print(law.tau0, law == law)