-- SPDX-License-Identifier: GPL-3.0-or-later
-- Success rate of accuracy={ error= }, and cost relative to the cheapest grid within the error: random scenes
-- of each kind; 10, 3 and 1 % of the corrected area fraction. Truth: corrected area on truth x truth cells
-- (boxes: the counted area, which has no bias). Settings: 32, 64 ... truth/2 cells at the default tolerance;
-- the cheapest within the error counts, even by luck. Cost: transforms times n log n (boxes: one per press);
-- a choice includes all grids tried. A refusal is a miss. The rules were developed on seeds 1 to 10;
-- docs/accuracy.md has seeds 101 to 140.
--
--   asperity run --threads 1 bench/requested_error.lua -- first=101 last=140
--   asperity run --threads 1 bench/requested_error.lua -- first=1 last=2 kinds=ball,pairs
local lab = require "asperity"
local arguments = require "asperity.arguments"
local options = arguments({ first = 101, last = 103, truth = 1024, given = 256, list = 0,
  kinds = "ball,blasted,capped_blasted,wm,periodic,free,capped,hardening,pairs,hardening_pairs,boxes,function" }, ...)
local requested = { 0.1, 0.03, 0.01 }
local material = lab.material{ young = 1e9, poisson = 0 }

-- { make = function(cells) returns lower, upper, boundary, effects, pressure }
local function scene(kind, seed)
  local state = seed * 7919 + #kind * 104729 + kind:byte(1) * 31 + kind:byte(2)
  local function random()
    state = (state * 1103515245 + 12345) % 2147483648
    return state / 2147483648
  end
  for _ = 1, 5 do random() end
  local function between(a, b) return a + (b - a) * random() end
  local function from(a, b) return math.exp(between(math.log(a), math.log(b))) end
  local s = { boundary = "periodic", effects = { elasticity = "half_space" } }
  if kind == "ball" then
    local radius, contact = from(3, 30), from(0.05, 0.4)
    s.boundary, s.pressure = "free", 4 / 3 * 1e9 * contact ^ 3 / radius
    function s.make(n) return lab.surface.sphere{ cells = n, size = 1, radius = radius, material = material } end
  elseif kind:find "blasted" then
    local size, ra = from(0.2e-3, 0.6e-3), from(1e-6, 4e-6)
    s.pressure = 1e9 * from(0.003, 0.06)
    if kind == "capped_blasted" then
      local hardness = 1e9 * from(0.02, 0.1)
      s.effects.plasticity = { hardness = hardness }
      s.pressure = math.min(s.pressure, 0.5 * hardness)
    end
    function s.make(n)
      return lab.surface.bead_blasted{ cells = n, size = size, ra = ra, seed = seed, material = material }
    end
  elseif kind == "wm" then
    local D, G, waves = between(2.2, 2.5), from(3e-4, 3e-3), math.floor(between(4, 8))
    s.boundary, s.pressure = "free", 1e8 * from(0.003, 0.1)
    function s.make(n)
      return lab.surface.weierstrass_mandelbrot{ cells = n, D = D, L = 1, G = G, n_max = waves, seed = seed,
        material = material }
    end
  elseif kind == "function" then
    local waves, slope = {}, from(0.03, 0.2)
    for k = 1, 12 do
      local most = k <= 4 and 4 or 16
      waves[k] = { math.floor(between(-most, most + 1)), math.floor(between(1, most + 1)), 2 * math.pi * random() }
    end
    s.pressure = 1e9 * slope * from(0.01, 0.2)
    local function height(x, y)
      local z = 0
      for _, w in ipairs(waves) do
        local q = 2 * math.pi * math.sqrt(w[1] ^ 2 + w[2] ^ 2)
        z = z + math.cos(2 * math.pi * (w[1] * x + w[2] * y) + w[3]) * slope / q / math.sqrt(6)
      end
      return z
    end
    function s.make(n)
      return lab.surface.from_function{ cells = n, size = 1, height = height, material = material }
    end
  else
    local two = kind:find "pairs"
    local slope = from(0.05, 0.2)
    local faces = {}
    for k = 1, two and 2 or 1 do faces[k] = { hurst = between(0.5, 0.9), short_wave = 1 / from(6, 32) } end
    s.pressure = 1e9 * slope * from(0.005, 0.3)
    if kind == "free" then s.boundary, s.pressure = "free", 1e9 * slope * from(0.003, 0.05) end
    if kind == "capped" or kind:find "hardening" then
      local hardness = 1e9 * slope * from(0.3, 1)
      s.pressure = math.min(s.pressure, 0.5 * hardness)
      s.effects.plasticity = { hardness = hardness,
        hardening = kind:find "hardening" and hardness / from(1e-3, 1e-2) or nil }
    end
    if kind == "boxes" then
      s.effects.elasticity = { model = "box", stiffness = 1e9 / slope / 0.1 }
      s.counted = true
    end
    function s.make(n)
      local made = {}
      for k, face in ipairs(faces) do
        made[k] = lab.surface.self_affine{ cells = n, size = 1, hurst = face.hurst, rms_slope = slope, roll_off = 0.5,
          short_wave = face.short_wave, seed = seed + 5000 * (k - 1), material = material }
      end
      -- A body is turned about its middle node; shifted by one cell, every grid gives the same contact.
      return made[1], made[2] and made[2]:shifted{ x = -1 / n }
    end
  end
  return s
