#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# `asperity repl` with its lines from a pipe: values, errors, limits, files and exit statuses.
# usage: prompt.sh PROGRAM FOLDER
set -eu
. "$(dirname "$0")/saying.sh"
begin "$@"
XDG_STATE_HOME=$PWD/state
export XDG_STATE_HOME

# Values on one line, without prompts; nothing else is printed and no directory is made.
cat > lines <<'LUA'
1 + 1
local s <const> = lab.surface.sine{ cells=16, size="1 mm", amplitude="1 um",
  material=lab.material "Al-2011" }
s.peak_to_valley
s:roughness().Ra
(s:roughness()).Rq, 7
{ 1, { 2, "x" }, key = 3 }
for k = 1, 2 do
  print("turn " .. k)
end
local function twice(x) return 2 * x end
twice(21)
return 7
nil
c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
st = c:press{ pressure="1 MPa" }
st.pressure
c.press
-- a comment alone

LUA
"$program" repl < lines > output 2> errors || { cat errors; fail "good lines end with $?"; }
cat > wanted <<'TEXT'
2
2 um (2e-06 m)
628.4 nm (6.2841744e-07 m)
7.0710678118655e-07  7
{ 1, { 2, "x" }, key = 3 }
turn 1
turn 2
42
7
nil
1 MPa (1000000 Pa)
function contact:press, which help explains
TEXT
diff wanted output || fail "values are not shown as they should be"
[ ! -s errors ] || { cat errors; fail "good lines print errors"; }
[ ! -e runs ] || fail "a run directory was made though nothing was written"
[ ! -e state ] || fail "a history was kept of a pipe"

# An error is told with its line, leaves every variable as it was, and the next line runs.
cat > lines <<'LUA'
x = 1
x = 2; y = 3; error "on purpose"
x
y
function deep() error "from inside" end
deep()
lab.surfase
c = lab.contact{ lover=1 }
z = = 1
os.execute "true"
print "still here"
LUA
ends 1 'prompt:2: on purpose' "$program" repl < lines
says '1' output
says 'the global `y` was never set' output
says "in function 'deep'" output
says 'did you mean `surface`?' output
says 'did you mean `lower`?' output
says "prompt:9: unexpected symbol near '='" output
says 'os.execute is not available' output
says 'still here' output
grep -qx 1 output || fail "x was not put back"

# A limit of time is that of one line; a loop, and a pattern that no hook reaches, which ends the session.
printf '%s\n' 'a = 1' 'while true do end' 'a + 1' > lines
ends 1 'the time limit of 2 s a line was reached' "$program" repl --limit-time 2s < lines
grep -qx 2 output || fail "the line after a limit did not run"
printf '%s\n' 's = ("a"):rep(40)' 's:find(("a*"):rep(40) .. "b")' 'print "not reached"' > lines
ends 1 'could not be stopped, and the session ends' "$program" repl --limit-time 2s < lines
printf '%s\n' 't = ("x"):rep(2^30)' 'print "after"' > lines
ends 1 'after' "$program" repl --limit-memory 200M < lines

# Files: the directory is made with the first, script.lua is what was said and runs again.
cat > lines <<'LUA'
local s = lab.surface.flat{ cells=8, size="1 mm" }
nonsense(
)
show(s)
s:write "flat.npy"
book = lab.notebook "rows"
for k = 1, 3 do book:write{ N=k, ["Ra [m]"]=k * 1e-6 } end
s.size[1]; -- after the value
book:expect("Ra", { at_most="1 um" })
LUA
ends 1 'results in' "$program" repl < lines
[ -s runs/prompt-1/flat.npy ] && [ -s runs/prompt-1/rows.csv ] || fail "files are missing"
says '"status": "failed"' runs/prompt-1/manifest.json
if grep -q nonsense runs/prompt-1/script.lua; then fail "a line that failed is in the script"; fi
status=0
"$program" run runs/prompt-1/script.lua --out again > output 2>&1 || status=$?
[ "$status" = 1 ] && cmp runs/prompt-1/flat.npy again/flat.npy && cmp runs/prompt-1/rows.csv again/rows.csv ||
  { cat output; fail "the session does not run again as a script"; }
ends 2 'is a session of the prompt' "$program" replay runs/prompt-1
printf '%s\n' 'lab.surface.flat{ cells=8, size=1 }:write "a.csv"' > lines
ends 0 'results in' "$program" repl --out here < lines
[ -s here/a.csv ] || fail "--out was not heard"
ends 1 'is not empty' "$program" repl --out here < lines

# Ends: os.exit, a statement that is not whole, charts without a terminal, a bad option.
printf '%s\n' 'print "here"; os.exit(7)' 'print "no"' > lines
ends 7 'here' "$program" repl < lines
printf '%s\n' 'for i = 1, 2 do' > lines
ends 1 'the input ends within a statement' "$program" repl < lines
printf '%s\n' 'show({ 1, 4, 9 })' > lines
if command -v gnuplot > /dev/null; then ends 0 'value' "$program" repl < lines; fi
printf '%s\n' 'show(1)' > lines
ends 1 'show draws a surface' "$program" repl < lines
ends 2 'a time limit is' "$program" repl --limit-time=-3s < lines
printf '%s\n' 'help "hardness"' 'help(lab.surface.flat)' 'help(lab.surface)' 'help(math.floor)' 'help "surfase"' > lines
ends 1 'Key `effects.plasticity.hardness` of lab.contact' "$program" repl < lines
says 'lab.surface.flat{ cells=, size=, material= }' output
says 'a function of Lua itself' output
says 'did you mean `surface`?' output
echo "the prompt reads a pipe as a plain reader does"
