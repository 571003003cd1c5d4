-- SPDX-License-Identifier: GPL-3.0-or-later
-- Misspelt, missing, surplus and wrong keys: each refusal names this file, its line and the nearest name.
--! output: all refused
local lab = require "asperity"
local S = lab.surface
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
refused(function() S.weierstrass_mandelbrot{ cells=8, D=2.5, gama=1.5 } end, "unknown key `gama` (did you mean `gamma`?)")
refused(function() lab.material{ young=1e9, poisson=0.3, hardnes=1e9 } end, "(did you mean `hardness`?)")
refused(function() S.flat{ cells=8 } end, "`size` is missing", 'e.g. "250 um"')
refused(function() S.flat{ 8, size=1 } end, "position 1 holds a value without a key", "`cells` is missing")
refused(function() S.flat(8) end, "takes one table of named keys, and was given the number 8")
refused(function() S.flat{ cells=8, size=1, material="steel" } end, "`material` is the string")
refused(function() S.flt{ cells=8, size=1 } end, "lab.surface has no field `flt` (did you mean `flat`?)")
refused(function() lab.contct{} end, "lab has no field `contct` (did you mean `contact`?)")
refused(function() lab.material "stel" end, "no material `stel` (did you mean `steel`?)")
refused(function() lab.help "surfce" end, "there is no help on `surfce` (did you mean")
local s = S.sine{ cells=8, size=1, amplitude=0.01 }
refused(function() s:scalled{} end, "a surface has no field `scalled` (did you mean `scaled`?)")
refused(function() return s:roughness().Raa end, "a roughness result has no field `Raa` (did you mean `Ra`?)")
refused(function() s:fractal_dimension{ method="lenght" } end, '`method` is "lenght" (did you mean `length`?)')
refused(function() s:scaled{} end, "give exactly one of `amplitude`, `rms` and `ra`; 0 are given")
refused(function() s:picture("x.png", { palette="rainbow" }) end, "`palette`", "viridis")
refused(function() lab.contact{ lower=s, uper=lab.rigid, effects={} } end,
  "3 problems", "unknown key `uper` (did you mean `upper`?)", "`upper` is missing", "`effects` names no elasticity")
refused(function() lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="bx" } } end, "(did you mean `box`?)")
refused(function() lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box", adhesin={} } } end,
  "there is no effect `adhesin` (did you mean `adhesion`?)")
refused(function() lab.friction{ tau=1 } end, "3 problems", "`tau0` is missing", "`alpha` is missing")
print "all refused"
