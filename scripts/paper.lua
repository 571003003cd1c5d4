-- SPDX-License-Identifier: GPL-3.0-or-later
-- Functions shared by the examples of the source paper: Hanaor, Gan and Einav (2013), "Effects of surface structure
-- deformation on static friction at fractal interfaces", Geotechnique Letters 3. Its surfaces of eq. (2), its boxes
-- on a rigid flat, the load, and the averages over seeds. `require "asperity.paper"`. It measures nothing by itself:
-- each figure's script computes the numbers of the figure.
local lab = require "asperity"
local paper = {}

-- The paper gives L = 50, G = 5 and 150 x 150 cells, but not how far the grid reaches: preset A covers
-- one sample length L, preset B three (cells one unit wide). Both are shown everywhere.
paper.presets = { "A", "B" }
paper.spans = { A = 1, B = 3 }
paper.dimensions = { 2.0, 2.1, 2.2, 2.3, 2.4, 2.5, 2.6, 2.7, 2.8, 2.9 }

-- Boxes do not shear and do not widen (Poisson's ratio 0). Every ratio below is free of Young's modulus.
paper.young = 1e9
paper.box = lab.material{ name = "box elements", young = paper.young, poisson = 0 }
paper.pressure = 0.01 * paper.young

-- L and G in micrometres, so that lengths read like a specimen's; the peak-to-valley height is set to a
-- tenth of the side at every D ("constant amplitude"). `unscaled` leaves eq. (2)'s own heights.
function paper.surface(given)
  local cells = given.cells or 150
  local s = lab.surface.weierstrass_mandelbrot{
    cells = cells, D = given.D, seed = given.seed, span = paper.spans[given.preset],
    L = "50 um", G = "5 um", material = paper.box,
  }
  return given.unscaled and s or s:scaled{ amplitude = 0.1 * (cells - 1) * s.size[1] / cells }
end

-- The contact of such a surface with the rigid flat. A box is as stiff as a column of height A, which is
-- the surface's own peak-to-valley height unless it is given in metres.
function paper.contact(surface, A)
  return lab.contact{
    lower = surface, upper = lab.rigid,
    effects = { elasticity = A and { model = "box", stiffness = paper.young / A } or "box" },
  }
end

-- The same surfaces on an elastic half-space, free, at one load (0.006 E): means over `seeds` seeds for each preset
-- and D = 2.0 and 2.9; friction is computed with tau0 = 0.01 E and r = 0.1, without a cap.
function paper.on_half_space(seeds)
  local unit = lab.material{ young = 1, poisson = 0 }
  local rows = lab.ensemble{
    over = { preset = paper.presets, D = { 2.0, 2.9 }, seed = paper.count(seeds) },
    run = function(case)
      local span = require("asperity.paper").spans[case.preset]
      local s = lab.surface.weierstrass_mandelbrot{ cells = 150, D = case.D, span = span, seed = case.seed, material = unit }
      local c = lab.contact{ lower = s:scaled{ amplitude = 5 * span }, upper = lab.rigid, boundary = "free",
                             effects = { elasticity = "half_space" }, accuracy = { tolerance = 1e-5 } }
      local st = c:press{ pressure = 0.006 }
      return { area = st.corrected_area_fraction, secant = st.secant_stiffness, spots = st.spots,
               mu = lab.friction{ tau0 = 0.01, alpha = 0.001 }:on(st).mu }
    end,
  }
  return paper.means(rows, { "preset", "D" })
end

function paper.count(n)
  local list = {}
  for k = 1, n do list[k] = k end
  return list
end

-- The rows in which these columns hold these values.
function paper.where(rows, wanted)
  local found = {}
  for _, row in ipairs(rows) do
    local all = true
    for column, value in pairs(wanted) do all = all and row[column] == value end
    if all then found[#found + 1] = row end
  end
  return found
end

-- One row for each combination of the columns `keys`, in order of first appearance: the mean of every other column of
-- numbers, except `seed` and `pair`, which name a specimen, and its standard deviation (n - 1) as NAME_sd.
function paper.means(rows, keys)
  local groups, order, is_key = {}, {}, {}
  for _, key in ipairs(keys) do is_key[key] = true end
  for _, row in ipairs(rows) do
    local parts = {}
    for k, key in ipairs(keys) do parts[k] = tostring(row[key]) end
    local name = table.concat(parts, "|")
    if not groups[name] then
      groups[name] = {}
      order[#order + 1] = name
    end
    table.insert(groups[name], row)
  end
  local result = {}
  for k, name in ipairs(order) do
    local group, mean = groups[name], {}
    for column, value in pairs(group[1]) do
      if is_key[column] then
        mean[column] = value
      elseif math.type(value) and column ~= "seed" and column ~= "pair" then
        local sum, squares = 0, 0
        for _, row in ipairs(group) do sum = sum + row[column] end
        local centre = sum / #group
        for _, row in ipairs(group) do squares = squares + (row[column] - centre) ^ 2 end
        mean[column] = centre
        if #group > 1 then mean[column .. "_sd"] = math.sqrt(squares / (#group - 1)) end
      end
    end
    result[k] = mean
  end
  return result
end

return paper
