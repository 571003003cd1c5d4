-- SPDX-License-Identifier: GPL-3.0-or-later
-- Missing, empty, cut-off and damaged files.
--! output: all refused
local lab = require "asperity"
local S = lab.surface
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
local s = S.sine{ cells=16, size="1 mm", amplitude="1 um" }
local good = s:write "good.x3p"
local folder = good:match "^(.*)/"
local function content(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read "a"
end
local function file_of(name, text)
  local file <close> = assert(io.open(name, "wb"))
  file:write(text)
  return folder .. "/" .. name
end
assert(S.read(good) == s)

local x3p = content(good)
for _, length in ipairs{ 1, 30, 100, #x3p // 3, #x3p // 2, #x3p - 22, #x3p - 1 } do
  local cut = file_of("cut.x3p", x3p:sub(1, length))
  refused(function() S.read(cut) end, "cut short or damaged")
end
local empty = file_of("empty.x3p", "")
refused(function() S.read(empty) end, "is empty")
for at = 1, #x3p, 37 do -- one byte wrong: read as it was written, or refused, and never a crash
  local damaged = file_of("damaged.x3p", x3p:sub(1, at - 1) .. string.char(x3p:byte(at) ~ 255) .. x3p:sub(at + 1))
  local ok, message = pcall(S.read, damaged)
  assert(ok or message:find "lab.surface.read: ", message)
end
local npy = content(s:write "good.npy")
for _, length in ipairs{ 5, 9, 20, 100, #npy - 1 } do
  local cut = file_of("cut.npy", npy:sub(1, length))
  refused(function() S.read(cut, { size="1 mm", unit="m" }) end, "cut.npy")
end

assert(io.open("a.txt", "w")):write("1 2\n3 x\n"):close()
refused(function() S.read("a.txt", { size=1 }) end, 'surface.read: "a.txt" has no number in line 2')
refused(function() S.read "nothere.npy" end, 'there is no file "nothere.npy"')
refused(function() S.read "/" end, "is a directory")
refused(function() S.read(folder .. "/good.npy") end, "give `size` and `unit` in the call")
refused(function() S.read() end, "`path` is nothing (nil); give a string")
refused(function() lab.profile.read "nothere.csv" end, 'there is no file "nothere.csv"')
local options = { size=1, unit="um" }
local ragged = file_of("ragged.txt", "1 2 3\n4 5\n")
refused(function() S.read(ragged, options) end, "has 2 cells in line 2 but 3 in the lines before it")
local holes = file_of("holes.txt", "1 2 3\n4 nan 6\n")
local void = file_of("void.txt", "nan nan\nnan nan\n")
refused(function() S.read(void, options) end, "void.txt", "holds no height, only missing points")
assert(S.read(holes, { size=1, unit="um", fill="interpolate" }):height(1, 1) > 0)
local words = file_of("words.txt", "1 2 3\n4 x 6\n")
refused(function() S.read(words, options) end, "has no number in line 2, cell 2")
local bytes = file_of("bytes.txt", "\0\1\2\3")
refused(function() S.read(bytes, options) end, "is not text")
refused(function() S.read(holes, { size=1, unit="kg" }) end, "`unit`", "a mass")
refused(function() S.read(holes, { size=1, unit="um", format="tiff" }) end, "`format` is \"tiff\"", "x3p")
refused(function() s:write "x.bmp" end, "no format has the extension .bmp")
refused(function() s:write "../x.npy" end, "is outside the run directory")
refused(function() s:write(("x"):rep(300) .. ".npy") end, "a file name is 304 bytes long; give at most 255")
refused(function() s:write "a\0b.npy" end, "surface:write: ")
refused(function() s:write "" end, "is not the name of a file")
refused(function() s:picture "x.jpg" end, "pictures of surfaces are .png")
print "all refused"
