-- SPDX-License-Identifier: GPL-3.0-or-later
-- A run reads its own files again: by the given name and by the returned path.
--! output: true	true	text	1
local lab = require "asperity"
local s = lab.surface.sine{ cells=8, size="1 mm", amplitude="1 um" }
local place = s:write "sine.x3p"
local again, placed = lab.surface.read "sine.x3p", lab.surface.read(place)
local file = assert(io.open("note.txt", "w"))
file:write "text"
file:close()
file = assert(io.open "note.txt")
print(again == s, placed == s, file:read "a", os.remove(place) and 1)
file:close()
