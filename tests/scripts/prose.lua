-- SPDX-License-Identifier: GPL-3.0-or-later
-- asperity.prose: a paragraph is a line, whatever its lines were in the script.
--! output: The first of 2 paragraphs, in two lines.
--! output: And the second, 50 % of all.
--! not output: paragraphs,\n
local prose = require "asperity.prose"
prose([[

The first of %d paragraphs,
  in two lines.

And the second, 50 %% of all.
]], 2)
prose "50 % and no value: nothing is put in\nhere"
assert(not pcall(prose, 5))
local lines = {}
local original = print
print = function(line) lines[#lines + 1] = line end
prose "a\nb\n \n\nc\td\n"
print = original
assert(#lines == 1 and lines[1] == "a b\n\nc\td", lines[1])
