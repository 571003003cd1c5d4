-- Cells or seeds?
-- Question: You have one second to compute how far a rough face gives
--   way. Is it better spent on finer cells or on more faces?
-- Predict: Ten faces of one recipe, on cells fine enough: by how many
--   per cent do their answers scatter? And how many per cent is one
--   face wrong on 64 cells a side?
-- Minutes: 20
--
-- Three errors hide in the number that you compute for a rough face.
-- The **solver** stops when the contact conditions hold to a tolerance.
-- The **cells** know the face at their nodes alone. And the **seed**
-- picked one face of all that the recipe allows: another would have
-- answered something else.
--
-- The first two can be made small by computing longer. Do that to one
-- face, and you know very well what *that* face does. But the question
-- was about faces of that kind. So the third error is made small by
-- more faces, with one over the root of their number.
--
-- *Your prediction:* put its numbers into `my_guess` in the script; the
-- last lines compare them with what was found.
--
-- *Then try:* `quantity = "corrected_area_fraction"`, the share that
-- touches. Its faces scatter far less. Is the answer still the same?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local my_guess = { scatter=nil, cells=nil } -- both in per cent
guess.names(my_guess, "scatter", "cells")
local quantity = "approach" -- or "corrected_area_fraction", "energy"
local steel = lab.material "steel"

-- 1. One run: a face of steel under a rigid flat.
local function answer(x)
  local face = lab.surface.self_affine{
    cells=x.cells, size="1 mm", hurst=0.8, rms_slope=0.1,
    roll_off="500 um", short_wave="62.5 um", seed=x.seed,
    material=steel }
  local c <close> = lab.contact{
    lower=face, upper=lab.rigid, boundary="periodic",
    effects={ elasticity="half_space" },
    accuracy={ tolerance=x.tolerance or 1e-6 } }
  return c:press{ pressure="500 MPa" }[quantity]
end
local function numbers_to(n)
  local list = {}
  for k = 1, n do list[k] = k end
  return list
end

-- 2. The same 64 faces on every grid. A face is compared with itself
--    on 256 cells, and with the mean of all.
local grids = { 32, 64, 128 }
local rows = lab.ensemble{ over={ seed=numbers_to(64) },
  run=function(case)
    local row = { fine=answer{ cells=256, seed=case.seed } }
    for _, cells in ipairs(grids) do
      row["on " .. cells] = answer{ cells=cells, seed=case.seed }
    end
    return row
  end }
local faces = lab.table.from(rows)
local all = faces:mean "fine"
local mean, scatter = all:column "mean"[1], all:column "sd"[1]
scatter = scatter / mean
print(("%s of 64 faces on 256 cells: %.3g, and they scatter by %.1f %%")
  :format(quantity, mean, 100 * scatter))

local loose = answer{ cells=128, seed=1, tolerance=1e-3 }
local tight = answer{ cells=128, seed=1, tolerance=1e-9 }
local solver = math.abs(loose / tight - 1)
print(("the solver's error at a tolerance of 1e-3: %.2g %%")
  :format(100 * solver))

