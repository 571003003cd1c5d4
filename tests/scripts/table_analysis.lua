-- SPDX-License-Identifier: GPL-3.0-or-later
-- Means with intervals, fits, histograms and charts of tables and notebooks, and what they refuse.
--! output: as it should be
--! error: fewer than five say little of how they scatter
--! file: fit.svg: </svg>
--! file: hist.svg: </svg>
local lab = require "asperity"
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
local function near(a, b, within) assert(math.abs(a - b) <= (within or 1e-12) * math.abs(b), a .. " is not " .. b) end

local book = lab.notebook "trials"
book:units{ size="um", load="N" }
local mu = { { 0.40, 0.44, 0.42, 0.41, 0.45 }, { 0.50, 0.55, 0.52 }, { 0.61, 0.66, 0.60 } }
for i, N in ipairs{ 8, 1, 20 } do
  for k, value in ipairs(mu[i]) do
    book:write{ N=N, mu=value, size=2 + 0.1 * k, load=10 * i, body=i == 1 and "worn" or "new " .. i, u=0.01 * k }
  end
end
book:write{ N=8, size=1, load=5 }

-- Means.
local means = book:mean("mu", { by="N" })
local rows = means:rows()
assert(#rows == 3 and rows[1].N == 1 and rows[2].N == 8 and rows[3].N == 20)
near(rows[2].mean, 0.424)
assert(rows[2].n == 5 and rows[2].left_out == 1 and rows[2].interval == "Student's t, 4 degrees of freedom")
near(rows[2].high - rows[2].mean, 2.7764451051977943578 * rows[2].sd / math.sqrt(5))
near(rows[2].u, rows[2].sd / math.sqrt(5))
assert(tostring(means):find("low to high is their 95 % interval", 1, true), tostring(means))
local numbered = lab.notebook "numbered"
for k = 1, 4 do numbered:write{ seed=7 * k % 5, k=k, mu=k % 3 } end
local told = tostring(numbered)
assert(told:find "mu: 1" and not told:find "seed:" and not told:find "k:", told)
local one = book:mean("size"):rows()
assert(#one == 1 and one[1].n == 12)
assert(book:table():mean("size").units.mean == "um")
local log = book:mean("mu", { where={ N=8 }, interval="log", confidence=0.9 }):rows()[1]
assert(log.low > 0.4 and log.high < 0.45 and log.interval:find "logarithms are normal")
means:chart{ x="N", y="mean", interval={ "low", "high" }, file="means.svg", lines={ { y=0.5, name="measured" } } }
refused(function() book:mean "body" end, 'column `body` holds the text "worn" in row 1')
refused(function() book:mean("mv") end, "`column` names `mv`, which is no column of the notebook", "did you mean `mu`?")
refused(function() book:mean("mu", { by="M" }) end, "`by` names `M`")
refused(function() means:mean("mean", { by="n" }) end, "`by` names the column `n`, and the means have one of that name")
refused(function() book:mean("mu", { confidence=1 }) end, "confidence")
refused(function() book:mean("mu", { interval="boot" }) end, "interval")
refused(function() book:mean("mu", { interval="t" }) end, "student")
refused(function() book:mean("mu", { where={ N=9 } }) end, "there is no number to take the mean of")
local signed = lab.table.from{ { a=-1 }, { a=2 }, { a=3 } }
refused(function() signed:mean("a", { interval="log" }) end, "a log interval needs values above 0, and one is -1")

-- Fits: points on a line, on a power law and on a curve of the script's own.
local t = lab.table.from{ { p=1, A=3.1 }, { p=2, A=4.9 }, { p=3, A=7.2 }, { p=5, A=11.1 }, { p=8, A=16.8 } }
local line = t:fit{ x="p", y="A", model="linear" }
near(line.parameters.slope.value, 1.96818181818181818)
near(line.parameters.slope.u, 0.0288334112462066621, 1e-9)
near(line.residual_sd, 0.160018938273132553)
assert(line.n == 5 and line.degrees == 3 and #line.residuals == 5 and line.rows[5] == 5 and line.left_out == 0)
near(line.parameters.slope.high, 1.96818181818181818 + 3.1824463052837096 * 0.0288334112462066621, 1e-9)
assert(line.correlation[1][2] == line.correlation[2][1] and line.names[2] == "slope")
local own = t:fit{ x="p", y="A", model=function(x, q) return q.a + q.b * x end, start={ a=0, b=1 } }
near(own.values.b, line.values.slope, 1e-10)
near(own.parameters.a.u, line.parameters.intercept.u, 1e-8)
near(own.curve.high[50], line.curve.high[50], 1e-9)
local power = t:fit{ x="p", y="A", model="power", name="a p^b" }
assert(power.values.b > 0.7 and power.values.b < 1 and power.r_squared > 0.99)
refused(function() line.parameters.slop() end, "has no field `slop`", "did you mean `slope`?")
refused(function() t:fit{ x="p", y="A", model="cubic" } end, "model")
refused(function() t:fit{ x="p", y="A", model=function(x, q) return q.a * x end } end, "`start` is missing")
refused(function() t:fit{ x="p", y="A", model="power", start={ a=1 } } end, "`start` is of no use")
refused(function() t:fit{ x="p", y="A", model=function(x, q) return q.c * x end, start={ a=1 } } end, "the function `model` failed")
refused(function() t:fit{ x="p", y="A", model=function(x, q) return "much" end, start={ a=1 } } end, "the function `model` returned")
refused(function() t:fit{ x="p", y="A", model=function(x, q) return (q.tau0 + q.alpha) * x end, start={ tau0=1, alpha=1 } } end,
  "alpha and tau0 are not identifiable: only alpha + tau0 = ")
refused(function() book:fit{ x="N", y="body", model="linear" } end, 'column `body` holds the text "worn"')
refused(function() book:fit{ x="N", y="mu", model="linear", where={ N=8 } } end, "do not tell `intercept` and `slope` apart")
local weighted = book:fit{ x="N", y="mu", model="linear", weights="u" }
assert(weighted.n == 11 and weighted.left_out == 1)
refused(function() book:fit{ x="N", y="mu", model="linear", weights="u", u=0.1 } end, "`weights` and `u` both say how rows weigh")

-- A fit takes relative scatter, u and specimens, and prints as a calibration does.
local known = t:fit{ x="p", y="A", model="linear", u=2 }
near(known.parameters.slope.u, 2 * line.parameters.slope.u / line.residual_sd, 1e-9)
assert(tostring(known):find("warning: the rows scatter 0.08 times as far as `u` says", 1, true), tostring(known))
local shares = t:fit{ x="p", y="A", model="linear", scatter="relative" }
assert(shares.residual_sd < 0.1 and shares.values.slope ~= line.values.slope)
assert(tostring(shares):find("fit of A against p over 5 rows, 3 degrees of freedom; rows scatter by", 1, true), tostring(shares))
local many = {}
for s = 1, 6 do for k = 1, 4 do many[#many + 1] = { x=s, y=s + (s * s) % 4 + 0.01 * k, piece="S" .. s } end end
local pieces = lab.table.from(many):fit{ x="x", y="y", model="linear", specimen="piece" }
assert(pieces.by_specimens and pieces.degrees == 4 and #pieces.specimens == 6)
assert(line.curve.x[1] == 1 and line.x == "p" and line.y == "A" and line.name == nil and power.name == "a p^b")
line:chart{ x="p", file="line.svg" }

-- Charts: a fit with its band, functions and lines across; names along; two panels.
t:chart{ x="p", y="A", fit=power, functions={ ["2 p"]=function(x) return 2 * x end }, lines={ { y=10, name="wanted" } },
  log_x=true, file="fit.svg" }
book:chart{ x="body", y="mu", spread=true, file="names.svg", below={ y="size", lines={ { y="2.5 um", name="limit" } } } }
refused(function() t:chart{ x="p", y="A", fit=book:fit{ x="N", y="mu", model="linear" } } end,
  "`fit` is of `mu` against `N`, and the chart shows `A` against `p`")
refused(function() t:chart{ x="p", y="A", fit=3 } end, "`fit` is the number 3")
refused(function() t:chart{ x="p", y="A", lines={ { name="a" } } } end, "`lines[1]` has neither x nor y")
refused(function() t:chart{ x="p", y="A", lines={ { y=1, nam="a" } } } end, "did you mean `name`?")
refused(function() book:chart{ x="N", y="size", lines={ { y="3 N" } } } end, "a line across `size`")
refused(function() t:chart{ x="p", y="A", functions={ a=3 } } end, "`functions.a` is the number 3")
refused(function() t:chart{ x="p", y="A", functions={ a=function() end } } end, "the function `functions.a` returned nothing")
refused(function() t:chart{ x="p", y="A", below={ x="p" } } end, "`y` is missing")
refused(function() t:chart{ x="p", y="A", interval="low" } end, "two columns' names")
refused(function() book:chart{ x="body", y="mu", log_x=true } end, "holds names")

-- Histograms.
local h = book:histogram{ of="mu", bins={ 0.4, 0.5, 0.6, 0.7 }, file="hist.svg" }
assert(h.counts[1] == 5 and h.counts[2] == 3 and h.counts[3] == 3 and h.n == 11 and h.left_out == 1)
local wide = book:histogram{ of="size", bins={ "1 um", "0.002 mm", 4 } }
assert(wide.counts[1] == 1 and wide.edges[2] == 2)
assert(book:histogram{ of="mu" }.rule == "Freedman-Diaconis")
refused(function() book:histogram{ of="mu", bins={ 1, 1 } } end, "edges ascend")
refused(function() book:histogram{ of="mu", bins=0 } end, "bins")
refused(function() book:histogram{ of="mv" } end, "`of` names `mv`")

-- Expectations in the unit of the column.
assert(book:expect("size", { where={ N=8 }, at_most="0.0026 mm", at_least="900 nm" }))
refused(function() book:expect("size", { near="2 N", rel=0.1 }) end, "size")
print "as it should be"