end

local function press(s, cells, accuracy)
  local lower, upper = s.make(cells)
  local contact <close> = lab.contact{ lower = lower, upper = upper or lab.rigid, boundary = s.boundary,
    effects = s.effects, accuracy = accuracy }
  local st = contact:press{ pressure = s.pressure }
  return { area_fraction = st.area_fraction, corrected_area_fraction = st.corrected_area_fraction, cost = st.cost,
    approach = st.approach, energy = st.energy, chosen = st.chosen }
end

local function work(cells, transforms) return math.max(transforms, 1) * cells ^ 2 * 2 * math.log(cells, 2) end

-- A choice includes the grids tried before.
local function cost_of(st, cells)
  if not st.chosen then return work(cells, st.cost.transforms) end
  local sum = 0
  for _, tried in ipairs(st.chosen.tried) do sum = sum + work(tried.cells[1], tried.cost.transforms) end
  return sum
end

local function at(list, share)
  table.sort(list)
  return list[math.max(1, math.ceil(share * #list))] or 0 / 0
end

local everything = {}
print("| kind | scenes | met 10 % | 3 % | 1 % | cost, median | at 90 % | misses |")
print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |")
for kind in options.kinds:gmatch "[^,]+" do
  local met, costs, missed = {}, {}, {}
  for seed = options.first, options.last do
    local s = scene(kind, seed)
    local settings, truth = {}, nil
    local cells = 32
    while cells <= options.truth do
      local ok, st = pcall(press, s, cells, { tolerance = 1e-6, on_failure = "best" })
      if ok then
        settings[#settings + 1] = { area = st.corrected_area_fraction, cost = cost_of(st, cells) }
        truth = s.counted and st.area_fraction or st.corrected_area_fraction
      end
      cells = cells * 2
    end
    settings[#settings] = nil -- the truth is no setting
    for _, error in ipairs(requested) do
      local ok, st = pcall(press, s, options.given, { error = error })
      local off = ok and math.abs(st.corrected_area_fraction / truth - 1) or math.huge
      met[error] = (met[error] or 0) + (off <= error and 1 or 0)
      if off > error then missed[#missed + 1] = ("%d (%g: %.2f)"):format(seed, error, off / error) end
      local cheapest = math.huge
      for _, setting in ipairs(settings) do
        if math.abs(setting.area / truth - 1) <= error then cheapest = math.min(cheapest, setting.cost) end
      end
      if ok and cheapest < math.huge then
        costs[#costs + 1] = cost_of(st) / cheapest
        everything[#everything + 1] = costs[#costs]
      end
      if options.list > 0 then
        print(kind, seed, error, ("%.2f times the request"):format(off / error), ok and st.chosen.text or tostring(st):match "[^\n]*")
      end
    end
  end
  local n = options.last - options.first + 1
  local function share(error) return ("%.0f %%"):format(100 * met[error] / n) end
  print(("| %s | %d | %s | %s | %s | %.1f | %.1f | %s |"):format(kind, n, share(0.1), share(0.03), share(0.01),
    at(costs, 0.5), at(costs, 0.9), table.concat(missed, ", ")))
end
print(("all: cost, median %.2f, at 90 %% %.1f"):format(at(everything, 0.5), at(everything, 0.9)))
