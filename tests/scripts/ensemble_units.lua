-- SPDX-License-Identifier: GPL-3.0-or-later
-- A unit in a name holds for the numbers given; cases and rows have SI under the plain name.
--! output: 2e-06	3e-06	3000000.0	nil
--! output: Ra [um] p [MPa] seed
--! output: mean of `p`: 3.0 MPa
--! output: `over` names `Ra` twice
local lab = require "asperity"
local rows = lab.ensemble{ over={ ["Ra [um]"]={ 2, 3 }, seed={ 1, 2 } }, run=function(case)
  return { ["p [MPa]"]=case.Ra * 1e6 }
end }
print(rows[1].Ra, rows[3].Ra, rows[3].p, rows[3]["p [MPa]"])
print(rows)
print("mean of `p`: " .. rows:where{ ["Ra [um]"]=3 }:mean("p")[1].mean / 1e6 .. " MPa")
print(pcall(lab.ensemble, { over={ ["Ra [um]"]={ 2 }, Ra={ 1 } }, run=function() return { a=1 } end }))
