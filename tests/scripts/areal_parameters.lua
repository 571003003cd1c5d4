-- SPDX-License-Identifier: GPL-3.0-or-later
-- Areal and profile parameters as a script reads them: gauges, units, what is not defined, and what is asked wrongly.
local lab = require "asperity"
do -- one sample has no parameters
  local point = lab.surface.from_table{ size="1 um", heights={ { 1e-6 } } }:profile{ row=0 }
  local ok, message = pcall(point.primary_parameters, point)
  assert(not ok and message:find("a profile of 1 sample has no parameters", 1, true), message)
end

local function near(value, wanted, relative, what)
  assert(math.abs(value - wanted) <= relative * math.abs(wanted) + 1e-15, what .. ": " .. tostring(value) .. ", not " .. wanted)
end
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line

-- A sine of two directions, 1 um high on cells of half a um.
local um = 1e-6
local s = lab.surface.from_function{ cells=256, size="128 um", height=function(x, y)
  return um * math.sin(2 * math.pi * x / (16 * um)) * math.sin(2 * math.pi * y / (16 * um))
end }
local p = s:areal_parameters()
near(p.Sq, um / 2, 1e-12, "Sq")
near(p.Sz, 2 * um, 1e-12, "Sz")
near(p.Sku, 2.25, 1e-12, "Sku")
near(p.S10z, 2 * um, 1e-9, "S10z")
near(p.Spd, 2 / (16 * um)^2, 1e-12, "two peaks a period")
near(p.Spc, um * 2 * (1 - math.cos(2 * math.pi / 32)) / (0.5 * um)^2, 1e-9, "Spc")
near(p.Str, 0.8717, 2e-3, "Str")
assert(p.Str_bound == nil and p:why_not "Str_bound" == "Str itself is defined" and p:why_not "Str" == nil)
assert(p.measured == 256 * 256 and p.how == "mean removed" and p.prepared == s)
near(p.Vmp, s:bearing():material_volume(0.1), 1e-12, "Vmp")
near(s:bearing():ratio(0), 0.5, 0.02, "half lies above the mean")
near(s:bearing():height(0.1), -s:bearing():height(0.9), 1e-9, "the curve is odd")
near(s:autocorrelation():at(0, 0), 1, 1e-12, "the autocorrelation at the origin")
refused(function() s:autocorrelation():at(200, 0) end, "over half the map")

-- Ridges have a lay and no ratio of texture, but a bound for it.
local ridges = lab.surface.from_function{ cells=128, size="128 um", height=function(x) return um * math.sin(2 * math.pi * x / (16 * um)) end }
local r = ridges:areal_parameters{ F=1 }
assert(r.Str == nil and r.Str_bound < 0.1 and r:why_not "Str":find("half the map", 1, true))
near(r.Std, math.pi / 2, 1e-12, "the lay lies along y")
assert(r.how == "F-operation of degree 1, mean removed")

-- Filters act before anything is read.
local smooth = s:areal_parameters{ S="32 um" }
assert(smooth.Sq < 0.1 * p.Sq and smooth.how:find("S-filter 32 um", 1, true))

-- A flat has no such parameter: nil.
local flat = lab.surface.flat{ cells=16, size="1 um" }:areal_parameters()
assert(flat.Sal == nil and flat.Sku == nil and flat.S10z == nil and flat.Sk == 0 and flat.Sdr == 0)
assert(flat:why_not "Sal" == "all heights are equal")

-- A plane less its plane is rounding, without a shape.
local plane = lab.surface.from_function{ cells=64, size="64 um", height=function(x, y) return 0.3 * x - 0.2 * y end }
local nothing = plane:areal_parameters{ F=1 }
assert(nothing.Sq < 1e-18 and nothing.Ssk == nil and nothing.Str == nil and nothing.Std == nil and nothing.Spd == nil)
assert(nothing:why_not "Sku":find("but for rounding", 1, true))
refused(function() plane:profile{ row=3 }:profile_parameters{ section="12 um", F=1 } end, "nothing but rounding is left")
local row = lab.surface.from_function{ cells={ 64, 1 }, size={ "64 um", "1 um" }, height=function(x) return um * math.sin(x / um) end }
assert(row:areal_parameters().Std == nil and row:areal_parameters().Spd == nil)

