-- SPDX-License-Identifier: GPL-3.0-or-later
-- Means with intervals, fits, histograms and charts of tables and notebooks, and what they refuse.
--! output: as it should be
--! output: mu [%] size [nm]
--! output: size 2.1 um, 12 rows, done, 50 %, 100 %
--! error: the scatter of fewer than five is uncertain
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
    book:write{ N=N, mu=value, ["size [um]"]=2 + 0.1 * k, load=10 * i, body=i == 1 and "worn" or "new " .. i, u=0.01 * k }
  end
end
book:write{ N=8, ["size [um]"]=1, load=5 }

-- Means.
local means = book:mean("mu", { by="N" })
local rows = means:rows()
assert(#rows == 3 and rows[1].N == 1 and rows[2].N == 8 and rows[3].N == 20)
near(rows[2].mean, 0.424)
assert(rows[2].n == 5 and rows[2].left_out == 1 and rows[2].interval == "Student's t, 4 degrees of freedom")
near(rows[2].high - rows[2].mean, 2.7764451051977943578 * rows[2].sd / math.sqrt(5))
near(rows[2].u, rows[2].sd / math.sqrt(5))
assert(tostring(means):find("low to high is their 95 % interval", 1, true), tostring(means))
assert(tostring(book):find('notebook "trials": 12 rows of 6 columns', 1, true), tostring(book))
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
local own = t:fit{ x="p", y="A", model=function(q, row) return q.a + q.b * row.p end, start={ a=0, b=1 } }
near(own.values.b, line.values.slope, 1e-10)
near(own.parameters.a.u, line.parameters.intercept.u, 1e-8)
near(own.curve.high[50], line.curve.high[50], 1e-9)
local power = t:fit{ x="p", y="A", model="power", name="a p^b" }
assert(power.values.b > 0.7 and power.values.b < 1 and power.r_squared > 0.99)
refused(function() line.parameters.slop() end, "has no field `slop`", "did you mean `slope`?")
refused(function() t:fit{ x="p", y="A", model="cubic" } end, "model")
refused(function() t:fit{ x="p", y="A", model=function(q, row) return q.a * row.p end } end, "`start` is missing")
refused(function() t:fit{ x="p", y="A", model="power", start={ a=1 } } end, "`start` has no effect")
refused(function() t:fit{ x="p", y="A", model=function(q, row) return q.c * row.p end, start={ a=1 } } end, "the function `model` failed")
refused(function() t:fit{ x="p", y="A", model=function(q, row) return "much" end, start={ a=1 } } end, "the function `model` returned")
refused(function() t:fit{ x="p", y="A", model=function(q, row) return (q.tau0 + q.alpha) * row.p end, start={ tau0=1, alpha=1 } } end,
  "alpha and tau0 are not identifiable: only alpha + tau0 = ")
refused(function() book:fit{ x="N", y="body", model="linear" } end, 'column `body` holds the text "worn"')
refused(function() book:fit{ x="N", y="mu", model="linear", where={ N=8 } } end, "cannot separate `intercept` and `slope`")
local weighted = book:fit{ x="N", y="mu", model="linear", weights="u" }
assert(weighted.n == 11 and weighted.left_out == 1)
refused(function() book:fit{ x="N", y="mu", model="linear", weights="u", u=0.1 } end, "`weights` and `u` both set the weights of rows")

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
local h = book:histogram("mu", { bins={ 0.4, 0.5, 0.6, 0.7 }, file="hist.svg" })
assert(h.counts[1] == 5 and h.counts[2] == 3 and h.counts[3] == 3 and h.n == 11 and h.left_out == 1)
local wide = book:histogram("size", { bins={ "1 um", "0.002 mm", 4e-6 } })
assert(wide.counts[1] == 1 and wide.edges[2] == 2e-6)
assert(book:histogram("size [nm]", { bins={ 1000, 2000, 4000 } }).counts[1] == 1)
assert(book:histogram("mu").rule == "Freedman-Diaconis")
refused(function() book:histogram("mu", { bins={ 1, 1 } }) end, "edges ascend")
refused(function() book:histogram("mu", { bins=0 }) end, "bins")
refused(function() book:histogram("mv") end, "`column` names `mv`")

-- Rows in SI, sorted, computed, reduced.
assert(book[1].size == 2.1e-6 and book[13] == nil and #book == 12)
local seen = 0
for row in book:each() do seen = seen + row.N end
assert(seen == 8 * 6 + 3 + 60 and book:sum "N" == seen and book:min "load" == 5 and book:max "load" == 30)
local largest = book:sorted{ by={ "N", "mu" }, descending=true }
assert(largest[1].N == 20 and largest[1].mu == 0.66 and largest[12].N == 1 and largest[12].mu == 0.5)
local wider = book:with{ ["double [nm]"]=function(row) return 2e9 * row.size end, size=function(row) return row.size end }
near(wider[1].double, 4.2e-6)
assert(wider.units.double == "nm" and wider.units.size == "um" and book.columns[7] == nil)
refused(function() book:with{ bad=function(row) return {} end } end, "the function of `bad` failed in row 1: it returned")
refused(function() wider:write{ N=1 } end, "a table takes no rows")
refused(function() book:max "body" end, "holds the text")
assert(#book:where{ ["size [um]"]=1 } == 1 and #book:where{ size=1e-6 } == 1 and #book:where{ size="1 um" } == 1)
assert(wider:expect("double [um]", { where={ N=8 }, near=4.4, within=0.3, should_fail=true }))
book:units{ size="nm" }
assert(book[1].size == 2.1e-6 and book:table().units.size == "nm")
book:units{ size="um" }
book:where{ N=20 }:show{ "mu [%]", "size [nm]", digits=3 }
lab.say("size %.1f [um], %d rows, %s, %.0f [%], 100 %%", book[1].size, #book, "done", 0.5)

-- Expectations in the unit of the column.
assert(book:expect("size", { where={ N=8 }, at_most="0.0026 mm", at_least="900 nm" }))
refused(function() book:expect("size", { near="2 N", rel=0.1 }) end, "size")
print "as it should be"
