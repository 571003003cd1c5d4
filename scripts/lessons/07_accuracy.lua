-- Cells or seeds?
-- Question: You have one second to compute the approach of a rough face
--   under a load. Do you spend it on finer cells or on more faces?
-- Predict: Ten faces have the same statistics and fine cells. By how
--   many per cent do their results scatter? And by how many per cent is
--   the result of one face wrong on 64 cells a side?
-- Minutes: 20
--
-- The computed number of a rough face has three errors. The **solver**
-- stops when the contact conditions hold to a tolerance. The **cells**
-- contain the face at their nodes only. And the **seed** selects one
-- face of many with the same statistics; another face gives another
-- number.
--
-- A longer computation reduces the first two errors. Then you know
-- *this* face very well. But the question is about all faces of this
-- kind. More faces reduce the third error by the root of their number.
--
-- *Then try:* `quantity = "corrected_area_fraction"`, the contact area,
-- which scatters far less between faces. Is the answer still the same?
-- And the knob `within`: how many faces does 1 % need?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local my_guess = { scatter=nil, cells=nil } -- both in per cent
guess.names(my_guess, "scatter", "cells")
local quantity = "approach" -- or "corrected_area_fraction", "energy"

-- 1. One run: a face of steel under a rigid flat.
local function answer(x)
  local face = lab.surface.self_affine{ cells=x.cells, seed=x.seed,
    size="1 mm", hurst=0.8, rms_slope=0.1, roll_off="500 um",
    short_wave="62.5 um", material=lab.material "steel" }
  return lab.contact{ lower=face, upper=lab.rigid, boundary="periodic",
    effects={ elasticity="half_space" },
    accuracy={ tolerance=x.tolerance } }
    :press{ pressure="500 MPa" }[quantity]
end

-- 2. The same 32 faces on every grid. Each face is compared with itself
-- on 256 cells, and the mean with the mean on 256 cells. For the solver
-- a tolerance of 1e-3 is compared with 1e-9.
local seeds = {}
for seed = 1, 32 do seeds[seed] = seed end
local faces = lab.ensemble{
  over={ cells={ 32, 64, 128, 256 }, seed=seeds },
  run=function(case) return { y=answer(case) } end }
local fine = faces:where{ cells=256 }
local all = fine:mean "y"[1]
local scatter = all.sd / all.mean
lab.say("%s: %.3g, scatter %.1f [%]", quantity, all.mean, scatter)
local compared = faces:joined(fine, { by="seed", suffix="_fine" }):with{
  squared=function(row) return (row.y / row.y_fine - 1) ^ 2 end }
local tight = answer{ cells=128, seed=1, tolerance=1e-9 }
local loose = answer{ cells=128, seed=1, tolerance=1e-3 }

-- 3. The same number of nodes, spent in three ways. Two parts make up
-- the expected error: the cells in the mean, and the scatter over the
-- faces. A single trial can be lucky, so 20 trials with new faces give
-- the error that was found.
local book = lab.notebook "errors"
for _, cells in ipairs{ 32, 64, 128 } do
  local n = 128 ^ 2 // cells ^ 2 | 0
  local trials = lab.ensemble{
    over={ trial={ table.unpack(seeds, 1, 20) } },
    run=function(case)
      local y = 0
      for k = 1, n do
        y = y + answer{ cells=cells, seed=1000 * case.trial + k } / n
      end
      return { squared=(y / all.mean - 1) ^ 2 }
    end }
  local on = compared:where{ cells=cells }
  local shift = math.abs(on:sum "y" / #seeds / all.mean - 1)
  book:write{ cells=cells, faces=n, ["one face"]=scatter,
    ["32 faces"]=scatter / 32 ^ 0.5, solver=math.abs(loose / tight - 1),
    ["cells on a face"]=(on:sum "squared" / #seeds) ^ 0.5,
    ["cells in the mean"]=shift,
    expected=(shift ^ 2 + scatter ^ 2 / n) ^ 0.5,
    found=(trials:sum "squared" / 20) ^ 0.5 }
end
book:show{ "cells", "cells on a face [%]", "cells in the mean [%]",
  "one face [%]", "32 faces [%]", "solver [%]", digits=2 }
book:show{ "faces", "cells", "expected [%]", "found [%]", digits=2 }
book:chart{ x="cells", log_x=true, log_y=true, file="errors.svg",
  y={ "one face", "32 faces", "cells on a face", "cells in the mean" },
  y_label="relative error", title="One face cannot know what faces do" }
book:chart{ x="faces", y={ "expected", "found" }, log_x=true,
  log_y=true, file="ways.svg", y_label="relative error",
  title="Error with one face or many" }

-- 4. The error budget of the program, and the cheapest way to `within`.
-- Its seconds are those of this machine.
local within = lab.knob{ name="within", from=0.01, to=0.2, value=0.05 }
print(lab.budget{ ask=answer, half_width=within * all.mean,
  cells={ 64, 128 }, tolerance={ 1e-3, 1e-6 },
  replicate={ seed={ table.unpack(seeds, 1, 8) } } })

-- 5. Expectations, and the reason.
local coarse = book:where{ cells=32 }[1]
local finest = book:where{ cells=128 }
finest:expect("solver", { at_most=0.1 * scatter, label="negligible" })
finest:expect("cells on a face", { at_most=0.5 * scatter,
  label="128 cells: small compared with the scatter" })
finest:expect("cells on a face", { label="finer cells: half the error",
  at_most=0.5 * coarse["cells on a face"] })
finest:expect("expected", { at_least=1.5 * coarse.expected,
  label="the same nodes: 16 faces beat one finer face" })
book:expect("found", { where={ faces=16 }, at_most=0.12,
  label="16 faces find the mean to 12 per cent" })
guess{ said=my_guess.scatter, name="scatter", unit="%", near=0.4,
  found=100 * scatter, of="scatter of the faces" }
guess{ said=my_guess.cells, name="cells", unit="%", near=0.5,
  found=100 * book:where{ cells=64 }[1]["cells on a face"],
  of="error of 64 cells" }
require "asperity.prose"[[Why: independent errors add as squares, so the
largest decides. One face is wrong by the scatter on any cells. Cells
are fine enough if their error is well below the error of the mean; then
add faces. But the error of the cells in the mean stays with any number
of faces. A result from one seed is a result about this seed.]]
