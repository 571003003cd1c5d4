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
  local s = lab.surface.weierstrass_mandelbrot{ cells = cells, D = given.D, seed = given.seed,
    span = paper.spans[given.preset], L = "50 um", G = "5 um", material = paper.box }
  return given.unscaled and s or s:scaled{ amplitude = 0.1 * (cells - 1) * s.size[1] / cells }
end

-- The contact of a fractal surface with the rigid flat. A box is as stiff as a column of height A (m), by default
-- the surface's peak-to-valley height.
function paper.contact(surface, A)
  return lab.contact{ lower = surface, upper = lab.rigid,
    effects = { elasticity = A and { model = "box", stiffness = paper.young / A } or "box" } }
end

-- Such surfaces on an elastic half-space, free, at one load (0.006 E): means over `seeds` seeds for each preset at
-- D = 2.0 and 2.9. Friction has tau0 = 0.01 E and r = 0.1, without a cap.
function paper.on_half_space(seeds)
  local unit = lab.material{ young = 1, poisson = 0 }
  local rows = lab.ensemble{
    over = { preset = paper.presets, D = { 2.0, 2.9 }, seed = paper.count(seeds) },
    run = function(case)
      local span = paper.spans[case.preset]
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

-- The list of `n` whole numbers from `first` (1) on.
function paper.count(n, first)
  local list = {}
  for k = 1, n do list[k] = (first or 1) + k - 1 end
  return list
end

-- Means of the columns of numbers, one row for each combination of the columns `keys`, and their standard deviations
-- (n - 1) as NAME_sd. `seed` and `pair` name a specimen and have no mean. `file` is a CSV.
function paper.means(rows, keys, file)
  local groups, means, is_key = {}, {}, {}
  for _, key in ipairs(keys) do is_key[key] = true end
  for _, row in ipairs(rows:sorted{ by = keys }) do
    local group = groups[#groups]
    local same = group ~= nil
    for _, key in ipairs(keys) do same = same and group[1][key] == row[key] end
    if same then table.insert(group, row) else table.insert(groups, { row }) end
  end
  for k, group in ipairs(groups) do
    means[k] = {}
    for column, value in pairs(group[1]) do
      if is_key[column] then
        means[k][column] = value
      elseif math.type(value) and column ~= "seed" and column ~= "pair" then
        local sum, squares = 0, 0
        for _, row in ipairs(group) do sum = sum + row[column] end
        local mean = sum / #group
        for _, row in ipairs(group) do squares = squares + (row[column] - mean) ^ 2 end
        means[k][column], means[k][column .. "_sd"] = mean, math.sqrt(squares / (#group - 1))
      end
    end
  end
  local result = lab.table.from(means)
  if file then result:write(file) end
  return result
end

-- A table with one row for each entry of the list `list` of every case: the cells of the case and of the entry.
function paper.unfolded(cases, list, file)
  local rows = {}
  for _, case in ipairs(cases) do
    for _, entry in ipairs(case[list]) do
      local row = {}
      for name, value in pairs(case) do row[name] = type(value) ~= "table" and value or nil end
      for name, value in pairs(entry) do row[name] = value end
      table.insert(rows, row)
    end
  end
  local result = lab.table.from(rows)
  if file then result:write(file) end
  return result
end

-- Prints one line for each combination of the columns `keys`, with the cells of the column `of` for each value of the
-- column `across`.
function paper.show_across(rows, given)
  local names, wide = { digits = given.digits, table.unpack(given.keys) }, nil
  for _, value in ipairs(given.values) do
    local name = ("%s = %g"):format(given.across, value)
    local part = rows:where{ [given.across] = value }:with{ [name] = function(row) return row[given.of] end }
    wide = wide and wide:joined(part, { by = given.keys, suffix = " at " .. name }) or part
    table.insert(names, name)
  end
  wide:show(names)
end

-- Expects known values. A line of `known` holds the values of the columns `keys`, which select a row, and then those
-- of the columns in `within`, a list of { column, greatest distance }.
function paper.agree(rows, keys, within, known)
  for _, line in ipairs(known) do
    local where = {}
    for k, key in ipairs(keys) do where[key] = line[k] end
    for k, of in ipairs(within) do
      rows:expect(of[1], { where = where, near = line[#keys + k], within = of[2] })
    end
  end
end

return paper
