#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A script that loops over names with pairs is itself again in every process: run, replayed and taken up, also
# where a module and the cases of an ensemble loop.
#
#   tests/scripts/runner/fixed_order.sh PROGRAM FOLDER
set -eu
. "$(dirname "$0")/saying.sh"
begin "$@"

cat > each.lua <<'LUA'
return function(t, visit) for name, value in pairs(t) do visit(name, value) end end
LUA
cat > loads.lua <<'LUA'
local lab, each = require "asperity", require "each"
local loads = { light="20 MPa", middle="60 MPa", heavy="150 MPa", full="300 MPa", none="1 MPa", most="400 MPa" }
local book = lab.notebook "loads"
local s = lab.surface.self_affine{ cells=32, size="100 um", hurst=0.8, rms_height="0.5 um", short_wave="12 um", seed=1,
  material=lab.material "Al-2011" }
local function area(p)
  return lab.contact{ lower=s, upper=lab.rigid, boundary="periodic",
    effects={ elasticity="half_space", plasticity={} } }:press{ pressure=p }.area_fraction
end
for name, p in pairs(loads) do book:write{ name=name, area=area(p) } print(name) end
each(loads, function(name, p) book:write{ name=name .. " again", area=area(p) } end)
local rows = lab.ensemble{ over={ k={ 1, 2 } }, run=function()
  local text = ""
  for name in pairs(loads) do text = text .. name .. " " end
  return { text=text }
end }
for _, row in ipairs(rows) do book:write{ name=row.text } end
LUA
for k in 1 2 3; do
  "$program" run loads.lua --out "run$k" > "printed$k" 2> /dev/null
  cmp run1/loads.csv "run$k/loads.csv"
  cmp printed1 "printed$k"
done
[ "$(tr '\n' ' ' < printed1)" = "full heavy light middle most none " ] || fail "another order: $(cat printed1)"
ends 0 "the same again" "$program" replay run1
ends 0 "the same again" "$program" replay run2

# The record as a process leaves it that is killed after the first presses.
cp -r run1 cut
head -n 4 run1/journal.jsonl > cut/journal.jsonl
sed -i 's/"status": *"done"/"status": "running"/' cut/manifest.json
grep -q '"running"' cut/manifest.json || fail "the manifest was not altered"
"$program" run --resume cut > printed 2> told || { cat told; fail "the run could not be taken up"; }
cmp run1/loads.csv cut/loads.csv
cmp run1/journal.jsonl cut/journal.jsonl
