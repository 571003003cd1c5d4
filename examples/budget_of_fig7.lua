-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 7: is the rise of friction with the number of events larger than its whole error, and on what does that hang?
--
--   asperity run examples/budget_of_fig7.lua
--
-- Over 8 self-affine pairs: no. The rise is 1.18 (0.94 to 1.42, 95 %) with elastic spots on quartz,
-- and 1.00 (0.94 to 1.06) with spots that yield at the hardness of the presses. For elastic spots,
-- alpha, hardness and tau0 cause two thirds of the variance, the pairs a fifth, the cells 1 %.

local lab = require "asperity"
local laboratory = require "asperity.laboratory"
local paper = require "asperity.paper"
local defaults = { pairs = 8, cells = 256, kind = "self-affine", runs = 64, half_width = 0.1 }
local options = require "asperity.arguments"(defaults, ...)

-- 1. One run: the friction of a pair after eight events over its friction after one. Friction is
--    mu = alpha + tau0 A/F on flat quartz.
local function rise(x, yielding)
  local aluminium = lab.material "Al-2011"
  local metal = lab.material{ young = aluminium.young, poisson = aluminium.poisson, hardness = x.hardness }
  local given = { kind = options.kind, pair = x.pair, cells = x.cells, material = metal }
  local lower, upper = laboratory.specimens(given)
  local after = laboratory.after_events(lower, upper, { seed = x.pair })
  local function friction(surface)
    local st = lab.contact{ lower = surface, upper = lab.material "quartz", boundary = "periodic",
      effects = { elasticity = "half_space", plasticity = yielding and {} or nil },
      accuracy = { tolerance = x.tolerance } }:press{ pressure = laboratory.probe }
    return x.alpha + x.tau0 * st.corrected_area_fraction / st.pressure
  end
  return friction(after[8]) / friction(after[1])
end

-- 2. A budget for each rule on quartz: no budget contains the error of the model. The inputs are
--    varied on the coarser cells, with the first pair. The standard uncertainties of hardness, tau0
--    and alpha are assumed, not measured; you can change them here.
local found, shares = lab.notebook "rises", lab.notebook "shares"
for _, rule in ipairs{ "elastic", "yielding" } do
  local budget = lab.budget{
    ask = function(x) return rise(x, rule == "yielding") end,
    replicate = { pair = paper.count(options.pairs) },
    cells = { options.cells // 2, options.cells }, tolerance = { 1e-4, 1e-6 },
    inputs = { hardness = { value = "1.1 GPa", u = "5 %" },
      tau0 = { value = "500 MPa", u = "10 %" }, alpha = { value = 0.2, u = 0.03 } },
    runs = options.runs, half_width = options.half_width,
  }
  lab.say("Friction after eight events over one, %s specimens, spots on quartz %s:", options.kind, rule)
  print(budget)
  found:write{ rule = rule, rise = budget.value, low = budget.low, high = budget.high, u = budget.u }
  for _, part in ipairs(budget.parts) do
    shares:write{ rule = rule, part = part.name, share = part.share, u = part.u }
  end
end

-- 3. The result and its shares.
for row in found:each() do
  local verdict = row.low > 1 and "a rise larger than its whole error"
    or row.high < 1 and "a fall larger than its whole error"
    or "no rise that its whole error leaves standing"
  lab.say("spots %s: %.2f (%.2f to %.2f), %s", row.rule, row.rise, row.low, row.high, verdict)
end
local elastic, yielding = found[1], found[2]
lab.say("The two rules differ by %.2f, and the whole error of the elastic one is ± %.2f.",
  elastic.rise - yielding.rise, (elastic.high - elastic.low) / 2)
print "Which rule holds on quartz is no part of a budget, and neither more pairs nor more cells decide it."
found:chart{ x = "rule", y = "rise", interval = { "low", "high" },
  lines = { { y = 1, name = "no rise" } }, file = "rises.svg", x_label = "spots on quartz",
  y_label = "friction after eight events / after one", title = "The rise, with its whole error" }
shares:chart{ x = "part", y = "share", one_line_per = "rule", file = "shares.svg",
  title = "What the error is made of" }

-- 4. Expectations.
found:expect("rise", { where = { rule = "elastic" }, at_least = yielding.rise,
  label = "spots that stay elastic show more of a rise than spots that yield" })
found:expect("low", { where = { rule = "yielding" }, at_most = 1,
  label = "of spots that yield no rise is left standing" })
