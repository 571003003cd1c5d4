-- SPDX-License-Identifier: GPL-3.0-or-later
-- Tables that can be read in two ways, or not at all: file, line, column, what was found and what would work.
--! exit: 1
--! error: bad_tables.lua:38: 
--! error: log.csv" has 2 problems
--! error:   line 2, column 2 (load): "x" is no number
--! error:   line 3, column 1 (N): "new" is no number, unlike others of this column; correct it, or read the column as texts by text={ "N" }
--! output: all refused
local lab = require "asperity"
local function write(text)
  local file <close> = assert(io.open("log.csv", "wb"))
  file:write(text)
end
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").with
local function file(words, text, options)
  write(text)
  refused(words, lab.table.read, "log.csv", options)
end
file('log.csv" line 2, column 1 (day): holds dates such as "03/04/2026"', "day,x\n03/04/2026,1\n")
file('give dates="day first" or dates="month first"', "day,x\n03/04/2026,1\n")
file('give decimal="," or thousands=","', "a;b\n1,250;2\n")
file('choose one, as in columns={ load="load [N]" }', "load [kN],load [N]\n1,990\n")
file("packed with gzip (.gz); unpack it", "\x1F\x8B\x08\x00abc")
file("an Excel 97 workbook (.xls)", "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1 and more")
file("unknown unit `Kn` (did you mean `kN`?)", "load\n1\n", { unit={ load="Kn" } })
file('begins with "2026-01-01 08:00", in line 1, and names no columns; give their heads', "2026-01-01 08:00,1.5\n")
file("give thousands=\"'\" if it separates thousands", "a;b\n1'234.5;2\n")
file("`unit` names `laod`, which is no column (did you mean `load`?)", "load\n1\n", { unit={ laod="N" } })
file('`dates` is "day"', "a\n1\n", { dates="day" })
file("skp", "a\n1\n", { skp=1 })
refused("give a table or a notebook", function() return lab.table.from{ { N=1 } }:joined({}, { by="N" }) end)
refused("write lab.table.from{ { N=1, mu=0.4 } }", lab.table.from, { 1, 2 })
refused("one folder and a pattern of names", lab.files, "*/a.csv")
refused('the folder "nosuch" cannot be read', lab.files, "nosuch/*.csv")
refused("a length where a pressure is wanted", lab.quantity, "250 um", "MPa")
refused("(did you mean `pressure`?)", lab.quantity, "250 um", "presure")
print "all refused"
write "N,load [N]\n1,x\nnew,2\n3,4\n" lab.table.read "log.csv"
