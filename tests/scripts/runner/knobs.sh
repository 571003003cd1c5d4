#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# --knob of run, check and explain; what becomes of it in record, replay and resume, and the refusals.
#
#   tests/scripts/runner/knobs.sh PROGRAM FOLDER
set -eu
. "$(dirname "$0")/saying.sh"
begin "$@"

cat > knobs.lua <<'LUA'
local lab = require "asperity"
local p = lab.knob{ name="pressure", from="1 MPa", to="200 MPa", value="20 MPa", log=true }
local s = lab.surface.sine{ cells=16, size="1 mm", amplitude="1 um", material=lab.material "Al-2011" }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
local book = lab.notebook "knobs"
local rows = lab.ensemble{ over={ k={1, 2} }, run=function(case)
  return { v = case.k * lab.knob{ name="factor", from=1, to=9, value=3 } }
end }
book:write{ p = p, area = c:press{ pressure=p }.area_fraction, v = rows[2].v }
book:expect("p", { at_least=30e6 })
print(p, rows[2].v)
LUA

"$program" run knobs.lua --out plain > printed 2> errors && fail "the expectation holds at the script's own value"
grep -qx '20000000.0	6.0' printed || fail "the script's own values are not taken"
"$program" run knobs.lua --out given --knob pressure="50 MPa" --knob factor=4 > printed 2> errors ||
  { cat errors; fail "values that are given end with an error"; }
grep -qx '50000000.0	8.0' printed || fail "what is given is not taken"
grep -A7 '"knobs"' given/manifest.json | grep -q '"value": 4.0' || fail "the record has no knobs"
# The same bytes, whether a value was given or is the script's.
"$program" run knobs.lua --out same --knob pressure="20 MPa" > printed 2> errors || true
sed '/"unhashed"/,$d' plain/manifest.json > one
sed '/"unhashed"/,$d' same/manifest.json > other
cmp one other || fail "a value that is the script's own makes another record"

# Replay and resume take what is recorded.
ends 0 "the same again" "$program" replay given --out again
grep -q '"value": 50000000.0' again/manifest.json || fail "a replay took another value"
sed -i 's/"status": "done"/"status": "running"/' given/manifest.json
ends 2 'the knob `pressure` of' "$program" run --resume given --knob pressure="51 MPa"
ends 0 'results in' "$program" run --resume given --knob factor=4
grep -q '"value": 50000000.0' given/manifest.json || fail "a run that was taken up took another value"

# Refusals: unknown, out of bounds, another kind, no value.
ends 1 'did you mean `pressure`' "$program" run knobs.lua --out r1 --knob presure="50 MPa"
says 'its knobs are pressure (1 MPa to 200 MPa) and factor (1 to 9)' output
grep -q '"status": "failed"' r1/manifest.json || fail "a knob that is not there is no failure"
ends 1 'out of its bounds; give 1 MPa to 200 MPa' "$program" run knobs.lua --out r2 --knob pressure="500 MPa"
ends 1 'a length, and it is a pressure' "$program" run knobs.lua --out r3 --knob pressure="5 um"
ends 2 'give a name and its value' "$program" run knobs.lua --out r4 --knob pressure
ends 2 'is given twice' "$program" run knobs.lua --out r5 --knob factor=2 --knob factor=3

# A dry run knows the values, and explains with them.
ends 0 'no problem found' "$program" check knobs.lua --knob pressure="50 MPa"
ends 1 'out of its bounds' "$program" check knobs.lua --knob pressure="500 MPa"
if grep -q 'makes no such knob' output; then fail "a value that is refused is complained of twice"; fi
ends 1 'the script makes no such knob' "$program" check knobs.lua --knob load="5 N"
ends 0 'together: 1 press' "$program" explain knobs.lua --knob pressure="50 MPa"
ends 1 'out of its bounds' "$program" explain knobs.lua --knob pressure="500 MPa"

# A variation does not move a knob that was recorded.
ends 2 'takes knobs as recorded' "$program" replay given --out r6 --set knob.value="30 MPa"
ends 1 'of the key `value`, which only a knob gives' "$program" replay given --out r7 --set value="30 MPa"

# What accuracy costs, at the values that are given.
sed 's/^print.*/return c:press{ pressure=p }.area_fraction/; /lab.ensemble/,/^end }/d; /^book:write/,/^book:expect/d' knobs.lua > number.lua
ends 0 'cells_factor' "$program" accuracy number.lua --out a1 --repeats 1 --knob pressure="50 MPa"
grep -A5 '"pressure"' a1/manifest.json | grep -q '"value": 50000000.0' || fail "accuracy took another value"
ends 1 'did you mean `pressure`' "$program" accuracy number.lua --out a2 --knob presure="50 MPa"
ends 2 'the limit of the store is `x`' "$program" run number.lua --out a3 --store-limit x

# Confined, values go along.
if "$program" run knobs.lua --out confined --confined --knob pressure="60 MPa" > printed 2> errors; then
  grep -qx '60000000.0	6.0' printed || fail "a confined run took another value"
fi

# With a store, a move computes what the knob touches alone.
"$program" run knobs.lua --out s1 --store kept --knob pressure="40 MPa" > printed 2> errors || fail "a store"
"$program" run knobs.lua --out s2 --store kept --knob pressure="40 MPa" --knob factor=5 > printed 2> errors
grep -qx '40000000.0	10.0' printed || fail "a case was taken from another value"
echo passed
