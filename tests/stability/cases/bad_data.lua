-- SPDX-License-Identifier: GPL-3.0-or-later
-- Bad data: holes, infinities, outliers, truncated files, wrong units, headers with a false size.
--
-- Files are written, damaged in one way at a time, and read back. The reader must return the written heights,
-- or an error that names the file and the fault. A binary file is cut at every byte.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 13, title = "Bad data", edge = "files cut at every byte; sizes in a header from 0 to 2^62;"
    .. " not-a-number, infinities and outliers up to 1e308; every wrong unit",
  elsewhere = "A hole becomes 0 or -32768, the deepest pit of the map. The reader allocates the size in the"
    .. " header, reads nanometres as metres, and reads a truncated file up to the cut.",
  here = "A quantity missing from the file must be given in the call. A fault in the file is an error that"
    .. " names the file. Holes are filled only if the call says how. The size of the file bounds the memory.",
}

local nx, ny = 9, 7
local made = lab.surface.self_affine{ cells = { nx, ny }, size = { "90 um", "70 um" }, hurst = 0.8,
  rms_height = "1 um", short_wave = "30 um" }
local function bytes_of(name)
  local f <close> = assert(io.open(name, "rb"))
  return f:read "a"
end
local function write(name, bytes)
  local f <close> = assert(io.open(name, "wb"))
  f:write(bytes)
  return name
end
local function same(a, b)
  if a.cells[1] ~= b.cells[1] or a.cells[2] ~= b.cells[2] then return false end
  local p, q = a:heights(), b:heights()
  for j = 1, #p do
    for i = 1, #p[j] do if math.abs(p[j][i] - q[j][i]) > 1e-15 * made.peak_to_valley then return false end end
  end
  return true
end

-- 1. Every length from 0 to the whole file.
local given = { npy = { size = { "90 um", "70 um" }, unit = "m" }, x3p = {}, h5 = {}, gwy = {},
  txt = { size = { "90 um", "70 um" }, unit = "m" } }
local cuts = lab.notebook "cuts"
for extension, options in lab.sorted(given) do
  local whole = bytes_of(made:write("whole." .. extension))
  local refused, read, other, unnamed = 0, 0, 0, 0
  for length = 0, #whole do
    local name = write("cut." .. extension, whole:sub(1, length))
    local ok, s = pcall(lab.surface.read, name, options)
    if not ok then
      refused = refused + 1
      if not s:find("cut." .. extension, 1, true) then unnamed = unnamed + 1 end
    elseif same(s, made) then read = read + 1
    else other = other + 1 end
  end
  cuts:write{ format = extension, bytes = #whole, cuts = #whole + 1, refused = refused, ["read whole"] = read,
    other = other, unnamed = unnamed }
end
case:evidence(cuts, "A map of 9 x 7 heights, cut at every byte. In a text matrix no reader can detect a"
  .. " missing row or missing digits of the last number. The reader always returns whole rows.",
  { { "format", "%s" }, { "bytes", "%d" }, { "cuts", "%d" }, { "refused", "%d" },
  { "read whole", "%d", "read as written" }, { "other", "%d", "read as another map" } })
case:expect(cuts, "unnamed", { at_most = 0 })
for _, format in ipairs{ "npy", "x3p", "h5", "gwy" } do case:expect(cuts, "other",
  { where = { format = format }, at_most = 0 }) end
case:expect(cuts, "read whole", { at_least = 1 })

-- 2. One changed byte, at many places and with several values: never a crash, and never other heights from a
-- format with checksums.
local flips = lab.notebook "flips"
for _, extension in ipairs{ "x3p", "h5", "npy" } do
  local whole = bytes_of("whole." .. extension)
  local refused, read, other = 0, 0, 0
  for place = 1, #whole, extension == "npy" and 1 or 7 do
    for _, mask in ipairs{ 0x01, 0x80, 0xff } do
      local bytes = whole:sub(1, place - 1) .. string.char(whole:byte(place) ~ mask) .. whole:sub(place + 1)
      local ok, s = pcall(lab.surface.read, write("flipped." .. extension, bytes), given[extension])
      if not ok then refused = refused + 1 elseif same(s,
        made) then read = read + 1 else other = other + 1 end
    end
  end
  flips:write{ format = extension, changed = refused + read + other, refused = refused, ["read whole"] = read,
    other = other }
end
case:evidence(flips, "One changed byte, at every place of an NPY file and every seventh of the others, in"
  .. " three ways. X3P and HDF5 files have checksums. An NPY file has none, so a changed height reads as"
  .. " another map.",
  { { "format", "%s" }, { "changed", "%d", "files" }, { "refused", "%d" },
  { "read whole", "%d", "read as written" }, { "other", "%d", "read as another map" } })
for _, format in ipairs{ "x3p", "h5" } do case:expect(flips, "other",
  { where = { format = format }, at_most = 0 }) end

