-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wrong units, wrong dimensions, and numbers that are none.
--! output: all refused
local lab = require "asperity"
local S = lab.surface
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
refused(function() S.flat{ cells=8, size="1 kg" } end, '`size`: "1 kg": a mass where a length is wanted')
for _, size in ipairs{ "1 microns", "1", "um", "", "1e400 um" } do
  refused(function() S.flat{ cells=8, size=size } end, "`size`: ")
end
refused(function() S.flat{ cells=8, size=0/0 } end, "`size` is nan m; give a length above 0")
refused(function() S.flat{ cells=8, size=math.huge } end, "`size` is inf m; give a finite length above 0")
refused(function() S.flat{ cells=8, size=-1 } end, "`size` is -1 m; give a length above 0")
refused(function() S.flat{ cells=8, size={ 1, "2 s" } } end, "a time where a length is wanted")
refused(function() lab.material{ young="70 um", poisson=0.3 } end, "a length where a pressure is wanted")
refused(function() lab.material{ young="70 GPa", poisson=0.51 } end, "`poisson` is 0.51", "0.5")
refused(function() S.flat{ cells=8, size=1 }:rotated "90 um" end, "`angle`: ", "an angle is wanted")
refused(function() S.flat{ cells=8, size=1 }:shifted{ x="1 s" } end, "`x`: ", "a length is wanted")
local c = lab.contact{ lower=S.sine{ cells=8, size=1, amplitude=0.01, material=lab.material "steel" }, upper=lab.rigid,
                       effects={ elasticity="box" } }
refused(function() c:press{ approach="1 MPa" } end, "`approach`: ", "a length is wanted")
refused(function() c:press{ pressure="1e300 GPa" } end, "`pressure`: ", "outside the range of numbers")
refused(function() c:press{ pressure=0/0 } end, "`pressure` is nan Pa")
refused(function() c:press{ pressure=math.huge } end, "`pressure` is inf Pa; give a finite number")
for key, text in pairs{ load="-inf N; give a finite", approach="inf m; give a finite", flatten="inf; give a number from 0 to 1" } do
  refused(function() c:press{ [key]=key == "load" and -math.huge or math.huge } end, "`" .. key .. "` is " .. text)
end
refused(function() lab.friction{ tau0="500 MPa", alpha="0.2 MPa" } end, "`alpha`: ")
print "all refused"