-- A profile has the curve too: half the points are above the mean.
near(s:profile{ row=5 }:bearing():ratio(0), 0.5, 0.05, "Rmr(0)")
near(s:profile{ row=5 }:bearing():height(0), s:profile{ row=5 }:roughness().peak, 1e-9, "Rmc(0), of whole periods")

refused(function() s:areal_parameters{ S="1 mm", L="1 um" } end, "is not below `L`")
refused(function() p:why_not "Sqq" end, "there is no areal parameter `Sqq`")
refused(function() return p.Sqr end, "did you mean")
refused(function() s:bearing():height(1.5) end, "a material ratio is a share")

local slopes = s:scale_dependence{ of="slope", cells={ 1, 4 } }
near(slopes.value[1], p.Sdq / math.sqrt(2), 1e-9, "slope along x over a cell")
near(slopes.distance[2], 2 * um, 1e-12, "its distance")
assert(s:scale_dependence{ of="curvature", cells={ 2 } }.least[1] < 0)
assert(s:reliability{ tip="1 nm" }.cut_off == 0 and s:reliability{ tip="1 mm" }.x > 32 * um)
assert(slopes.cut_off == nil and slopes.reliable == nil)
local blunt = s:scale_dependence{ of="slope", cells={ 1, 4, 60 }, tip="10 um" }
near(blunt.cut_off, s:reliability{ tip="10 um" }.x, 1e-12, "the cut-off of the tip")
assert(blunt.cut_off > 2 * um and blunt.reliable[1] == false and blunt.reliable[2] == false)
assert(blunt.reliable[3] == (blunt.distance[3] >= blunt.cut_off) and #blunt.reliable == 3)
assert(s:scale_dependence{ of="height", tip="1 nm" }.reliable[1])
refused(function() s:scale_dependence{ cells={ 300 } } end, "whose stencil fits")

-- A trace: sections as the standard has them, none guessed.
local trace = ridges:profile{ row=5 }
local long = lab.surface.from_function{ cells={ 4096, 1 }, size={ "4.096 mm", "1 um" }, height=function(x)
  return um * math.sin(2 * math.pi * x / (64 * um) + 0.3)
end }:profile{ row=0 }
local q = long:profile_parameters{ section="0.512 mm", S="8 um" }
assert(q.sections == 5 and q.measured == 2560)
near(q.Rsm, 64 * um, 1e-3, "Rsm")
near(q.Rz, 2 * um, 0.03, "Rz")
assert(q.u_Rz >= 0 and q.Rdq > 0 and q.profile:roughness().Ra == q.profile:roughness().Ra)
refused(function() long:profile_parameters{ F=1 } end, "neither `section` nor `class`")
refused(function() long:profile_parameters{ section="1 mm", class="Sc3" } end, "both `section` and `class`")
refused(function() long:profile_parameters{ class="Sc7" } end, "there is no setting class `Sc7`")
refused(function() trace:profile_parameters{ class="Sc5" } end, "holds no section")

-- The primary profile keeps its long waves and its whole length; nothing is required of the call.
local waves = lab.surface.from_function{ cells={ 4096, 1 }, size={ "4.096 mm", "1 um" }, height=function(x)
  return um * math.sin(2 * math.pi * x / (64 * um)) + 3 * um * math.cos(2 * math.pi * x / (4096 * um))
end }:profile{ row=0 }
local primary = waves:primary_parameters()
near(primary.Pq, um * math.sqrt(0.5 + 4.5), 1e-9, "Pq")
near(primary.Pz, primary.Pt, 0, "Pz of one section is Pt")
assert(primary.measured == 4096 and primary.sections == 1 and primary.u_Pz == nil and primary.profile == waves)
near(primary.section, 4.096e-3, 1e-12, "the evaluation length")
assert(waves:profile_parameters{ section="0.512 mm" }.Rq < 0.75 * um)
assert(waves:primary_parameters{ S="64 um", F=1, sections=5 }.u_Pz > 0)
refused(function() return primary.Rq end, "did you mean")
refused(function() waves:profile_parameters{} end, "`primary_parameters` takes no long waves away")
refused(function() waves:primary_parameters{ section="0.8 mm" } end, "unknown key `section`")
print "areal parameters: done"