local errors, of_cells, of_means = lab.notebook "errors", {}, {}
print "cells   error on one face   of the mean   scatter of faces"
for _, cells in ipairs(grids) do
  local squares, sum = 0, 0
  for _, row in ipairs(rows) do
    squares = squares + (row["on " .. cells] / row.fine - 1) ^ 2
    sum = sum + row["on " .. cells]
  end
  of_cells[cells] = math.sqrt(squares / #rows)
  of_means[cells] = math.abs(sum / #rows / mean - 1)
  errors:write{ cells=cells, ["cells, on one face"]=of_cells[cells],
    ["cells, in the mean"]=of_means[cells], ["one face"]=scatter,
    ["64 faces"]=scatter / 64 ^ 0.5 }
  print(("%5d   %10.2g %%     %10.2g %%   %8.2g %%"):format(cells,
    100 * of_cells[cells], 100 * of_means[cells], 100 * scatter))
end
errors:chart{ x="cells", y={ "one face", "64 faces",
                "cells, on one face", "cells, in the mean" },
              log_x=true, log_y=true, file="errors.svg",
              title="One face cannot know what faces do",
              y_label="relative error of the " .. quantity }

-- 3. The same number of nodes, spent in three ways. What is expected is
--    the root of two squares, cells in the mean and scatter over the
--    faces; what came out in 32 trials with new faces is beside it,
--    for a single trial may be lucky.
local nodes = 128 ^ 2
local ways, expected = lab.notebook "ways", {}
print "\nthe same 16384 nodes    expected error    in 32 trials"
for _, cells in ipairs(grids) do
  local n = nodes // cells ^ 2 | 0
  local found = lab.ensemble{
    over={ trial=numbers_to(32), seed=numbers_to(n) },
    run=function(case)
      local seed = 1000 * case.trial + case.seed
      return { y=answer{ cells=cells, seed=seed } }
    end }
  local sums, squares = {}, 0
  for _, row in ipairs(found) do
    sums[row.trial] = (sums[row.trial] or 0) + row.y / n
  end
  for _, y in ipairs(sums) do squares = squares + (y / mean - 1) ^ 2 end
  expected[cells] = math.sqrt(of_means[cells] ^ 2 + scatter ^ 2 / n)
  local row = { faces=n, cells=cells, expected=expected[cells],
                found=math.sqrt(squares / 32) }
  ways:write(row)
  print(("  %3d faces on %3d^2      %6.2g %%         %6.2g %%")
    :format(n, cells, 100 * row.expected, 100 * row.found))
end
ways:chart{ x="faces", y={ "expected", "found" }, log_x=true,
            log_y=true, file="ways.svg",
            title="The same nodes, for one face or for many",
            y_label="relative error of the " .. quantity }

-- 4. Let the program draw up the account.
local budget = lab.budget{ ask=answer, replicate={ seed=numbers_to(8) },
                           cells={ 64, 128 }, tolerance={ 1e-3, 1e-6 },
                           half_width=0.05 * mean }
print("\n" .. tostring(budget))

-- 5. What must hold. Times are shown, never asked for: they belong to
--    the machine.
local checks = lab.notebook "checks"
checks:write{ solver=solver / scatter, cells=of_cells[128] / scatter,
              finer=of_cells[128] / of_cells[32],
              one=expected[128] / expected[32] }
checks:expect("solver", { at_most=0.1,
  label="the solver's error is small beside the scatter of faces" })
checks:expect("cells", { at_most=0.5,
  label="so is that of 128 cells" })
checks:expect("finer", { at_most=0.5,
  label="finer cells help a face: half the error or less" })
checks:expect("one", { at_least=1.5,
  label="the same nodes: 16 faces beat one finer face" })
ways:expect("found", { where={ faces=16 }, at_most=0.12,
  label="16 faces find the mean to 12 per cent" })

print ""
guess{ said=my_guess.scatter, found=100 * scatter, unit="%",
       of="scatter of the faces" }
guess{ said=my_guess.cells, found=100 * of_cells[64], unit="%",
       of="error of 64 cells" }
print(([[
Why: errors that know nothing of each other add as squares, and the
largest decides. One face is off by some %.1f %% on any cells; beside
that, 128 a side are %.2g %% wrong and 64 a side %.2g %%. So cells are
fine enough when their error is well below that of the mean, and from
there on each second belongs to another face. There is an end to it:
what is wrong in the mean on 32 cells, %.2g %%, stays however many
faces there are, and more of them only make a wrong number look sure.
The budget says which part is the largest, what it costs to halve it,
and what is cheapest for 5 %%.
An answer from one seed is an answer about that seed.]])
  :format(100 * scatter, 100 * of_cells[128], 100 * of_cells[64],
    100 * of_means[32]))
