-- SPDX-License-Identifier: GPL-3.0-or-later
-- Press logs in eighteen forms are read as the same two presses.
local lab = require "asperity"
local function claim(name, data, options)
  local file <close> = assert(io.open("log.txt", "wb"))
  file:write(data)
  file:close()
  local ok, protocol = pcall(lab.protocol.read, "log.txt", options)
  assert(ok, name .. ": " .. tostring(protocol))
  local text = {}
  for _, event in ipairs(protocol:events()) do text[#text + 1] = event.text end
  local read = #text == 2 and text[1]:find("1 kN", 1, true) and text[2]:find("2 kN", 1, true)
  assert(read, name .. ": " .. table.concat(text, "; "))
end
claim("stamps of ISO 8601", "time,load [kN]\n2026-11-23T10:00:00,1\n2026-11-23T10:15:00,2\n")
claim("stamps of a German logger", "time;load [kN]\n23.11.2026 10:00:00;1\n23.11.2026 10:15:00;2\n")
claim("stamps of an American logger", "time,load [kN]\n11/23/2026 10:00 AM,1\n11/23/2026 10:15 AM,2\n")
claim("days of a spreadsheet", "time,load [kN]\n46349.4167,1\n46349.4271,2\n")
claim("equal stamps", "time,load [kN]\n2026-11-23T10:00:00,1\n2026-11-23T10:00:00,2\n")
claim("a unit behind a stroke", "time / s,load / kN\n0,1\n900,2\n")
claim("a unit behind an underscore", "time_s,load_kN\n0,1\n900,2\n")
claim("units in a second line", "time,load\ns,kN\n0,1\n900,2\n")
claim("lines before the head", "Machine 7\nOperator Li\n\ntime [s],load [kN]\n0,1\n900,2\n", { skip=3 })
claim("no head", "0,1\n900,2\n", { columns={ "time [s]", "load [kN]" } })
claim("names of other languages", "Zeit [s];Kraft [kN]\n0;1\n900;2\n")
claim("a column by its own name", "Weg;Wert [kN]\n0;1\n1;2\n", { columns={ load="Wert" } })
claim("two columns of loads", "load [kN],load [N]\n1,990\n2,1980\n", { columns={ load="load [kN]" } })
claim("blanks between columns", "time [s] load [kN]\n0 1\n900 2\n")
claim("quoted decimal commas", 'time [s],load [kN]\n"0,0","1,0"\n"900,0","2,0"\n')
claim("numbers with units in cells", "time,load\n0 s,1 kN\n900 s,2 kN\n")
claim("a line below the table", "time [s],load [kN]\n0,1\n900,2\nTotal\n")
claim("UTF-16", "\xFF\xFE" .. ("time [s],load [kN]\n0,1\n900,2\n"):gsub(".", "%0\0"))
