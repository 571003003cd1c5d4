-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 7: is the rise of friction with the number of events larger than its whole error, and on what does that hang?
--
--   asperity run examples/budget_of_fig7.lua
--   asperity run examples/budget_of_fig7.lua -- pairs=16 kind=bead-blasted
--
-- The answer, over 8 self-affine pairs: 1.18 (0.94 to 1.42, 95 %) with spots on quartz that stay elastic, and 1.03 (0.97 to
-- 1.08) with spots that yield at the hardness that capped the presses. Neither rise is larger than its whole error. That of
-- the first is mostly alpha's, hardness's and tau0's (two thirds of the variance), then that of the pairs (a fifth); cells
-- leave half a per cent and the solver nothing. So a better measured alpha helps most, and more cells not at all.
-- The number is the friction of a specimen after eight events over that after one, mu = alpha + tau0 A/F on flat quartz.
-- Its error has parts that cost seconds (pairs of specimens, cells, the tolerance of the solver) and parts that cost
-- measurements: hardness, tau0 and alpha, each with a standard uncertainty that is assumed here and not measured.
-- In no budget is the error of the model. It is asked apart: the same budget is made of spots on quartz that stay
-- elastic and of spots that yield at the hardness which capped the presses. The uncertainties may be changed below.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local laboratory = require "asperity.laboratory"
local options = arguments({ pairs = 8, cells = 256, kind = "self-affine", runs = 64, half_width = 0.1 }, ...)

-- 1. One run: a pair of specimens through eight events, and its friction after the first and the last.
local function rise(x, yielding)
  local aluminium = lab.material "Al-2011"
  local metal = lab.material{ young = aluminium.young, poisson = aluminium.poisson, hardness = x.hardness }
  local lower, upper = laboratory.specimens{ kind = options.kind, pair = x.pair, cells = x.cells, material = metal }
  local after = laboratory.after_events(lower, upper, { seed = x.pair })
  local function friction(surface)
    local quartz = lab.contact{
      lower = surface, upper = lab.material "quartz", boundary = "periodic",
      effects = { elasticity = "half_space", plasticity = yielding and {} or nil }, accuracy = { tolerance = x.tolerance },
    }
    local st = quartz:press{ pressure = laboratory.probe }
    return x.alpha + x.tau0 * st.corrected_area_fraction / st.pressure
  end
  return friction(after[8]) / friction(after[1])
end

-- 2. The budget, for each of the two rules on quartz. The inputs are varied on the coarser cells, with the first pair.
local pairs_of_specimens = {}
for k = 1, options.pairs do pairs_of_specimens[k] = k end
local found, shares = lab.notebook "rises", lab.notebook "shares"
local rises = {}
for _, rule in ipairs{ "elastic", "yielding" } do
  local budget = lab.budget{
    ask = function(x) return rise(x, rule == "yielding") end,
    replicate = { pair = pairs_of_specimens },
    cells = { options.cells // 2, options.cells }, tolerance = { 1e-4, 1e-6 },
    inputs = {
      hardness = { value = "1.1 GPa", u = "5 %" }, tau0 = { value = "500 MPa", u = "10 %" },
      alpha = { value = 0.2, u = 0.03 },
    },
    runs = options.runs, half_width = options.half_width,
  }
  print(("friction after eight events over that after one, %s specimens, spots on quartz %s:"):format(options.kind, rule))
  print(budget)
  rises[rule] = budget
  found:write{ rule = rule, rise = budget.value, low = budget.low, high = budget.high, u = budget.u }
  for _, part in ipairs(budget.parts) do shares:write{ rule = rule, part = part.name, share = part.share, u = part.u } end
end

-- 3. The answer, and on what it hangs.
local function verdict(rule)
  local b = rises[rule]
  local sign = b.low > 1 and "a rise larger than its whole error" or b.high < 1 and "a fall larger than its whole error"
    or "no rise that its whole error leaves standing"
  return ("spots %s: %.2f (%.2f to %.2f), %s"):format(rule, b.value, b.low, b.high, sign)
end
print(verdict "elastic")
print(verdict "yielding")
print(("The two rules differ by %.2f, the whole error of either is ± %.2f: which of them holds on quartz is no part of a"):format(
  rises.elastic.value - rises.yielding.value, (rises.elastic.high - rises.elastic.low) / 2))
print "budget, and neither more pairs nor more cells decide it."
found:chart{ x = "rule", y = "rise", interval = { "low", "high" }, lines = { { y = 1, name = "no rise" } }, file = "rises.svg",
             x_label = "spots on quartz", y_label = "friction after eight events / after one",
             title = "The rise, with its whole error" }
shares:chart{ x = "part", y = "share", one_line_per = "rule", file = "shares.svg", title = "What the error is made of" }

-- 4. What must hold.
local checks = lab.notebook "checks"
checks:write{ more = rises.elastic.value - rises.yielding.value, low = rises.yielding.low, high = rises.yielding.high }
checks:expect("more", { at_least = 0, label = "spots that stay elastic show more of a rise than spots that yield" })
checks:expect("low", { at_most = 1, label = "of spots that yield no rise is left standing" })
