-- SPDX-License-Identifier: GPL-3.0-or-later
-- Errors that Lua raises in its own functions name the line of the script, and `error()` does.
--! exit: 1
--! error: error_in_c_function.lua:11: contact:sweep gives an iterator, and the number 1 was read from it
--! output: :9: (error value: nil)
local lab = require "asperity"
local s = lab.surface.sine{ cells=8, size=1, amplitude=0.1, material=lab.material "Al-2011" }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="free", effects={ elasticity="half_space" } }
local rows = lab.ensemble{ over={ k={ 1 } }, on_failure="report", run=function() error() end }
print(rows.failed[1].message)
for _ in ipairs(c:sweep{ pressure={ "1 MPa" } }) do end
