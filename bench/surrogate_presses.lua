-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cost and error of a surrogate for thousands of presses: Legendre polynomials (total degree 1 to 4) for the
-- logarithm of the corrected area in log pressure, log slope and Hurst exponent, least squares on `train`
-- presses, tested on `test`. First all presses share one seed (a smooth area), then each has its own. Presses
-- as in bench/ensemble_presses.lua.
--
--   asperity run bench/surrogate_presses.lua -- train=400 test=400
local lab = require "asperity"
local arguments = require "asperity.arguments"
local options = arguments({ train = 200, test = 200, cells = 256 }, ...)

local material = lab.material{ young = 1e9, poisson = 0, hardness = 5e7 }
local names = { "pressure", "slope", "hurst" }
local cells = options.cells

-- In [-1, 1], evenly filling the cube (Kronecker sequence of the plastic number).
local function inputs(count, from)
  local cases = {}
  for k = 1, count do
    local x = {}
    for d, step in ipairs{ 0.8191725133961645, 0.6710436067037893, 0.5497004779019703 } do
      x[names[d]] = 2 * ((0.5 + (from + k) * step) % 1) - 1
    end
    cases[k] = x
  end
  return cases
end

local function presses(count, from, seed)
  local cases = inputs(count, from)
  for k, case in ipairs(cases) do case.seed = seed or from + k end
  return lab.ensemble{ cases = cases, run = function(case)
    local slope = 0.1 * 2 ^ case.slope
    local surface = lab.surface.self_affine{ cells = cells, size = 1, hurst = 0.75 + 0.15 * case.hurst, rms_slope = slope,
      roll_off = 0.5, short_wave = 1 / 32, seed = case.seed, material = material }
    local contact = lab.contact{ lower = surface, upper = lab.rigid, boundary = "periodic",
      effects = { elasticity = "half_space" }, accuracy = { tolerance = 1e-2 } }
    return { area = contact:press{ pressure = 5e6 * 3 ^ case.pressure }.corrected_area_fraction }
  end }
end

local function legendre(n, x)
  local before, now = 1, x
  if n == 0 then return 1 end
  for k = 1, n - 1 do before, now = now, ((2 * k + 1) * x * now - k * before) / (k + 1) end
  return now
end
local function terms(degree)
  local list = {}
  for a = 0, degree do
    for b = 0, degree - a do
      for c = 0, degree - a - b do list[#list + 1] = { a, b, c } end
    end
  end
  return list
end
local function values(row, list)
  local v = {}
  for k, t in ipairs(list) do
    v[k] = legendre(t[1], row.pressure) * legendre(t[2], row.slope) * legendre(t[3], row.hurst)
  end
  return v
end

-- Normal equations: the basis is nearly orthogonal on these points.
local function fit(rows, list)
  local n, A = #list, {}
  for i = 1, n do A[i] = {} for j = 1, n + 1 do A[i][j] = 0 end end
  for _, row in ipairs(rows) do
    local v, y = values(row, list), math.log(row.area)
    for i = 1, n do
      for j = 1, n do A[i][j] = A[i][j] + v[i] * v[j] end
      A[i][n + 1] = A[i][n + 1] + v[i] * y
    end
  end
  for i = 1, n do
    for below = i + 1, n do
      local factor = A[below][i] / A[i][i]
      for j = i, n + 1 do A[below][j] = A[below][j] - factor * A[i][j] end
    end
  end
  local c = {}
  for i = n, 1, -1 do
    local rest = A[i][n + 1]
    for j = i + 1, n do rest = rest - A[i][j] * c[j] end
    c[i] = rest / A[i][i]
  end
  return c
end

local function held_against(rows, list, c)
  local squares, mean, of_surrogate = 0, 0, 0
  for _, row in ipairs(rows) do
    local predicted = 0
    for k, v in ipairs(values(row, list)) do predicted = predicted + c[k] * v end
    squares = squares + (predicted - math.log(row.area)) ^ 2
    mean, of_surrogate = mean + row.area, of_surrogate + math.exp(predicted)
  end
  return math.sqrt(squares / #rows), of_surrogate / mean - 1
end

for _, way in ipairs{ { "one surface", 1 }, { "a surface each" } } do
  local trained = presses(options.train, 0, way[2])
  local kept_aside = presses(options.test, options.train, way[2])
  for degree = 1, 4 do
    local list = terms(degree)
    if #trained >= 2 * #list then
      local off, mean = held_against(kept_aside, list, fit(trained, list))
      print(("%s, degree %d (%d terms) on %d presses: rms error %.2f %% of a press kept aside, %+.2f %% of the mean of %d")
        :format(way[1], degree, #list, #trained, 100 * off, 100 * mean, #kept_aside))
    end
  end
end
