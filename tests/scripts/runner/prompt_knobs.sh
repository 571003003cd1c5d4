#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# lab.knob.set in `asperity repl`: what is run again, what is taken from memory, and what stays where it fails.
# usage: prompt_knobs.sh PROGRAM FOLDER
set -eu
. "$(dirname "$0")/saying.sh"
begin "$@"
XDG_STATE_HOME=$PWD/state
export XDG_STATE_HOME

# A move computes the press that the knob touches; surface and the other press are taken from memory. Back again,
# nothing is computed.
cat > lines <<'LUA'
p = lab.knob{ name="pressure", from="1 MPa", to="200 MPa", value="20 MPa", log=true }
local s = lab.surface.self_affine{ cells=32, size="1 mm", hurst=0.8, rms_height="1 um", short_wave="0.2 mm", seed=4, material=lab.material "Al-2011" }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
before = c:press{ pressure="10 MPa" }.area_fraction
st = c:press{ pressure=p }
chance = math.random()
print("chance", chance)
area = st.area_fraction
lab.knob.set("pressure", "50 MPa")
print("pressure", p, st.pressure, area == st.area_fraction)
lab.knob.set("pressure", 20e6)
print("pressure", p)
lab.knob.set("pressure", "50 MPa")
LUA
"$program" repl < lines > output 2> errors || { cat errors; fail "moves end with $?"; }
cat > wanted <<'TEXT'
pressure = 50 MPa: heavy results: 1 computed, 2 taken from memory
pressure = 2e+07: heavy results: 0 computed, 3 taken from memory
pressure = 50 MPa: heavy results: 0 computed, 3 taken from memory
TEXT
diff wanted errors || fail "a move does not compute what it touches alone"
grep -qx 'pressure	50000000.0	50000000.0	true' output || { cat output; fail "what depends on the knob did not move"; }
[ "$(grep chance output | sort -u | wc -l)" = 1 ] || fail "random numbers are others when a script is run again"
[ ! -e runs ] || fail "a run directory was made though nothing was written"

# Refusals, an error at one value and none at the next, two knobs at once, and an endless loop.
cat > lines <<'LUA'
a = lab.knob{ name="a", from=0, to=10, value=1 }
b = lab.knob{ name="b", from=0, to=10, value=2 }
list = { a }
if a > 5 then list[1] = "spoilt" error "a is too much" end
if b > 9 then while true do end end
sum = a + b
lab.knob.set("c", 1)
lab.knob.set("a", 11)
lab.knob.set("a", "2 um")
lab.knob.set("a", "fast")
lab.knob.set("a", 6)
print("still", a, list[1], sum)
lab.knob.set("a", 4) lab.knob.set("b", 5)
print("both", a, b, sum)
lab.knob.set("b", 10)
print("still", a, b, sum)
a = lab.knob{ name="late", from=0, to=1, value=0.5 } error "on purpose"
late = lab.knob{ name="late", from=0, to=2, value=0.5 }
lab.knob.set("late", 2)
print("late", late, sum)
LUA
ends 1 'the knobs are a and b' "$program" repl --limit-time 2s < lines
says 'there is no knob `c`' output
says 'out of its bounds; give 0 to 10' output
says 'a length, and it is a plain number' output
says 'a is too much' output
says 'all is as it was before' output
says 'the time limit of 2 s a line was reached' output
grep -qx 'still	1.0	1.0	3.0' output || { cat output; fail "a move that failed left something"; }
grep -qx 'both	4.0	5.0	9.0' output || { cat output; fail "two knobs did not move"; }
grep -qx 'still	4.0	5.0	9.0' output || { cat output; fail "a move that was stopped left something"; }
grep -qx 'late	2.0	9.0' output || { cat output; fail "a knob of a line that failed stayed"; }
says 'a = 4, b = 5: heavy results' output

# Notebooks and expectations begin anew, and come back where it fails; a script that was loaded and what it requires
# are read again; an ensemble whose cases ask for a knob.
cat > helper.lua <<'LUA'
return { twice = 2 * require "asperity".knob{ name="k", from=1, to=9, value=1 } }
LUA
cat > loaded.lua <<'LUA'
local lab = require "asperity"
book = lab.notebook "rows"
k = lab.knob{ name="k", from=1, to=9, value=1 }
for n = 1, 2 do book:write{ n=n, v=n * k, twice=require "helper".twice } end
book:expect("v", { at_most=10 })
rows = lab.ensemble{ over={ x={1, 2} }, run=function(case)
  return { y = case.x * require "asperity".knob{ name="k", from=1, to=9, value=1 } }
end }
if k == 7 then error "not seven" end
LUA
cat > lines <<'LUA'
dofile "loaded.lua"
print("rows", rows[2].y)
lab.knob.set("k", 3)
lab.knob.set("k", 7)
LUA
ends 1 'not seven' "$program" repl < lines
grep -qx 'rows	6.0' output || { cat output; fail "an ensemble kept another value"; }
printf 'n,twice,v\n1,6,3\n2,6,6\n' > wanted
tail -n +1 runs/prompt-1/rows.csv | tr -d '\r' > found
diff wanted found || fail "a notebook is not that of the last run"
grep -A3 '"knobs"' runs/prompt-1/manifest.json | grep -q '"value": 3.0' || fail "the record has another value"
says '1 expectation holds' output
says 'now k = 3' runs/prompt-1/script.lua
echo "knobs of a prompt move what depends on them"