-- 3. False headers.
local function npy(shape, count, order)
  local head = ("{'descr': '<f8', 'fortran_order': %s, 'shape': %s, }"):format(order or "False", shape)
  head = head .. (" "):rep((64 - (11 + #head) % 64) % 64) .. "\n"
  return "\x93NUMPY\x01\x00" .. string.pack("<I2", #head) .. head .. string.pack("<d", 1e-6):rep(count)
end
local size = { size = "1 mm", unit = "m" }
case:holds("an NPY file of shape (3, 4) with its 12 heights is read",
  lab.surface.read(write("good.npy", npy("(3, 4)", 12)), size).cells[1] == 4)
for _, lie in ipairs{ { "(3, 4)", 11 }, { "(3, 4)", 13 }, { "(0, 4)", 0 }, { "(-3, 4)", 12 },
  { "(65536, 65536)", 12 }, { "(4611686018427387904, 4)", 12 },
  { "(4294967296, 4294967296)", 12 }, { "(99999999999999999999, 1)", 12 }, { "(3, 4, 1, 1)", 12 },
  { "3.5", 12 } } do
  case:refused(("NPY of shape %s with %d heights"):format(lie[1], lie[2]),
    function() lab.surface.read(write("lie.npy", npy(lie[1], lie[2])), size) end, "lie.npy")
end

-- 4. Holes, infinities, outliers.
local function matrix(word)
  local rows = {}
  for j = 1, 5 do
    local row = {}
    for i = 1, 6 do row[i] = (i == 3 and j == 2) and word or ("%.3f"):format(math.sin(i * j)) end
    rows[j] = table.concat(row, " ")
  end
  return table.concat(rows, "\n") .. "\n"
end
local um = { size = { "60 um", "50 um" }, unit = "um" }
local function with(options) for key, value in pairs(um) do options[key] = value end return options end
for _, word in ipairs{ "nan", "NaN" } do
  local s = lab.surface.read(write("holes.txt", matrix(word)), um)
  local hole = s:height(2, 1)
  case:holds("`" .. word .. "` in a text matrix is an unmeasured point",
    hole ~= hole and s:height(1, 1) == s:height(1, 1))
  case:refused("a contact of a map with `" .. word .. "`", function()
    lab.contact{ lower = s:with{ material = lab.material "Al-2011" }, upper = lab.rigid, boundary = "periodic",
      effects = { elasticity = "half_space" } }:press{ pressure = "1 MPa" }
  end, "not measured")
end
for _, word in ipairs{ "inf", "-inf", "1e999" } do
  local name = write("holes.txt", matrix(word))
  case:refused("`" .. word .. "` in a text matrix", function() lab.surface.read(name, um) end, "holes.txt")
end
local holed = lab.surface.read(write("holes.txt", matrix "nan"), with{ fill = "interpolate" })
local around = (holed:height(1, 1) + holed:height(3, 1) + holed:height(2, 0) + holed:height(2, 2)) / 4
case:holds("a hole filled by interpolation is within 1 um of the mean of its neighbours",
  math.abs(holed:height(2, 1) - around) < 1e-6)
case:holds("a hole filled with a height has that height", lab.surface.read("holes.txt",
  with{ fill = "0.5 um" }):height(2, 1) == 0.5e-6)
case:refused("a map of holes only", function() lab.surface.read(write("void.txt",
  "nan nan\nnan nan\n"), with{ fill = "interpolate" }) end, "void.txt")
local outlier = lab.notebook "outlier"
for _, height in ipairs{ 10, 1e6, 1e30, 1e100, 1e150, 1e200, 1e300 } do
  local ok, s = pcall(lab.surface.read, write("outlier.txt", matrix(("%g"):format(height))), um)
  local r = ok and s:roughness()
  local z = height * 1e-6
  -- one of thirty, with the others negligible
  local Rq = ok and math.abs(r.Rq / (z * math.sqrt(29) / 30) - 1) or nil
  outlier:write{ height = z, answer = not ok and "refused" or "read", Rq = ok and height > 1e5 and Rq or nil,
    finite = not ok and 1 or (r.Rq < math.huge and r.Ra < math.huge and r.kurtosis < math.huge) and 1 or 0,
    kurtosis = ok and r.kurtosis or nil }
end
case:evidence(outlier, "One outlier among thirty heights of a micrometre. The statistics stay finite, and"
  .. " the kurtosis tends to 28.03.", { { "height", "%.0e", "outlier (m)" },
  { "answer", "%s" }, { "Rq", "%.0e", "error of Rq" }, { "kurtosis", "%.3f" } })
case:expect(outlier, "finite", { at_least = 1 })

-- 5. Units.
for _, unit in ipairs{ "", "N", "Pa", "parsec", "um um", "1e400 m", "0 m", "-1 um", "um/" } do
  case:refused(("unit = %q"):format(unit), function() lab.surface.read("good.npy",
    { size = "1 mm", unit = unit }) end, "`unit`")
end
case:refused("a text matrix without size and unit", function() lab.surface.read(write("bare.txt",
  matrix "1")) end, "`size`")
case:refused("rows of unequal length", function() lab.surface.read(write("ragged.txt", "1 2 3\n1 2\n1 2 3\n"),
  um) end, "ragged.txt")
case:refused("a word among numbers", function() lab.surface.read(write("word.txt", "1 2 3\n1 two 3\n"),
  um) end, "word.txt")
case:refused("an empty file", function() lab.surface.read(write("empty.txt", ""), um) end, "empty.txt")
case:refused("a missing file", function() lab.surface.read("nowhere.txt", um) end, "nowhere.txt")
for _, height in ipairs{ 0 / 0, math.huge, -math.huge } do
  case:refused("from_function returning " .. tostring(height):gsub("^-nan", "nan"), function()
    lab.surface.from_function{ cells = 4, size = 1, height = function(x) return x == 0.5 and height or 0 end }
  end, "height")
end
case:finish{ worst = "refused, naming the file", verdict = "clear error" }
