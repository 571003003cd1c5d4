-- SPDX-License-Identifier: GPL-3.0-or-later
-- A lattice of points with one missing is never read as a map of its coordinates.
local lab = require "asperity"
local function refused(text)
  local file <close> = assert(io.open("points.txt", "w"))
  file:write(text)
  file:flush()
  for _, options in ipairs{ { unit="um" }, { unit="um", size="1 mm" }, { unit="um", size="1 mm", fill="interpolate" } } do
    local ok, message = pcall(lab.surface.read, "points.txt", options)
    assert(not ok, "it was read")
    assert(message:find('"xyz"', 1, true) and message:find('"text"', 1, true), message)
  end
end
refused "0\t0\t1\n1\t0\t2\n0\t1\t3\n"
refused "0\t0\t1\n1\t0\t2\n0\t1\t3\n1.2\t1\t3\n"
