-- SPDX-License-Identifier: GPL-3.0-or-later
-- The values of every file that the readers' tests, their fuzzers and the examples hold: the digest of the surface,
-- profile, table, protocol and recording in each file. A reader that refuses the file is left out.
local lab = require "asperity"
local readers = {
  { "profile", lab.profile.read }, { "protocol", lab.protocol.read },
  { "recording", function(path) return lab.protocol.read(path, { events="detect", area="1 cm^2" }) end },
  { "surface", lab.surface.read }, { "table", lab.table.read },
}
for _, path in ipairs{ ... } do
  local line = { path }
  for _, reader in ipairs(readers) do
    local read, value = pcall(reader[2], path)
    if read then line[#line + 1] = reader[1] .. "=" .. value.digest:sub(1, 16) end
  end
  print(table.concat(line, " "))
end
