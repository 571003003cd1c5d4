-- SPDX-License-Identifier: GPL-3.0-or-later
-- Arguments reach the script as ... and arg.
--! args: one 2 --three -4 five=5
--! output: 5 one 2 --three -4 five=5
--! output: arg 5 arguments.lua one five=5
print(table.concat({ select("#", ...), ... }, " "))
local name = arg[0]:match "[^/]*$"
print("arg " .. #arg .. " " .. name .. " " .. arg[1] .. " " .. arg[5])
assert(arg[6] == nil and arg[2] == "2")
