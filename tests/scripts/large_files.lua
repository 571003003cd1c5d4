-- SPDX-License-Identifier: GPL-3.0-or-later
-- A file larger than the memory is refused before it is read. These files have 1 TiB and occupy no space on the disk.
local lab = require "asperity"

local function must_refuse(read, file)
  local out <close> = assert(io.open(file, "w"))
  out:seek("set", 1 << 40)
  out:write "x"
  out:flush()
  local good, message = pcall(read, file)
  assert(os.remove(file))
  message = tostring(message)
  assert(not good and message:find("1 TiB", 1, true) and message:find("quarter of this machine's memory", 1, true), message)
end

for _, ending in ipairs{ "npy", "csv", "x3p", "sur", "h5", "gwy", "sdf", "mat", "png" } do
  must_refuse(lab.surface.read, "map." .. ending)
end
must_refuse(lab.profile.read, "trace.csv")
must_refuse(lab.table.read, "table.csv")
must_refuse(lab.protocol.read, "log.csv")
