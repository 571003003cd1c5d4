-- What accuracy costs
-- Question: A computed number is wrong. By how much, and what does it cost to make it better?
-- Predict: Half the cell width, so four times the cells: how many times longer does the press take, and how many
--   times smaller is the error? And what does it help to solve a hundred times more tightly on the same cells?
-- Minutes: 20
--
-- Two errors hide in every computed contact. The **grid** knows the face at its nodes alone: that error goes when
-- cells get smaller. The **solver** stops when the contact conditions hold to a tolerance: that error goes when it is
-- made tighter. Do they help each other?
--
-- A ball on a flat has an exact answer: Hertz found in 1882 how far it comes down under a load, on how large a disc it
-- touches and with what pressure. So here the error is known. Two ways are tried: ever finer
-- grids, and on one grid ever tighter solves. Then the program is asked what it *thinks* its errors are.
--
-- *Your prediction:* put its numbers into `my_guess` in the script; the last lines compare them with what was
-- found.
--
-- *Then try:* `quantity = "area"`, which is a count of nodes. How much dearer is one per cent of it?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local my_guess = { longer=nil, closer=nil }
local quantity = "approach" -- how far the ball comes down; or "area", or "peak_pressure"
local steel = lab.material "steel"
local exact = lab.exact.hertz{ radius="100 um", modulus=steel.young / (1 - steel.poisson ^ 2), load="50 mN" }[quantity]

-- 1. A steel ball on a rigid flat.
local function press(knobs)
  local ball = lab.surface.sphere{ cells=knobs.cells, size="20 um", radius="100 um", shape="paraboloid",
                                   material=steel }
  local c = lab.contact{ lower=ball, upper=lab.rigid, boundary="free", effects={ elasticity="half_space" },
                         accuracy={ tolerance=knobs.tolerance, estimate=knobs.estimate or false } }
  return c:press{ load="50 mN" }
end
local study = lab.work_precision{
  ask = function(knobs) return press(knobs)[quantity] end,
  truth = exact,
  try = { { name="finer grid", cells={ 16, 32, 64, 128, 256 }, tolerance=1e-6 },
          { name="tighter, 64 cells", cells=64, tolerance={ 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8 } },
          { name="tighter, 256 cells", cells=256, tolerance={ 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8 } } },
  repeats = 3,
}
study:chart "cost.svg"
local errors, seconds = lab.notebook "errors", {}
print "way                  cells  tolerance   error"
for _, row in ipairs(study:rows()) do
  errors:write{ way=row.way, cells=row.cells, tolerance=row.tolerance, error=row.error }
  if row.way == "finer grid" then seconds[row.cells] = row.seconds end
  print(("%-20s %4d   %-8g    %.2g"):format(row.way, row.cells, row.tolerance, row.error))
end
errors:chart{ x="tolerance", y="error", one_line_per="way", where={ way={ "tighter, 64 cells", "tighter, 256 cells" } },
              log_x=true, log_y=true, file="tolerance.svg", title="Tighter helps until the grid decides",
              x_label="tolerance of the solver", y_label="error of the " .. quantity }

-- 2. What the program thinks, without knowing Hertz.
local thought = lab.notebook "estimates"
print "\ncells   true error   estimated: the grid   bound: the solver"
for _, cells in ipairs{ 32, 64, 128, 256 } do
  local st = press{ cells=cells, tolerance=1e-6, estimate=true }
  local row = { cells=cells, ["true error"]=math.abs(st[quantity] - exact) / exact,
    grid=st.error.discretisation[quantity] / exact, solver=st.error.algebraic[quantity] / exact }
  row["true over estimated"] = row["true error"] / (row.grid + row.solver)
  thought:write(row)
  print(("%4d    %.2g      %.2g               %.1g"):format(cells, row["true error"], row.grid, row.solver))
end
local drawn = quantity == "area" and { "true error", "grid" } or { "true error", "grid", "solver" }
thought:chart{ x="cells", y=drawn, log_x=true, log_y=true, file="estimates.svg",
               y_label="relative error of the " .. quantity, title="What the program says of itself" }

-- 3. What must hold, and why. Times are shown, never asked for: they belong to the machine.
local function error_of(way, cells, tolerance)
  for _, row in ipairs(errors:rows()) do
    if row.way == way and row.cells == cells and row.tolerance == tolerance then return row.error end
  end
end
local closer = error_of("finer grid", 128, 1e-6) / error_of("finer grid", 256, 1e-6)
local wasted = error_of("tighter, 64 cells", 64, 1e-6) / error_of("tighter, 64 cells", 64, 1e-8)
local checks = lab.notebook "checks"
checks:write{ closer=closer, wasted=wasted }
checks:expect("closer", { at_least=2, label="half the cell width: at most half the error" })
checks:expect("wasted", { near=1, within=0.05, label="a hundred times tighter on 64 cells: nothing gained" })
errors:expect("error", { where={ way="tighter, 256 cells", tolerance={ 1e-1, 1e-2, 1e-3, 1e-4 } },
                         increasing_in="tolerance", label="where the solver's error is the larger, tighter helps" })
thought:expect("true over estimated", { at_most=3, label="the true error is within three times what it said" })

-- By how much each step of the finer grids divided the error, and where a coarser grid was nearer than a finer one.
local function signed(cells) return press{ cells=cells, tolerance=1e-6 }[quantity] - exact end
local falls, luck = {}, "Every one of them helped."
for _, cells in ipairs{ 16, 32, 64, 128 } do
  local fall = error_of("finer grid", cells, 1e-6) / error_of("finer grid", 2 * cells, 1e-6)
  table.insert(falls, fall < 1 and ("multiplied by %.2g"):format(1 / fall) or ("divided by %.2g"):format(fall))
  if fall < 1 then
    local crosses = signed(cells) * signed(2 * cells) < 0 or cells > 16 and signed(cells // 2) * signed(cells) < 0
    luck = ("That %d cells did better than %d is luck: %s"):format(cells, 2 * cells, crosses
      and "the error changes its sign near there." or "one error may be small by chance, and nobody may count on it.")
  end
end
local longer, steps = seconds[256] / seconds[128], {}
for _, cells in ipairs{ 128, 256 } do steps[cells] = press{ cells=cells, tolerance=1e-6 }.iterations end
local work = 4 * steps[256] / steps[128]
local price = longer < work and "Not all that a press does grows with its nodes, so it was less."
  or "It was not less here: a step on more nodes is a little dearer for each of them."
print(("\nFrom 128 to 256 cells it took %.1f times longer here, and came %.1f times closer."):format(longer, closer))
guess{ said=my_guess.longer, found=longer, of="times longer" }
guess{ said=my_guess.closer, found=closer, of="times closer" }
print(([[
Why: four times the nodes, and %d steps of the solver instead of %d: %.1f times the work.
%s
A grid knows nothing of what lies between its nodes, above all of the rim of the contact. In the four steps from 16 to
256 cells the error was %s.
%s
Solving to 1e-8 instead of 1e-6 on 64 cells changed the error by a factor of %.2f: that error was the grid's, and no
solver can mend it. The two errors do not help each other: the larger one decides, and work on the smaller is wasted.
The chart cost.svg is how to choose: for the error you can live with, take the point furthest to the left. Ask
print(study:cheapest{ error=0.01 }) to have it done.
Without Hertz you would not know the true error. The program gives its own two, and keeps them apart: a bound for
the solver, and for the grid an estimate that the true error mostly stays within three times of.]]):format(
  steps[256], steps[128], work, price,
  table.concat(falls, ", "), luck, wasted))
