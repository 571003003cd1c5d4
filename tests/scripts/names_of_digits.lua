-- SPDX-License-Identifier: GPL-3.0-or-later
-- Columns of digits as names: a warning gives the lost digits and the key against the loss.
--! error: ids.txt" line 2, column 1 (id): "007" is read as a number, which loses its zeros; text={ "id" } reads it unchanged
--! error: ids.txt" line 3, column 2 (bar code): "123456789012345678901" is read as a number, which loses digits; text={ "bar code" }
--! not error: month
--! not error: force
--! output: 7	007
local lab = require "asperity"
local function read(options)
  local file <close> = assert(io.open("ids.txt", "w"))
  file:write "id;bar code;month;force\n007;12;01;0,250\n012;123456789012345678901;02;0,125\n"
  file:close()
  return lab.table.read("ids.txt", options):rows()[1].id
end
print(read(), read{ text = { "id", "bar code" } })
